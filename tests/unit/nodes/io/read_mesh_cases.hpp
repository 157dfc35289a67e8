// Small files of meshes, and how they are read, for the tests of both.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/read_mesh.hpp"
#include "mesh_files.hpp"
#include "test_data.hpp"

namespace ballflow::geometry::mesh_cases {

using test::Ply;

/// Keeps warnings.
class Listener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

inline MeshFile read(const std::string& name, const std::string& content, Monitor& monitor = no_monitor(),
                     const ReadOptions& options = {}) {
  const test::TempFolder folder;
  test::write_file(folder.file(name), content);
  return read_mesh_file(folder.file(name), options, monitor);
}

/// The cause of the error that reading gives; empty when there is none.
inline std::string error_of(const std::string& name, const std::string& content) {
  try {
    read(name, content);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find('\n'), std::string::npos) << "no hint: " << text;
    return text.substr(0, text.find('\n'));
  }
  return {};
}

inline void expect_small_mesh_file(const MeshFile& file) {
  const TriangleMesh expected = test::small_mesh();
  EXPECT_EQ(file.points.points, expected.vertices);
  EXPECT_EQ(file.mesh.vertices, expected.vertices);
  EXPECT_EQ(file.mesh.triangles, expected.triangles);
}

inline void expect_made_up_normals(const MeshFile& file) {
  ASSERT_EQ(file.points.normals.size(), file.points.points.size());
  for (std::size_t v = 0; v < file.points.normals.size(); ++v) {
    EXPECT_LT(distance(file.points.normals[v], test::made_up_normal(v)), 1e-15) << v;
  }
}

}  // namespace ballflow::geometry::mesh_cases

// Damaged model files are read or refused; they never crash a reader, hang it, or leave a broken model
// behind.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/random.hpp"
#include "io/read_mesh.hpp"
#include "mesh_files.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

struct Seed {
  const char* name;
  MeshFormat format;
  std::string content;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::vector<Seed> seeds() {
  using test::Ply;
  const TriangleMesh m = test::small_mesh();
  const std::string xyz = test::as_xyz(m), rows = xyz.substr(xyz.find('\n') + 1);
  return {{"off", MeshFormat::off, test::as_off(m, true, true)},
          {"obj", MeshFormat::obj, test::as_obj(m, true)},
          {"obj_negative", MeshFormat::obj, test::as_obj(m, false, true)},
          {"ply_ascii", MeshFormat::ply, test::as_ply(m, Ply::ascii, true, true)},
          {"ply_little", MeshFormat::ply, test::as_ply(m, Ply::little, true, true)},
          {"ply_big", MeshFormat::ply, test::as_ply(m, Ply::big)},
          {"stl_ascii", MeshFormat::stl, test::as_ascii_stl(m)},
          {"stl_binary", MeshFormat::stl, test::as_binary_stl(m)},
          {"xyz", MeshFormat::xyz, test::as_xyz(m, true)},
          {"pts", MeshFormat::xyz, test::as_xyz(m, false, true)},
          {"off_modelnet", MeshFormat::off, replaced(test::as_off(m), "OFF\n# made by a test\n", "OFF")},
          {"obj_continued", MeshFormat::obj, replaced(test::as_obj(m, true), " ", " \\\n")},
          {"stl_words", MeshFormat::stl,
           replaced(replaced(test::as_ascii_stl(m), "endloop", "end loop"), "\n", " ")},
          {"csv_names", MeshFormat::xyz, "\"X [mm]\",Y,Z\n" + replaced(rows, " ", ",")},
          {"decimal_commas", MeshFormat::xyz, replaced(replaced(rows, ".", ","), " ", ";")},
          {"two_scans", MeshFormat::xyz, test::as_xyz(m, false, true) + "2\n9 9 9 1\n8 8 8 1\n"}};
}

/// Reads; whatever comes out must be whole.
void read(const std::string& content, MeshFormat format) {
  try {
    // A copy of exact size: a sanitizer sees every byte read beyond its end.
    const std::vector<char> exact(content.begin(), content.end());
    const MeshFile file = parse_mesh({exact.data(), exact.size()}, format);
    ASSERT_EQ(broken_invariant(file.points), "");
    ASSERT_EQ(broken_invariant(file.mesh), "");
    ASSERT_GE(file.points.points.size(), 4u);
    ASSERT_LE(file.points.points.size() + file.mesh.triangles.size(), content.size());
    mesh_topology(file.mesh);
  } catch (const InputError& error) {
    ASSERT_NE(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

std::string damaged(std::string content, Random& random, const std::vector<Seed>& others) {
  static const std::vector<std::string> tokens = {"-1",
                                                  "99999999999999999999",
                                                  "4294967295",
                                                  "2147483647",
                                                  "nan",
                                                  "inf",
                                                  "1e999",
                                                  "-0",
                                                  "\n",
                                                  "\r",
                                                  " ",
                                                  "#",
                                                  "\\\n",
                                                  "/",
                                                  "//",
                                                  "f 1",
                                                  "v ",
                                                  "\0",
                                                  "list uchar int vertex_indices\n",
                                                  "end_header\n",
                                                  "element face 3\n",
                                                  "solid\n",
                                                  "endsolid\n"};
  const auto below = [&random](std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(random.bits() % n);
  };
  for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
    const std::size_t at = below(content.size() + 1),
                      length = below(std::min<std::size_t>(24, content.size() - at + 1));
    switch (below(7)) {
      case 0:  // one bit
        if (at < content.size()) content[at] = static_cast<char>(content[at] ^ (1 << below(8)));
        break;
      case 1:  // one byte
        if (at < content.size()) content[at] = static_cast<char>(below(256));
        break;
      case 2:
        content.resize(at);
        break;
      case 3:
        content.erase(at, length);
        break;
      case 4:
        content.insert(at, content.substr(below(content.size()), length));
        break;
      case 5:
        content.replace(at, below(length + 1), tokens[below(tokens.size())]);
        break;
      default: {
        const std::string& other = others[below(others.size())].content;
        content.insert(at, other.substr(below(other.size()), 2 * length));
        break;
      }
    }
  }
  return content;
}

TEST(mesh_readers, survive_random_damage) {
  const std::vector<Seed> all = seeds();
  for (const Seed& seed : all) {
    SCOPED_TRACE(seed.name);
    Random random(20100101);
    for (int round = 0; round < 4000 && !HasFatalFailure(); ++round)
      read(damaged(seed.content, random, all), seed.format);
  }
}

TEST(mesh_readers, survive_every_single_byte_set_to_its_extremes) {
  for (const Seed& seed : seeds()) {
    SCOPED_TRACE(seed.name);
    for (std::size_t at = 0; at < seed.content.size() && !HasFatalFailure(); ++at) {
      for (const char value : {'\0', '\x7f', '\xff', '9', '-', '\n'}) {
        std::string content = seed.content;
        content[at] = value;
        read(content, seed.format);
      }
    }
  }
}

TEST(mesh_readers, survive_every_file_read_as_every_format_and_cut_anywhere) {
  for (const Seed& seed : seeds()) {
    for (const MeshFormat format :
         {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl, MeshFormat::xyz}) {
      for (std::size_t size = 0; size <= seed.content.size() && !HasFatalFailure();
           size += format == seed.format ? 1 : 37) {
        read(seed.content.substr(0, size), format);
      }
    }
  }
}

TEST(mesh_readers, survive_damaged_gzip_streams) {
  const test::TempFolder folder;
  const std::vector<Seed> all = seeds();
  const std::string packed = test::gzipped(all[0].content);
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    test::write_file(folder.file("a.off.gz"), damaged(packed, random, all));
    try {
      EXPECT_EQ(broken_invariant(read_mesh_file(folder.file("a.off.gz")).mesh), "");
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry

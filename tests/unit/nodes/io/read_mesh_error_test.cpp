// What is wrong with a mesh file, and where.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "read_mesh_cases.hpp"

namespace ballflow::geometry {
namespace {

using namespace mesh_cases;

TEST(read_mesh_error, names_the_vertex_and_the_coordinate) {
  EXPECT_EQ(error_of("a.off", "OFF\n4 0 0\n0 0 0\n1 nan 0\n0 1 0\n0 0 1\n"), "vertex 1: y is nan (line 4)");
  EXPECT_EQ(error_of("a.off", "OFF\n4 0 0\n0 0 0\n1 0 -inf\n0 1 0\n0 0 1\n"), "vertex 1: z is -inf (line 4)");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 0 x 0\n"), "vertex 1: y is \"x\", not a number (line 2)");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 0 0\n"), "vertex 1: z is missing (line 2)");
  EXPECT_EQ(error_of("a.xyz", "0 0 0\n0 1,5 0\n0 y 0"), "point 2: y is \"y\", not a number (line 3)");
  EXPECT_EQ(error_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 nan 0\n"),
            "facet 0: y is nan (line 5)");
  TriangleMesh m = test::small_mesh();
  std::vector<Vec3> vertices(m.vertices.begin(), m.vertices.end());
  vertices[17].y = std::numeric_limits<double>::quiet_NaN();
  m.vertices = vertices;
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::ascii)), "vertex 17: y is nan (line 28)");
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::big)), "vertex 17: y is nan");
  EXPECT_NE(error_of("a.stl", test::as_binary_stl(m)).find(": y is nan"), std::string::npos);
}

TEST(read_mesh_error, names_the_face_with_a_vertex_index_out_of_range) {
  TriangleMesh m = test::small_mesh();
  std::vector<Triangle> triangles(m.triangles.begin(), m.triangles.end());
  triangles[5][1] = 99;
  m.triangles = triangles;
  EXPECT_EQ(error_of("a.off", test::as_off(m)),
            "face 5: vertex index 99 is out of range (20 vertices) (line 30)");
  EXPECT_EQ(error_of("a.obj", test::as_obj(m)),
            "face 5: vertex index 100 is out of range (20 vertices) (line 29)");
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::ascii)),
            "face 5: vertex index 99 is out of range (20 vertices) (line 36)");
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::little)),
            "face 5: vertex index 99 is out of range (20 vertices)");
  EXPECT_NE(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n").find("face 0: vertex index 0 "),
            std::string::npos);
  EXPECT_NE(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n").find("face 0: vertex index -4 "),
            std::string::npos);
}

TEST(read_mesh_error, comes_for_every_truncation_of_a_file_with_a_size) {
  const TriangleMesh m = test::small_mesh();
  struct Case {
    std::string whole;
    MeshFormat format;
    std::size_t tail;  // a text without its last characters may be whole, or end in a shorter number
  };
  // XYZ and OBJ files may end anywhere.
  for (const Case& c :
       {Case{test::as_ply(m, Ply::little), MeshFormat::ply, 0},
        Case{test::as_ply(m, Ply::big), MeshFormat::ply, 0}, Case{test::as_binary_stl(m), MeshFormat::stl, 0},
        Case{test::as_off(m), MeshFormat::off, 3}, Case{test::as_ply(m, Ply::ascii), MeshFormat::ply, 4},
        Case{test::as_ascii_stl(m), MeshFormat::stl, 16}}) {
    for (std::size_t size = 0; size + c.tail < c.whole.size(); ++size) {
      EXPECT_THROW(parse_mesh(c.whole.substr(0, size), c.format), InputError)
          << size << " of " << c.whole.size();
    }
  }
  const std::string packed = test::gzipped(test::as_off(m));
  for (std::size_t size = 1; size < packed.size(); size += 17) {
    EXPECT_THROW(read("a.off.gz", packed.substr(0, size)), InputError) << size << " of " << packed.size();
  }
}

TEST(read_mesh_error, comes_before_memory_for_what_a_header_claims) {
  EXPECT_NE(error_of("a.off", "OFF 1000000000000 4 0\n0 0 0\n").find("promises 1000000000000 vertices"),
            std::string::npos);
  EXPECT_NE(error_of("a.off", "OFF 1 1000000000000 0\n0 0 0\n").find("promises 1000000000000 faces"),
            std::string::npos);
  EXPECT_NE(error_of("a.off", "OFF 3 1 0\n0 0 0\n0 0 1\n0 1 0\n1000000000000 0 1 2\n"), "");
  EXPECT_NE(error_of("a.pts", "1000000000000\n0 0 0\n").find("promises 1000000000000 points"),
            std::string::npos);
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string header = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
    const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_NE(error_of("a.ply", header + "1000000000000" + xyz + "end_header\n0 0 0\n")
                  .find("promises 1000000000000"),
              std::string::npos);
    EXPECT_NE(
        error_of("a.ply", header + "9223372036854775807" + xyz + "end_header\n0 0 0\n").find("promises"),
        std::string::npos);
    EXPECT_NE(error_of("a.ply", header + "1000000000000\nend_header\n"), "");  // no property: nothing to read
    EXPECT_NE(error_of("a.ply", header + "0" + xyz +
                                    "element face 1\nproperty list int int "
                                    "vertex_indices\nend_header\n\x7f\xff\xff\x7f 2000000000"),
              "");
  }
}

TEST(read_mesh_error, says_what_is_wrong_with_the_file_itself) {
  const test::TempFolder folder;
  const auto error = [](const std::string& path, const ReadOptions& options = {}) -> std::string {
    try {
      read_mesh_file(path, options);
    } catch (const InputError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(error(folder.file("none.off")).find("does not exist"), std::string::npos);
  EXPECT_NE(error(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(error("/dev/null").find("is not a regular file"), std::string::npos);
  test::write_file(folder.file("empty.off"), "");
  EXPECT_NE(error(folder.file("empty.off")).find("is empty"), std::string::npos);
  test::write_file(folder.file("empty.off.gz"), test::gzipped(""));
  EXPECT_NE(error(folder.file("empty.off.gz")).find("is empty"), std::string::npos);
  test::write_file(folder.file("a.step"), "x");
  EXPECT_NE(
      error(folder.file("a.step")).find("unknown extension \".step\"\nreadable are .off .obj .ply .stl"),
      std::string::npos);

  const std::string packed = test::gzipped(test::as_off(test::small_mesh()));
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // the checksum
  test::write_file(folder.file("crc.off.gz"), damaged);
  EXPECT_NE(error(folder.file("crc.off.gz")).find("is damaged"), std::string::npos);
  test::write_file(folder.file("more.off.gz"), packed + "more");
  EXPECT_NE(error(folder.file("more.off.gz")).find("is damaged"), std::string::npos);
  test::write_file(folder.file("padded.off.gz"), packed + std::string(512, '\0'));
  EXPECT_EQ(error(folder.file("padded.off.gz")), "");
}

TEST(read_mesh_error, comes_for_a_gzip_bomb) {
  const std::string bomb = test::gzipped(std::string(std::size_t{50} << 20, '\n'));
  ReadOptions options;
  options.max_unpacked_bytes = 10 << 20;
  try {
    read("bomb.xyz.gz", bomb, no_monitor(), options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("unpacks to more than 10485760 bytes"), std::string::npos);
  }
}

TEST(read_mesh_error, comes_for_points_that_do_not_fill_space) {
  EXPECT_NE(error_of("a.xyz", "0 0 0\n1 0 0\n0 1 0\n").find("only 3 distinct points"), std::string::npos);
  EXPECT_NE(error_of("a.xyz", "1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n").find("only 1 point"), std::string::npos);
  EXPECT_NE(error_of("a.xyz", "0 0 0\n1 2 3\n2 4 6\n3 6 9\n-1 -2 -3\n").find("on one line"),
            std::string::npos);
  // In a plane no coordinate of which is constant.
  EXPECT_NE(error_of("a.xyz", "1 0 0\n0 1 0\n0 0 1\n2 -1 0\n0.5 0.25 0.25\n-3 3 1\n").find("in one plane"),
            std::string::npos);
  // One unit in the last place off the plane.
  EXPECT_EQ(error_of("a.xyz", "1 0 0\n0 1 0\n0 0 1\n2 -1 0\n0.5 0.25 0.25000000000000006\n"), "");
}

TEST(read_mesh_error, refuses_the_damaged_models_by_element) {
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"models/broken_truncated.ply.gz",
       "the header promises 12 vertex elements, but the file ends after at most 6"},
      {"models/broken_bad_index.off.gz", "face 0: vertex index 100 is out of range (12 vertices) (line 15)"},
      {"models/broken_nan.off.gz", "vertex 10: x is nan (line 13)"}};
  for (const auto& [name, cause] : expected) {
    const std::string path = test::data_file(name);
    if (path.empty()) GTEST_SKIP() << "no test data";
    try {
      read_mesh_file(path);
      ADD_FAILURE() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, cause.size()), cause);
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry

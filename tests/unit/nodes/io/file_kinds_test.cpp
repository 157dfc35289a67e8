// Files as strangers bring them: every kind is read as what it means, or refused with words that are true.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/file_content.hpp"
#include "io/formats.hpp"
#include "io/load_balls.hpp"
#include "io/read_mesh.hpp"
#include "mesh_files.hpp"
#include "test_data.hpp"
#include "zstd_files.hpp"

namespace ballflow::geometry {
namespace {

using test::Ply;

struct Reading {
  MeshFile file;
  std::string warnings, refusal;
};

struct KindsListener final : Monitor {
  explicit KindsListener(std::string& text) : text_(text) {}
  void warn(const std::string& warning) override { text_ += warning + "\n"; }
  std::string& text_;
};

Reading read_path(const std::string& path) {
  Reading reading;
  KindsListener listener(reading.warnings);
  try {
    reading.file = read_mesh_file(path, {}, listener);
  } catch (const InputError& error) {
    reading.refusal = error.what();
  }
  return reading;
}

Reading read_kind(const std::string& name, const std::string& content) {
  const test::TempFolder folder;
  test::write_file(folder.file(name), content);
  return read_path(folder.file(name));
}

testing::AssertionResult has(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (text.find(word) == std::string::npos) {
      return testing::AssertionFailure() << "\"" << text << "\" lacks \"" << word << "\"";
    }
  }
  return testing::AssertionSuccess();
}

void expect_small_mesh(const Reading& reading) {
  const TriangleMesh expected = test::small_mesh();
  EXPECT_EQ(reading.refusal, "");
  EXPECT_EQ(reading.file.points.points, expected.vertices);
  EXPECT_EQ(reading.file.mesh.triangles, expected.triangles);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

const Array<Vec3> four_points = {{0, 0, 0}, {1.5, 0, 0}, {0, -2.25, 0}, {0, 0, 3}};

void expect_four_points(const Reading& reading) {
  EXPECT_EQ(reading.refusal, "");
  EXPECT_EQ(reading.file.points.points, four_points);
}

// ---- names and content

TEST(file_kinds, content_that_is_certainly_of_another_format_is_read_as_that) {
  const TriangleMesh m = test::small_mesh();
  const std::vector<std::pair<std::string, std::string>> contents = {{"OFF", test::as_off(m)},
                                                                     {"OBJ", test::as_obj(m)},
                                                                     {"PLY", test::as_ply(m, Ply::ascii)},
                                                                     {"PLY", test::as_ply(m, Ply::big)},
                                                                     {"STL", test::as_ascii_stl(m)},
                                                                     {"STL", test::as_binary_stl(m)}};
  const std::vector<std::pair<std::string, std::string>> names = {
      {"OFF", "a.off"}, {"OBJ", "a.OBJ"}, {"PLY", "a.ply"}, {"STL", "a.stl"}, {"", "a.xyz"}, {"", "a.mesh"}};
  for (const auto& [format, content] : contents) {
    for (const auto& [named, name] : names) {
      SCOPED_TRACE(name + " with " + format);
      const Reading reading = read_kind(name, content);
      expect_small_mesh(reading);
      if (format == named) {
        EXPECT_EQ(reading.warnings.find("content"), std::string::npos);
      } else {
        EXPECT_TRUE(has(reading.warnings, {"its content is " + format}));
      }
    }
    expect_small_mesh(read_kind("a." + format + ".zst", test::zstd_packed(content)));
  }
  EXPECT_TRUE(has(read_kind("a.obj", test::as_xyz(m)).warnings, {"called .obj", "points as text"}));
}

TEST(file_kinds, formats_that_are_not_read_are_called_by_their_names) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"glTF\2...", "GLB"},
      {"{\"asset\": {}}", "glTF"},
      {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "COLLADA"},
      {"# vtk DataFile Version 3.0\n", "VTK"},
      {"<VTKFile type=\"PolyData\">", "VTK"},
      {"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n", "PCD"},
      {"VERSION .7\nFIELDS x y z\n", "PCD"},
      {"<?xml version=\"1.0\"?>\n<robot name=\"a\">", "URDF or SRDF"},
      {"ISO-10303-21;\nHEADER;", "STEP"},
      {"<!DOCTYPE html><html>", "web page"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:1\n", "git lfs pull"},
      {"\x93NUMPY\1", "NumPy"},
      {"NRRD0004\ntype: uchar\n", "NRRD"},
      {"BLENDER-v300", "Blender"}};
  for (const auto& [content, name] : files) {
    for (const char* file : {"a.off", "a.obj", "a.vtk", "a.xyz", "a"}) {
      EXPECT_TRUE(has(read_kind(file, content).refusal, {name})) << file;
    }
  }
  EXPECT_TRUE(
      has(read_kind("a.step", "x").refusal, {"unknown extension \".step\"", ".off .obj .ply .stl", ".csv"}));
  EXPECT_TRUE(has(read_kind("a.obj", "hello\n").refusal, {"no line begins with v"}));
}

// ---- OFF

TEST(file_kinds, off_headers_of_every_variant_are_read) {
  const TriangleMesh m = test::small_mesh();
  const std::string plain = test::as_off(m), rest = plain.substr(plain.find('\n'));
  const std::string counts =
      std::to_string(m.vertices.size()) + " " + std::to_string(m.triangles.size()) + " 0\n";
  const std::string body = rest.substr(rest.find(counts) + counts.size());
  for (const std::string& header : {"off\n" + counts, "Off " + counts, "OFF" + counts, "off" + counts,
                                    "nOFF\n3\n" + counts, "nOFF 3\n" + counts, "coff\n" + counts}) {
    SCOPED_TRACE(header);
    expect_small_mesh(read_kind("a.off", header + body));
    EXPECT_EQ(certain_format(header + body), MeshFormat::off);
  }
  const std::string normals = test::as_off(m, true);
  expect_small_mesh(read_kind("a.off", replaced(normals, "NOFF", "noff")));
  EXPECT_FALSE(read_kind("a.off", replaced(normals, "NOFF", "noff")).file.points.normals.empty());
  expect_four_points(read_kind("a.off", "4OFF\n4 0 0\n0 0 0 1\n3 0 0 2\n0 -2.25 0 1\n0 0 -3 -1\n"));
  EXPECT_TRUE(has(read_kind("a.off", "4OFF\n4 0 0\n0 0 0 1\n3 0 0 0\n0 1 0 1\n0 0 1 1\n").refusal,
                  {"vertex 1", "w is 0", "line 4"}));
  EXPECT_TRUE(has(read_kind("a.off", "nOFF\n4\n4 0 0\n0 0 0 1\n").refusal,
                  {"dimension \"4\"", "line 2", "readable are OFF"}));
  EXPECT_TRUE(has(read_kind("a.off", "OFB\n4 0 0\n").refusal, {"begins with \"OFB\"", "COFF", "nOFF"}));
}

TEST(file_kinds, a_file_out_of_step_names_the_line_that_is_too_short) {
  const TriangleMesh m = test::small_mesh();
  const std::string off = replaced(test::as_off(m), "\n\n", "\n");
  const auto without_last_number = [](const std::string& text, std::size_t line) {
    std::size_t end = 0;
    for (; line > 0; --line) end = text.find('\n', end) + 1;
    const std::size_t blank = text.find_last_of(' ', end - 3);
    return text.substr(0, blank) + text.substr(end - 1);
  };
  // Line 4 has vertex 0, lines 24 and up the faces.
  EXPECT_TRUE(has(read_kind("a.off", without_last_number(off, 9)).refusal,
                  {"vertex 5 has too few numbers (line 9)"}));
  EXPECT_TRUE(has(read_kind("a.off", without_last_number(off, 30)).refusal,
                  {"face 6 has too few numbers (line 30)"}));
  EXPECT_TRUE(has(read_kind("a.off", off + "3 0 1 2\n").refusal,
                  {"\"3\" follows", "20 vertices and 36 faces", "line 60"}));
  const std::string ply = test::as_ply(m, Ply::ascii);
  EXPECT_TRUE(has(read_kind("a.ply", without_last_number(replaced(ply, " \n", "\n"), 15)).refusal,
                  {"the line of vertex 4 has too few values (line 15)"}));
  EXPECT_TRUE(has(read_kind("a.ply", replaced(ply, "end_header\n", "end_header\n1 2 3 4\n")).refusal,
                  {"the line of vertex 0 has too many values"}));
  EXPECT_TRUE(has(read_kind("a.ply", ply + "3 0 1 2\n").refusal, {"\"3\" follows after the last element"}));
  // Numbers may go on in the next line, as long as they are all there.
  expect_small_mesh(read_kind(
      "a.ply",
      replaced(ply, " ", "\n").replace(0, ply.find("end_header"), ply.substr(0, ply.find("end_header")))));
}

TEST(file_kinds, a_number_that_is_missing_does_not_move_those_after_it) {
  // The first face would take the 4 of the next line, and that would be a triangle.
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2\n4 3 2 "
      "1 0\n";
  EXPECT_TRUE(has(read_kind("a.ply", ply).refusal,
                  {"\"3\" follows on its line", "the line of face 0 has too few values (line 15)"}));
}

// ---- OBJ

TEST(file_kinds, obj_lines_of_every_kind_may_be_continued) {
  const TriangleMesh m = test::small_mesh();
  for (const std::string& end : {std::string("\n"), std::string("\r\n"), std::string("\r")}) {
    const std::string obj = replaced(test::as_obj(m, true), "\n", end);
    std::string continued;
    bool comment = false;
    for (const char c : obj) {
      comment = (comment || c == '#') && c != '\n' && c != '\r';
      if (c == ' ' && !comment)
        continued += continued.size() % 3 == 0 ? "\\" + end : " \\ " + end + " ";
      else
        continued += c;
    }
    const Reading reading = read_kind("a.obj", continued);
    expect_small_mesh(reading);
    EXPECT_EQ(reading.file.points.normals.size(), m.vertices.size());
  }
  // A comment does not go on.
  EXPECT_EQ(
      read_kind("a.obj", "# C:\\models\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n").file.points.points.size(),
      4u);
}

TEST(file_kinds, obj_faces_may_name_normals_and_textures_that_are_not_there) {
  const TriangleMesh m = test::small_mesh();
  const std::string with = test::as_obj(m, true);
  std::string without, both;
  for (std::size_t at = 0, end = 0; at < with.size(); at = end) {
    end = with.find('\n', at) + 1;
    const std::string line = with.substr(at, end - at);
    if (!line.starts_with("vn"))
      without += line, both += line.starts_with("f") ? replaced(line, "//", "/1/") : line;
  }
  for (const std::string& obj : {without, both}) {
    const Reading reading = read_kind("a.obj", obj);
    expect_small_mesh(reading);
    EXPECT_TRUE(reading.file.points.normals.empty());
    EXPECT_TRUE(has(reading.warnings,
                    {"faces name normals", "(line ", "but the file has none: normals are not used"}));
    EXPECT_EQ(std::count(reading.warnings.begin(), reading.warnings.end(), '\n'), 1);
  }
  // One is missing, or an index is impossible.
  const std::string one =
      with.substr(0, with.rfind("vn")) + with.substr(with.find('\n', with.rfind("vn")) + 1);
  EXPECT_TRUE(has(read_kind("a.obj", one).warnings, {"but the file has only 19"}));
  expect_small_mesh(read_kind("a.obj", one));
  for (const char* wrong : {"//0", "//-21", "//99999999999"}) {
    const Reading reading = read_kind("a.obj", replaced(with, "//1 ", wrong + std::string(" ")));
    expect_small_mesh(reading);
    EXPECT_TRUE(has(reading.warnings, {wrong, "only 20"}));
  }
  EXPECT_TRUE(has(read_kind("a.obj", replaced(with, "//1 ", "//x ")).refusal, {"is not a corner", "(line "}));
}

TEST(file_kinds, an_obj_model_is_the_same_without_the_normals_that_its_faces_name) {
  const std::string path = test::data_file("models/abc_00000801.obj.gz");
  if (path.empty()) GTEST_SKIP() << "no test data";
  const FileContent content = read_file_content(path, std::int64_t{1} << 30);
  std::string without;
  for (std::size_t at = 0, end = 0; at < content.view().size(); at = end) {
    end = std::min(content.view().find('\n', at), content.view().size() - 1) + 1;
    if (content.view().substr(at, 2) != "vn") without += content.view().substr(at, end - at);
  }
  const Reading with = read_path(path), stripped = read_kind("a.obj", without);
  EXPECT_TRUE(has(stripped.warnings, {"but the file has none"}));
  EXPECT_FALSE(with.file.points.normals.empty());
  EXPECT_EQ(stripped.file.points.points, with.file.points.points);
  EXPECT_EQ(stripped.file.mesh.vertices, with.file.mesh.vertices);
  EXPECT_EQ(stripped.file.mesh.triangles, with.file.mesh.triangles);
}

// ---- PLY

TEST(file_kinds, ply_faces_without_corners_are_no_cloud) {
  const std::string ply = test::as_ply(test::small_mesh(), Ply::ascii);
  EXPECT_TRUE(
      has(read_kind("a.ply", replaced(ply, "vertex_indices", "vertices_indices")).refusal,
          {"\"face\" no list vertex_indices or vertex_index of whole numbers", "list \"vertices_indices\""}));
  EXPECT_TRUE(has(read_kind("a.ply", replaced(ply, "uchar int", "uchar float")).refusal,
                  {"of whole numbers", "\"vertex_indices\" of floating-point numbers"}));
  EXPECT_TRUE(has(read_kind("a.ply", replaced(ply, "element face", "element faces")).refusal,
                  {"element \"faces\"", "call it face"}));
  EXPECT_TRUE(has(read_kind("a.ply", replaced(ply, "element vertex", "element vertices")).refusal,
                  {"no element \"vertex\"", "\"vertices\", \"face\""}));
  expect_small_mesh(read_kind("a.ply", replaced(ply, "vertex_indices", "vertex_index")));
}

TEST(file_kinds, the_line_ends_of_a_ply_header_do_not_eat_its_body) {
  TriangleMesh m = test::small_mesh();
  std::vector<Vec3> vertices(m.vertices.begin(), m.vertices.end());
  // The lowest byte of the first coordinate is that of a line feed, then that of a carriage return.
  for (const std::uint64_t first : {0x0aULL, 0x0dULL, 0x0a0dULL, 0x0d0aULL}) {
    vertices[0].x = std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) | first);
    m.vertices = vertices;
    const std::string ply = test::as_ply(m, Ply::little);
    const std::size_t body = ply.find("end_header\n") + 11;
    for (const std::string& end : {std::string("\n"), std::string("\r\n"), std::string("\r")}) {
      const Reading reading = read_kind("a.ply", replaced(ply.substr(0, body), "\n", end) + ply.substr(body));
      EXPECT_EQ(reading.refusal, "");
      EXPECT_EQ(reading.file.points.points, m.vertices);
    }
    EXPECT_TRUE(has(read_kind("a.ply", ply + "xyz").warnings, {"3 bytes after the last element"}));
  }
}

// ---- STL

TEST(file_kinds, binary_stl_is_read_by_its_length_where_its_count_is_too_small) {
  const std::string stl = test::as_binary_stl(test::small_mesh());
  for (const std::uint32_t count : {0u, 1u, 35u, 0xffffffffu}) {
    std::string wrong = stl.substr(0, 80);
    test::append(wrong, count);
    const Reading reading = read_kind("a.stl", wrong + stl.substr(84));
    expect_small_mesh(reading);
    EXPECT_TRUE(has(reading.warnings, {"promises " + std::to_string(count) + " facets", "that of 36"}));
  }
  std::string wrong = stl.substr(0, 80);
  test::append(wrong, std::uint32_t{37});
  EXPECT_TRUE(has(read_kind("a.stl", wrong + stl.substr(84)).refusal, {"promises 37 facets", "at most 36"}));
  EXPECT_TRUE(has(read_kind("a.stl", stl + "12345").warnings, {"5 bytes after the last of the 36 facets"}));
}

TEST(file_kinds, ascii_stl_is_read_word_by_word) {
  const std::string stl = test::as_ascii_stl(test::small_mesh());
  expect_small_mesh(read_kind("a.stl", replaced(stl, "endloop", "end loop")));
  expect_small_mesh(
      read_kind("a.stl", replaced(replaced(stl, "endfacet", "end facet"), "endsolid", "END SOLID")));
  expect_small_mesh(read_kind("a.stl", replaced(stl, " normal 0 0 0", "")));
  expect_small_mesh(read_kind("a.stl", replaced(stl, "0 0 0\n", "-nan(ind) 0 0\n")));
  std::string one_line_each;
  for (std::size_t at = 0; at < stl.size(); ++at) {
    const bool ends = stl.compare(at - std::min<std::size_t>(at, 8), 8, "endfacet") == 0;
    one_line_each += stl[at] == '\n' && !ends && at > 21 ? ' ' : stl[at];
  }
  expect_small_mesh(read_kind("a.stl", one_line_each));
  expect_small_mesh(read_kind("a.stl", replaced(stl, "\n", " ")));
  EXPECT_TRUE(has(read_kind("a.stl", replaced(stl, "endloop", "ende loop")).refusal,
                  {"\"endloop\" expected, found \"ende\"", "line 7"}));
  EXPECT_TRUE(
      has(read_kind("a.stl", stl.substr(0, stl.find("endsolid")) + "end\n").refusal, {"\"solid\" expected"}));
}

// ---- points

TEST(file_kinds, decimal_commas_never_become_other_coordinates) {
  expect_four_points(read_kind("a.xyz", "0 0 0\n1.5 0 0\n0 -2.25 0\n0 0 3\n"));
  for (const char* text : {"0,0 0,0 0,0\n1,5 0,0 0,0\n0,0 -2,25 0,0\n0,0 0,0 3,0\n",
                           "0 0 0\n1,5 0 0\n0 -2,25 0\n0 0 3\n", "0;0;0\n1,5;0;0\n0;-2,25;0\n0;0;3\n",
                           "0,0, 0,0, 0,0\n1,5, 0,0, 0,0\n0,0, -2,25, 0,0\n0,0, 0,0, 3,0\n",
                           "x\ty\tz\n0\t0\t0\n1,5\t0\t0\n0\t-2,25\t0\n0\t0\t3\n"}) {
    SCOPED_TRACE(text);
    const Reading reading = read_kind("a.xyz", text);
    expect_four_points(reading);
    EXPECT_TRUE(has(reading.warnings, {"decimal commas"}));
  }
  for (const char* text : {"0,0,0\n1.5,0,0\n0,-2.25,0\n0,0,3\n", "0, 0, 0\n1.5, 0, 0\n0, -2.25, 0\n0, 0, 3\n",
                           "0.0,0.0, 0.0\n1.5,0.0, 0.0\n0.0, -2.25,0.0\n0.0 ,0.0,3.0\n",
                           "0,0,0 9 9 9\n1.5,0,0 9 9 9\n0,-2.25,0 9 9 9\n0,0,3 9 9 9\n",
                           "x,y,z\n0,0,0\n1.5,0,0\n0,-2.25,0\n0,0,3\n",
                           "0,0,0,0,0,9\n1.5,0,0,0,0,9\n0,-2.25,0,0,0,9\n0,0,3,0,0,9\n"}) {
    SCOPED_TRACE(text);
    const Reading reading = read_kind("a.csv", text);
    expect_four_points(reading);
    EXPECT_EQ(reading.warnings.find("decimal"), std::string::npos);
  }
  const std::vector<std::pair<std::string, std::vector<std::string>>> refused = {
      {"1,5000,0,0000,0,0000\n0,0000,0,0000,0,0000\n0,0000,1,0000,0,0000\n0,0000,0,0000,1,0000\n",
       {"may separate or be decimal", "line 1", "decimal points"}},
      {"x,y,z\n0,0,0,0,0,0\n1,5,0,0,0,0\n", {"6 whole numbers between commas for 3 columns", "line 2"}},
      {"0,0,0\n1,5,0,0\n", {"has 4 of them and the first one 3 (line 1)", "(line 2)"}},
      {"1.234,5 0,1 0,2\n", {"or thousands", "line 1"}},
      {"1.234,5, 0,1, 0,2\n", {"or thousands", "line 1"}},
      {"0,0 0,0 0,0\n1,5,0\n", {"in another", "line 2"}},
      {"0,0,0\n1,5 0,0 0,0\n", {"in another", "line 2"}},
      {"1,,3,4\n", {"y is missing", "line 1"}},
      {"1.5,,3,4\n", {"y is missing", "line 1"}}};
  for (const auto& [text, words] : refused) EXPECT_TRUE(has(read_kind("a.txt", text).refusal, words)) << text;
  EXPECT_TRUE(has(read_kind("a.off", "OFF\n1 0 0\n1,5 0,0 0,0\n").refusal,
                  {"vertex 0", "\"1,5\"", "line 3", "decimal comma"}));
  EXPECT_TRUE(has(read_kind("a.obj", "v 1,5 0,0 0,0\n").refusal, {"decimal comma"}));
}

TEST(file_kinds, columns_are_found_by_their_names) {
  expect_four_points(read_kind("a.xyz", "X Y Z\n0 0 0\n1.5 0 0\n0 -2.25 0\n0 0 3\n"));
  expect_four_points(
      read_kind("a.csv", "id,\"Z [m]\",Y,X\n\"scan 1, a\",0,0,0\n7,0,0,1.5\n7,0,-2.25,0\n7,3,0,0\n"));
  expect_four_points(read_kind(
      "a.csv", "\"t\",\"Points:0\",\"Points:1\",\"Points:2\"\n1,0,0,0\n1,1.5,0,0\n1,0,-2.25,0\n1,0,0,3\n"));
  expect_four_points(read_kind("a.asc", "//X Y Z\n0 0 0\n1.5 0 0\n0 -2.25 0\n0 0 3\n"));
  const Reading normals =
      read_kind("a.csv", "nx,ny,nz,x,y,z\n0,0,2,0,0,0\n0,0,2,1.5,0,0\n0,0,2,0,-2.25,0\n0,0,2,0,0,3\n");
  expect_four_points(normals);
  EXPECT_EQ(normals.file.points.normals, (Array<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
  const Reading words = read_kind("a.xyz", "made by a scanner\n0 0 0\n1.5 0 0\n0 -2.25 0\n0 0 3\n");
  expect_four_points(words);
  EXPECT_TRUE(has(words.warnings, {"\"made by a scanner\", is passed over"}));
  EXPECT_TRUE(has(read_kind("a.xyz", "x y w\n0 0 0\n").refusal, {"not all of x, y and z", "line 1"}));
  EXPECT_TRUE(has(read_kind("a.xyz", "C 0 0 0\n").refusal, {"point 0: x is \"C\"", "line 1"}));
}

TEST(file_kinds, scans_one_after_another_are_joined) {
  const Reading reading = read_kind("a.pts", "2\n0 0 0\n1.5 0 0\n2\n0 -2.25 0\n0 0 3\n");
  expect_four_points(reading);
  EXPECT_TRUE(has(reading.warnings, {"2 scans"}));
  EXPECT_TRUE(has(read_kind("a.pts", "2\n0 0 0\n1.5 0 0\n3\n0 -2.25 0\n0 0 3\n").refusal,
                  {"promise 5 points, the file has 4"}));
  EXPECT_TRUE(has(read_kind("a.pts", "3\n0 0 0\n1.5 0 0\n2\n0 -2.25 0\n0 0 3\n").refusal,
                  {"point 2: y is missing", "line 4"}));
}

// ---- reported files

TEST(file_kinds, reported_files_are_read_as_what_they_mean) {
  const auto path = [](const char* name) { return test::data_file(std::string("reports/") + name); };
  if (path("README.md").empty()) GTEST_SKIP() << "no test data";
  const Reading obj = read_path(path("obj/vertex.obj"));
  ASSERT_EQ(obj.refusal, "");
  ASSERT_EQ(obj.file.points.points.size(), 288u);
  ASSERT_TRUE(mesh_topology(obj.file.mesh).closed);
  for (const char* name : {"bom/bom.obj", "off/lower.off", "off/modelnet.off", "off/noff4.off"}) {
    SCOPED_TRACE(name);
    const Reading reading = read_path(path(name));
    EXPECT_EQ(reading.refusal, "");
    EXPECT_EQ(reading.file.points.points, obj.file.points.points);
    EXPECT_EQ(mesh_topology(reading.file.mesh).genus, 1);
  }
  EXPECT_EQ(read_path(path("bom/bom.xyz")).file.points.points, obj.file.points.points);
  for (const char* name :
       {"bom/bom.stl", "stl/zero.stl", "stl/few.stl", "stl/end_space.stl.gz", "wrong_name/wrong.obj"}) {
    const Reading reading = read_path(path(name));
    EXPECT_EQ(reading.file.mesh.triangles.size(), 576u) << name << reading.refusal;
    EXPECT_TRUE(mesh_topology(reading.file.mesh).closed) << name;
  }
  const Reading csv = read_path(path("points/cloud.csv")), commas = read_path(path("comma/csv_like.txt"));
  EXPECT_EQ(csv.file.points.points.size(), 288u);
  EXPECT_EQ(read_path(path("points/header.xyz")).file.points.points, csv.file.points.points);
  EXPECT_EQ(read_path(path("points/two_scans.pts")).file.points.points.size(), 576u);
  EXPECT_EQ(read_path(path("comma/blank.xyz")).file.points.points, commas.file.points.points);
  EXPECT_TRUE(has(read_path(path("comma/comma.off")).refusal, {"decimal comma"}));
  for (const char* name : {"ply/indexes.ply", "ply/float_indices.ply"}) {
    EXPECT_TRUE(
        has(read_path(path(name)).refusal, {"no list vertex_indices or vertex_index of whole numbers"}));
  }
  EXPECT_EQ(mesh_topology(read_path(path("ply/cr.ply")).file.mesh).genus, 1);
  EXPECT_EQ(load_balls({path("balls/tree4.sph")}).balls.size(), 8u);
  EXPECT_EQ(load_balls({path("balls/bom.csv")}).balls.size(), 8u);
  EXPECT_EQ(load_balls({path("balls/diameter.ply")}).balls.radii, (Array<double>{1, 1}));
}

}  // namespace
}  // namespace ballflow::geometry

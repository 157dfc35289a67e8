#include "export/export.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

#include "ballflow/error.hpp"
#include "samples.hpp"
#include "sealed.hpp"
#include "show/typed.hpp"
#include "test_data.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::Array;
using geometry::Vec3;
using namespace test;
using Rows = std::vector<std::vector<double>>;

template <class T>
std::string exported(const T& value, const std::string& format) {
  const test::TempFolder folder;
  const std::string path = folder.file("out." + format);
  export_artifact(*sealed(value), path);
  return test::read_file(path);
}

/// Binary little-endian PLY: for each element its rows, each the concatenation of its properties, a list
/// with its count in front.
struct Ply {
  std::map<std::string, Rows> rows;
  std::map<std::string, std::vector<std::string>> properties;
};

double ply_number(const std::string& type, const std::string& bytes, std::size_t& at) {
  const auto take = [&](auto value) {
    if (at + sizeof value > bytes.size()) throw std::runtime_error("the file is too short");
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
    return static_cast<double>(value);
  };
  if (type == "double") return take(double{});
  if (type == "int") return take(std::int32_t{});
  if (type == "uchar") return take(std::uint8_t{});
  throw std::runtime_error("unexpected type " + type);
}

Ply read_ply(const std::string& bytes) {
  const std::string end = "end_header\n";
  std::size_t at = bytes.find(end);
  std::istringstream header(bytes.substr(0, at));
  at += end.size();
  std::string line;
  std::getline(header, line);
  EXPECT_EQ(line, "ply");
  std::getline(header, line);
  EXPECT_EQ(line, "format binary_little_endian 1.0");
  struct Element {
    std::string name;
    std::size_t count;
    std::vector<std::vector<std::string>> properties;
  };
  std::vector<Element> elements;
  while (std::getline(header, line)) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words[0] == "element") elements.push_back({words[1], std::stoul(words[2]), {}});
    if (words[0] == "property") elements.back().properties.push_back(words);
  }
  Ply ply;
  for (const Element& element : elements) {
    for (const auto& words : element.properties) ply.properties[element.name].push_back(words.back());
    Rows& rows = ply.rows[element.name];
    for (std::size_t i = 0; i < element.count; ++i) {
      auto& row = rows.emplace_back();
      for (const auto& words : element.properties) {
        if (words[1] != "list") {
          row.push_back(ply_number(words[1], bytes, at));
          continue;
        }
        row.push_back(ply_number(words[2], bytes, at));
        for (double k = row.back(); k > 0; --k) row.push_back(ply_number(words[3], bytes, at));
      }
    }
  }
  EXPECT_EQ(at, bytes.size()) << "nothing follows the last element";
  return ply;
}

/// Numbers of a text, line by line; `skip` lines at the start are left out.
Rows read_numbers(const std::string& text, char separator, int skip) {
  std::istringstream lines(text);
  std::string line;
  Rows rows;
  while (std::getline(lines, line)) {
    if (skip-- > 0) continue;
    std::istringstream cells(line);
    auto& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, separator);) row.push_back(std::stod(cell));
  }
  return rows;
}

/// OBJ lines of one kind ("v", "f", "l").
Rows read_obj(const std::string& text, const std::string& kind) {
  std::istringstream lines(text);
  std::string line;
  Rows rows;
  while (std::getline(lines, line)) {
    if (line.rfind(kind + " ", 0) == 0)
      rows.push_back(read_numbers(line.substr(kind.size() + 1), ' ', 0).front());
  }
  return rows;
}

TEST(export_points, keep_every_bit_and_their_normals) {
  const Rows bare = {{odd.x, odd.y, odd.z}, {far.x, far.y, far.z}, {1, 2, 3}};
  Rows with_normals = bare;
  with_normals[0].insert(with_normals[0].end(), {1, 0, 0});
  with_normals[1].insert(with_normals[1].end(), {0, 0, -1});
  with_normals[2].insert(with_normals[2].end(), {0.6, 0.8, 0});
  for (const bool normals : {false, true}) {
    const auto set = sample_points(normals);
    const Rows& expected = normals ? with_normals : bare;
    const Ply ply = read_ply(exported(set, "ply"));
    EXPECT_EQ(ply.rows.at("vertex"), expected);
    EXPECT_EQ(ply.properties.at("vertex").size(), normals ? 6u : 3u);
    EXPECT_EQ(read_numbers(exported(set, "xyz"), ' ', 0), expected);
    const std::string csv = exported(set, "csv");
    EXPECT_EQ(csv.substr(0, csv.find('\n')), normals ? "x,y,z,nx,ny,nz" : "x,y,z");
    EXPECT_EQ(read_numbers(csv, ',', 1), expected);
    EXPECT_EQ(exported(set, "off").rfind("OFF\n3 0 0\n", 0), 0u);
    EXPECT_EQ(read_numbers(exported(set, "off"), ' ', 2), bare);
  }
}

TEST(export_mesh, reads_back_from_every_format) {
  const auto mesh = sample_mesh();
  const Rows vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const Rows counted = {{3, 0, 2, 1}, {3, 0, 1, 3}, {3, 0, 3, 2}, {3, 1, 2, 3}};
  const Ply ply = read_ply(exported(mesh, "ply"));
  EXPECT_EQ(ply.rows.at("vertex"), vertices);
  EXPECT_EQ(ply.rows.at("face"), counted);
  EXPECT_EQ(ply.properties.at("face"), (std::vector<std::string>{"vertex_indices"}));

  const std::string obj = exported(mesh, "obj");
  EXPECT_EQ(read_obj(obj, "v"), vertices);
  EXPECT_EQ(read_obj(obj, "f"), (Rows{{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}));

  const std::string off = exported(mesh, "off");
  EXPECT_EQ(off.rfind("OFF\n4 4 0\n", 0), 0u);
  Rows lines = read_numbers(off, ' ', 2);
  EXPECT_EQ(Rows(lines.begin(), lines.begin() + 4), vertices);
  EXPECT_EQ(Rows(lines.begin() + 4, lines.end()), counted);
}

TEST(export_mesh, stl_has_corners_in_order_and_outward_unit_normals) {
  const auto mesh = sample_mesh();
  const std::string stl = exported(mesh, "stl");
  ASSERT_EQ(stl.size(), 84u + 50u * 4u);
  EXPECT_NE(stl.substr(0, 5), "solid");
  std::uint32_t count = 0;
  std::memcpy(&count, stl.data() + 80, 4);
  EXPECT_EQ(count, 4u);
  const float third = static_cast<float>(1 / std::sqrt(3.0));
  const std::array<std::array<float, 3>, 4> normals = {
      {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {third, third, third}}};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<float, 12> values{};
    std::memcpy(values.data(), stl.data() + 84 + 50 * i, sizeof values);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_FLOAT_EQ(values[k], normals[i][k]);
      const Vec3 corner = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
      EXPECT_EQ(values[3 + 3 * k], static_cast<float>(corner.x));
      EXPECT_EQ(values[4 + 3 * k], static_cast<float>(corner.y));
      EXPECT_EQ(values[5 + 3 * k], static_cast<float>(corner.z));
    }
  }
}

TEST(export_mesh, stl_refuses_coordinates_beyond_floats) {
  const geometry::TriangleMesh mesh{{{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const test::TempFolder folder;
  EXPECT_THROW(export_artifact(*sealed(mesh), folder.file("a.stl")), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(export_balls, keep_radii) {
  const auto balls = sample_balls();
  const Rows expected = {{odd.x, odd.y, odd.z, 0.1}, {far.x, far.y, far.z, 7}};
  const Ply ply = read_ply(exported(balls, "ply"));
  EXPECT_EQ(ply.rows.at("vertex"), expected);
  EXPECT_EQ(ply.properties.at("vertex"), (std::vector<std::string>{"x", "y", "z", "radius"}));
  const std::string csv = exported(balls, "csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "x,y,z,r");
  EXPECT_EQ(read_numbers(csv, ',', 1), expected);
  EXPECT_EQ(read_obj(exported(balls, "obj"), "v"), (Rows{{odd.x, odd.y, odd.z}, {far.x, far.y, far.z}}));
}

TEST(export_balls, of_no_ball_is_a_valid_file) {
  const Ply ply = read_ply(exported(geometry::Balls{}, "ply"));
  EXPECT_TRUE(ply.rows.at("vertex").empty());
  EXPECT_EQ(exported(geometry::Balls{}, "csv"), "x,y,z,r\n");
}

TEST(export_poles, keep_radii_and_labels) {
  const Rows expected = {{odd.x, odd.y, odd.z, 0.25, 2}, {far.x, far.y, far.z, 0.3, 1}};
  EXPECT_EQ(read_ply(exported(sample_poles(), "ply")).rows.at("vertex"), expected);
  EXPECT_EQ(read_numbers(exported(sample_poles(), "csv"), ',', 1), expected);
}

TEST(export_complex, draws_what_can_be_seen_with_vertices_numbered_anew) {
  const auto complex = sample_complex();
  Rows vertices, centers;
  for (const std::int32_t v : complex.vertices) {
    const Vec3 c = complex.centers[static_cast<std::size_t>(v)];
    centers.push_back({c.x, c.y, c.z});
    vertices.push_back({c.x, c.y, c.z, 1.0 * v});  // weight v * v
  }
  const Ply ply = read_ply(exported(complex, "ply"));
  EXPECT_EQ(ply.rows.at("vertex"), vertices);
  EXPECT_EQ(ply.rows.at("face"), (Rows{{3, 0, 1, 2, 1}, {3, 0, 1, 3, 1}, {3, 1, 2, 3, 1}, {3, 3, 4, 5, 2}}));
  EXPECT_EQ(ply.rows.at("edge"), (Rows{{5, 6}}));
  EXPECT_EQ(ply.properties.at("edge"), (std::vector<std::string>{"vertex1", "vertex2"}));

  const std::string obj = exported(complex, "obj");
  EXPECT_EQ(read_obj(obj, "v"), centers);
  EXPECT_EQ(read_obj(obj, "f"), (Rows{{1, 2, 3}, {1, 2, 4}, {2, 3, 4}, {4, 5, 6}}));
  EXPECT_EQ(read_obj(obj, "l"), (Rows{{6, 7}}));

  const Rows off = read_numbers(exported(complex, "off"), ' ', 2);
  EXPECT_EQ(Rows(off.begin(), off.begin() + 8), centers);
  EXPECT_EQ(Rows(off.begin() + 8, off.end()), (Rows{{3, 0, 1, 2}, {3, 0, 1, 3}, {3, 1, 2, 3}, {3, 3, 4, 5}}));
}

TEST(export_axis, keeps_polygons_edges_and_radii) {
  const auto axis = sample_axis();
  Rows centers = {{odd.x, odd.y, odd.z}, {far.x, far.y, far.z}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}};
  Rows vertices = centers;
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].push_back(axis.radii[i]);
  const Ply ply = read_ply(exported(axis, "ply"));
  EXPECT_EQ(ply.rows.at("vertex"), vertices);
  EXPECT_EQ(ply.rows.at("face"), (Rows{{3, 0, 1, 2, 0, 0}, {5, 4, 3, 2, 1, 0, 1, 0}}));
  EXPECT_EQ(ply.rows.at("edge"), (Rows{{0, 5}}));

  const std::string obj = exported(axis, "obj");
  EXPECT_EQ(read_obj(obj, "v"), centers);
  EXPECT_EQ(read_obj(obj, "f"), (Rows{{1, 2, 3}, {5, 4, 3, 2, 1}}));
  EXPECT_EQ(read_obj(obj, "l"), (Rows{{1, 6}}));

  const Rows off = read_numbers(exported(axis, "off"), ' ', 2);
  EXPECT_EQ(Rows(off.begin() + 6, off.end()), (Rows{{3, 0, 1, 2}, {5, 4, 3, 2, 1, 0}}));
}

TEST(export_axis, writes_polygons_of_more_corners_than_a_byte_counts) {
  geometry::MedialAxis axis;
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> corners;
  for (std::int32_t i = 0; i < 300; ++i) {
    vertices.push_back({1.0 * i, 1.0 * i * i, 0});
    corners.push_back(i);
  }
  axis.vertices = vertices;
  axis.radii = std::vector<double>(300, 1.0);
  axis.polygon_offsets = {0, 300};
  axis.polygon_vertices = corners;
  axis.polygon_kinds = {1};
  axis = with_sheets(std::move(axis));
  const Rows faces = read_ply(exported(axis, "ply")).rows.at("face");
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].size(), 303u);
  EXPECT_EQ(faces[0][300], 299);
}

TEST(export_any, safetensors_is_the_artifact_itself) {
  const ArtifactPtr artifact = sealed(sample_complex());
  const test::TempFolder folder;
  const std::string path = folder.file("a.safetensors");
  export_artifact(*artifact, path);
  const ArtifactPtr back = Artifact::map(path);
  EXPECT_EQ(back->digest(), artifact->digest());
  EXPECT_EQ(typed<geometry::SimplicialComplex>(*back).triangles, sample_complex().triangles);
}

TEST(export_any, json_tells_type_summary_and_shapes) {
  geometry::CoverCheck check;
  check.balls = 4;
  check.samples = 9;
  check.uncovered = {2, 8};
  const Json json = Json::parse(exported(check, "json"));
  EXPECT_EQ(json["type"], "CoverCheck");
  EXPECT_EQ(json["summary"]["covered"], 7);
  EXPECT_EQ(json["digest"], sealed(check)->digest().hex());
  const auto uncovered = std::find_if(json["arrays"].begin(), json["arrays"].end(),
                                      [](const Json& array) { return array["name"] == "uncovered"; });
  ASSERT_NE(uncovered, json["arrays"].end());
  EXPECT_EQ(uncovered->at("dtype"), "i32");
  EXPECT_EQ(uncovered->at("shape"), Json::array({2}));
}

TEST(export_any, type_of_a_foreign_plugin_has_the_generic_formats) {
  EXPECT_EQ(default_format("Voxels"), "json");
  EXPECT_EQ(export_formats("Voxels"), (std::vector<std::string>{"json", "safetensors"}));
  EXPECT_EQ(default_format("Balls"), "ply");
  EXPECT_EQ(export_formats(*sealed(sample_balls())),
            (std::vector<std::string>{"ply", "csv", "obj", "vtp", "npy", "glb", "ma", "sph", "yaml", "urdf",
                                      "svg", "json", "safetensors"}));
}

TEST(export_any, format_is_the_extension_in_any_case_unless_given) {
  const test::TempFolder folder;
  const ArtifactPtr artifact = sealed(sample_balls());
  export_artifact(*artifact, folder.file("a.CSV"));
  EXPECT_EQ(test::read_file(folder.file("a.CSV")).substr(0, 8), "x,y,z,r\n");
  export_artifact(*artifact, folder.file("b.txt"), "csv");
  EXPECT_EQ(test::read_file(folder.file("b.txt")), test::read_file(folder.file("a.CSV")));
}

TEST(export_any, unknown_format_lists_the_known_ones) {
  const test::TempFolder folder;
  for (const char* name : {"a.stl", "a"}) {
    try {
      export_artifact(*sealed(sample_balls()), folder.file(name));
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(
          error.hint().find("ply, csv, obj, vtp, npy, glb, ma, sph, yaml, urdf, svg, json, safetensors"),
          std::string::npos)
          << error.hint();
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(export_any, refuses_arrays_that_break_the_type) {
  const test::TempFolder folder;
  const std::vector<double> radii = {1, 2}, centers = {0, 0, 0};
  const auto lies = [&](std::uint64_t rows) {
    return Artifact::seal(
        "Balls", 1, {{"centers", BF_F64, {rows, 3}, centers.data()}, {"radii", BF_F64, {2}, radii.data()}},
        "{}", nullptr);
  };
  test::write_file(folder.file("a.ply"), "before");
  EXPECT_THROW(export_artifact(*lies(1), folder.file("a.ply")), Error);
  EXPECT_THROW(
      export_artifact(*Artifact::seal("Balls", 1, {{"radii", BF_F64, {2}, radii.data()}}, "{}", nullptr),
                      folder.file("a.ply")),
      Error);
  EXPECT_EQ(test::read_file(folder.file("a.ply")), "before");
  // No temporary file is left behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(export_any, replaces_the_target_of_a_link_and_keeps_the_link) {
  const test::TempFolder folder;
  test::write_file(folder.file("real.csv"), "before");
  std::filesystem::create_symlink(folder.file("real.csv"), folder.file("link.csv"));
  export_artifact(*sealed(sample_balls()), folder.file("link.csv"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.csv")));
  EXPECT_EQ(test::read_file(folder.file("real.csv")).substr(0, 8), "x,y,z,r\n");
}

TEST(export_any, writes_devices_directly) {
  export_artifact(*sealed(sample_balls()), "/dev/null", "csv");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(export_artifact(*sealed(sample_balls()), "/dev/full", "csv"), Error);
  }
}

TEST(export_any, names_the_file_that_cannot_be_written) {
  try {
    export_artifact(*sealed(sample_balls()), "/no/such/folder/a.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::store);
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/a.csv"), std::string::npos);
  }
}

TEST(CoverStates, are_json_unless_a_format_of_other_solvers_is_asked_for) {
  geometry::CoverState cover;
  cover.balls = cover.samples = 2;
  cover.row_offsets = {0, 2, 3};
  cover.columns = {0, 1, 1};
  cover.row_ids = cover.column_ids = {0, 1};
  EXPECT_EQ(default_format("CoverState"), "json");
  EXPECT_EQ(export_formats("CoverState"),
            (std::vector<std::string>{"json", "scp", "lp", "csv", "safetensors"}));
  EXPECT_EQ(exported(cover, "scp"), " 2 2\n 1 1\n 1\n 1\n 2\n 1 2\n");
  EXPECT_NE(exported(cover, "lp").find("s1: b0 + b1 >= 1"), std::string::npos);
}

}  // namespace
}  // namespace ballflow

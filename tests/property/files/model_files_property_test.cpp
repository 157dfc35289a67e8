// Files made from one model by what its format allows give the same points, triangles and normals; files with
// one thing wrong are refused with its line. BALLFLOW_TEST_FILES: how many of each.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/read_mesh.hpp"
#include "mesh_files.hpp"
#include "model_writer.hpp"
#include "test_data.hpp"
#include "zstd_files.hpp"

namespace ballflow::test {
namespace {

std::uint64_t rounds() {
  const char* const text = std::getenv("BALLFLOW_TEST_FILES");
  return text == nullptr ? 300 : std::strtoull(text, nullptr, 10);
}

/// Blanks, line ends, comments and empty lines as the format has them.
std::string written(const ModelText& text, Dice& dice, bool free_lines) {
  const std::string end = dice.one_of({"\n", "\r\n", "\r"});
  const bool is_ply = text.lines[0].tokens == std::vector<std::string>{"ply"};
  const bool is_stl = !is_ply && text.lines.back().kind == LineKind::words;
  std::string result = dice.once_in(3) ? "\xef\xbb\xbf" : "";
  bool in_body = !is_ply;
  for (const ModelText::Line& line : text.lines) {
    for (std::size_t k = 0; k < line.tokens.size(); ++k) {
      if (k == 0 && in_body && dice.once_in(6)) result += dice.one_of({" ", "\t", "   "});
      if (k > 0 && text.separator != ' ') {
        result += text.separator;
        if (text.separator != '\t' && dice.once_in(8)) result += " ";
      } else if (k > 0) {
        result += in_body ? dice.one_of({" ", " ", "  ", "\t"}) : " ";
        if (free_lines && text.continued && dice.once_in(12)) result += "\\" + end;
      }
      result += line.tokens[k];
    }
    result += line.comment;
    if (!is_ply && !is_stl && text.separator == ' ' && !line.tokens.empty() && dice.once_in(9))
      result += " # 7 8 9";
    if (in_body && text.separator == ' ' && dice.once_in(7)) result += "  ";
    result += end;
    if (free_lines && in_body && dice.once_in(11)) result += end;
    in_body = in_body || line.tokens == std::vector<std::string>{"end_header"};
  }
  // The last line may lack its end.
  if (dice.once_in(3)) result.resize(result.size() - end.size());
  if (dice.once_in(9)) result += "\x1a";
  return result;
}

std::string packed(std::string content, Dice& dice, std::string& name) {
  switch (dice.below(5)) {
    case 0:
      if (dice.once_in(2)) name += ".gz";
      return gzipped(content);
    case 1:
      if (dice.once_in(2)) name += ".zst";
      return zstd_packed(content);
    case 2:
      return gzipped(content.substr(0, content.size() / 2)) + gzipped(content.substr(content.size() / 2));
    default:
      return content;
  }
}

/// A binary file, and its name.
std::pair<std::string, std::string> binary(const PolygonModel& model, Dice& dice, bool& normals) {
  const geometry::TriangleMesh mesh{model.vertices, model.triangles()};
  if (dice.once_in(2)) {
    normals = false;
    const std::string stl =
        as_binary_stl(mesh, dice.one_of({"binary", "solid, it says", "\xef\xbb\xbfmade by a test"}));
    if (dice.once_in(2)) return {dice.one_of({"a.stl", "a.STL", "a", "a.obj"}), stl};
    std::string wrong = stl.substr(0, 80);
    append(wrong, dice.one_of({std::uint32_t{0}, std::uint32_t{1}, std::uint32_t{0xffffffff}}));
    return {"a.stl", wrong + stl.substr(84)};
  }
  normals = dice.once_in(2);
  std::string ply = as_ply(mesh, dice.once_in(2) ? Ply::big : Ply::little, normals, dice.once_in(2));
  const std::size_t body = ply.find("end_header\n") + 11;
  const std::string end = dice.one_of({"\n", "\r\n", "\r"});
  std::string header = dice.once_in(3) ? "\xef\xbb\xbf" : "";
  for (const char c : ply.substr(0, body)) header += c == '\n' ? end : std::string(1, c);
  return {dice.one_of({"a.ply", "a.PLY", "a", "a.off"}), header + ply.substr(body)};
}

ModelText random_text(const PolygonModel& model, Dice& dice) {
  ModelWriter writer(model, dice);
  switch (dice.below(5)) {
    case 0:
      return writer.off();
    case 1:
      return writer.obj();
    case 2:
      return writer.ply();
    case 3:
      return writer.stl();
    default:
      return writer.xyz();
  }
}

TEST(model_files, of_one_model_give_one_model_however_they_are_written) {
  const TempFolder folder;
  for (std::uint64_t seed = 0; seed < rounds(); ++seed) {
    Dice dice(seed);
    const PolygonModel model = random_prism(dice);
    std::string name, content;
    bool normals = false, mesh = true;
    if (dice.once_in(5)) {
      std::tie(name, content) = binary(model, dice, normals);
    } else {
      const ModelText text = random_text(model, dice);
      name = text.name;
      normals = text.normals;
      mesh = text.mesh;
      content = written(text, dice, true);
    }
    const std::string bytes = packed(content, dice, name);
    write_file(folder.file(name), bytes);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << name << ":\n" << content.substr(0, 600));
    try {
      const geometry::MeshFile file = geometry::read_mesh_file(folder.file(name));
      ASSERT_EQ(file.points.points, geometry::Array<geometry::Vec3>(model.vertices));
      ASSERT_EQ(file.mesh.triangles, geometry::Array<geometry::Triangle>(
                                         mesh ? model.triangles() : std::vector<geometry::Triangle>{}));
      ASSERT_EQ(file.points.normals.size(), normals ? model.vertices.size() : 0u);
      for (std::size_t v = 0; v < file.points.normals.size(); ++v) {
        ASSERT_LT(geometry::distance(file.points.normals[v], made_up_normal(v)), 1e-12);
      }
    } catch (const geometry::InputError& error) {
      FAIL() << error.what();
    }
  }
}

/// Damages one line; false when this model text has no place for the damage that was drawn.
bool damage(ModelText& text, Dice& dice, std::size_t& damaged) {
  std::vector<std::size_t> places;
  const LineKind kind = dice.one_of({LineKind::vertex, LineKind::face, LineKind::words});
  for (std::size_t l = 0; l < text.lines.size(); ++l) {
    if (text.lines[l].kind == kind && text.lines[l].needed > 0) places.push_back(l);
  }
  if (places.empty()) return false;
  damaged = places[dice.below(places.size())];
  ModelText::Line& line = text.lines[damaged];
  const bool keyword = line.tokens[0] == "f" || line.tokens[0] == "v" || line.tokens[0] == "vertex" ||
                       line.tokens[0] == "VERTEX";
  const std::size_t first = keyword ? 1 : 0;
  if (kind == LineKind::words) {
    line.tokens[dice.below(line.needed)] = dice.one_of({"facte", "7", "endlop", "vertex1"});
    return true;
  }
  const bool ply = text.lines[0].tokens == std::vector<std::string>{"ply"};
  const std::size_t place = first + dice.below(line.needed - first);
  // A colour before the coordinates is passed over, whatever number it is.
  if (ply && kind == LineKind::vertex && line.tokens.size() % 3 == 1 && place == 0) return false;
  std::string& token = line.tokens[place];
  const bool extra = line.tokens.size() > line.needed;
  const bool obj = line.tokens[0] == "f" || line.tokens[0] == "v";
  switch (dice.below(3)) {
    case 0:
      token = kind == LineKind::vertex
                  ? dice.one_of({"x", "--1", "1.2.3", "1e999", "nan", "inf", "0x10", "1,5,2"})
                  : dice.one_of({"x", "--1", "1.5", "nan", "0x10"});
      // Normals of PLY that are no numbers are left out, with a warning.
      return !(ply && (token == "nan" || token == "inf") && line.tokens.size() > 4 &&
               place >= line.tokens.size() - 3);
    case 1:
      if (kind != LineKind::face) return false;
      line.tokens[line.needed - 1] = dice.one_of({"99999", "-99999", "2147483648", "99999999999999999999"});
      return true;
    default:
      // What is left of an OBJ face is a face, and colours would take the place of a coordinate.
      if (extra || (obj && kind == LineKind::face) || (!text.mesh && line.tokens.size() > 3)) {
        return false;
      }
      line.tokens.pop_back();
      return true;
  }
}

TEST(model_files, with_one_thing_wrong_are_refused_with_its_line) {
  const TempFolder folder;
  std::uint64_t tried = 0;
  for (std::uint64_t seed = 0; tried < rounds(); ++seed) {
    Dice dice(1000000 + seed);
    const PolygonModel model = random_prism(dice);
    ModelText text = random_text(model, dice);
    std::size_t damaged = 0;
    if (!damage(text, dice, damaged)) continue;
    ++tried;
    // What is damaged need not betray its format any more.
    std::string name = text.proper_name;
    const std::string content = written(text, dice, false);
    const std::string bytes = packed(content, dice, name);
    write_file(folder.file(name), bytes);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << name << ", line " << damaged + 1 << ":\n"
                                    << content);
    try {
      geometry::read_mesh_file(folder.file(name));
      FAIL() << "it was read";
    } catch (const geometry::InputError& error) {
      const std::string what = error.what();
      ASSERT_NE(what.find("(line " + std::to_string(damaged + 1) + ")"), std::string::npos) << what;
      ASSERT_NE(what.find('\n'), std::string::npos) << "no hint";
    }
  }
}

TEST(model_files, with_lines_that_the_header_does_not_promise_are_refused) {
  const TempFolder folder;
  for (std::uint64_t seed = 0; seed < rounds() / 4; ++seed) {
    Dice dice(2000000 + seed);
    const PolygonModel model = random_prism(dice);
    ModelWriter writer(model, dice);
    ModelText text = dice.once_in(2) ? writer.off() : writer.ply();
    std::vector<std::size_t> elements;
    for (std::size_t l = 0; l < text.lines.size(); ++l) {
      if (text.lines[l].needed > 0) elements.push_back(l);
    }
    const auto place =
        text.lines.begin() + static_cast<std::ptrdiff_t>(elements[dice.below(elements.size())]);
    if (dice.once_in(2)) {
      text.lines.erase(place);
    } else {
      text.lines.insert(place, ModelText::Line(*place));
    }
    std::string name = text.name;
    const std::string content = written(text, dice, false);
    write_file(folder.file(name), content);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << name << ":\n" << content);
    try {
      geometry::read_mesh_file(folder.file(name));
      FAIL() << "it was read";
    } catch (const geometry::InputError& error) {
      ASSERT_NE(std::string(error.what()).find("(line "), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ballflow::test

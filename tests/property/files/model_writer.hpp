// Model files written in every legal way: one model, and a style that is drawn at random.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "mesh_files.hpp"

namespace ballflow::test {

/// A closed mesh of convex flat polygons. Its coordinates are floats, its vertices are numbered as the fans
/// of its faces meet them, so that every format gives the same model.
struct PolygonModel {
  std::vector<geometry::Vec3> vertices;
  std::vector<std::vector<std::int32_t>> faces;

  std::vector<geometry::Triangle> triangles() const {
    std::vector<geometry::Triangle> result;
    for (const auto& face : faces) {
      for (std::size_t k = 2; k < face.size(); ++k) result.push_back({face[0], face[k - 1], face[k]});
    }
    return result;
  }
};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.bits() % n); }
  bool once_in(std::size_t n) { return below(n) == 0; }
  template <class T, std::size_t n>
  const T& one_of(const T (&list)[n]) {
    return list[below(n)];
  }
  double real() { return static_cast<double>(random_.bits() >> 11) * 0x1p-53; }

 private:
  geometry::Random random_;
};

/// A prism over a convex polygon of 3 to 9 corners.
inline PolygonModel random_prism(Dice& dice) {
  const std::size_t n = 3 + dice.below(7);
  const double size = std::ldexp(1, static_cast<int>(dice.below(30)) - 15);
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  std::vector<geometry::Vec3> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle =
        6.283185307179586 * (static_cast<double>(i) + 0.5 * dice.real()) / static_cast<double>(n);
    corners.push_back({rounded(size * std::cos(angle)), rounded(size * std::sin(angle)), 0});
  }
  const double height = rounded(size * (0.1 + dice.real())),
               shift = dice.once_in(2) ? 0 : rounded(100 * size);
  for (auto& p : corners) p.x = rounded(p.x + shift);
  std::vector<std::vector<std::int32_t>> faces(2);
  const auto count = static_cast<std::int32_t>(n);
  for (std::int32_t i = 0; i < count; ++i) {
    faces[0].push_back(count - 1 - i);
    faces[1].push_back(count + i);
    faces.push_back({i, (i + 1) % count, (i + 1) % count + count, i + count});
  }
  PolygonModel model;
  std::vector<std::int32_t> number(2 * n, -1);
  for (auto& face : faces) {
    for (std::int32_t& v : face) {
      std::int32_t& id = number[static_cast<std::size_t>(v)];
      if (id < 0) {
        id = static_cast<std::int32_t>(model.vertices.size());
        model.vertices.push_back(corners[static_cast<std::size_t>(v % count)] +
                                 geometry::Vec3{0, 0, v < count ? 0 : height});
      }
      v = id;
    }
  }
  model.faces = std::move(faces);
  return model;
}

/// A number in one of the ways that read back as the same double.
inline std::string number(double x, Dice& dice) {
  char text_of[64];
  static constexpr const char* const formats[] = {"%.17g", "%.17e", "%.20f", "%+.17g",
                                                  "%.17G", "%.30g", "%#.17g"};
  switch (dice.below(3)) {
    case 0: {
      std::snprintf(text_of, sizeof text_of, dice.one_of(formats), x);
      return std::strtod(text_of, nullptr) == x ? text_of : text(x);
    }
    case 1: {
      std::string shortest = text(x);
      if (shortest.starts_with("0.")) return shortest.substr(1);
      if (shortest.starts_with("-0.")) return "-" + shortest.substr(2);
      return shortest.find_first_of(".e") == std::string::npos
                 ? shortest + dice.one_of({".", ".0", "e0", ".000E+00"})
                 : shortest;
    }
    default:
      return text(x);
  }
}

/// What a line of a text file is, for those that damage it.
enum class LineKind { other, vertex, face, words };

/// The lines of a text file and how they are written.
struct ModelText {
  struct Line {
    std::vector<std::string> tokens;
    LineKind kind = LineKind::other;
    std::size_t needed = 0;  // tokens after which nothing is looked at; the first one may be a keyword
    std::string comment = {};
  };
  std::string name, proper_name;  // of the file; names may be wrong where the content is certain
  std::vector<Line> lines;
  bool normals = false;
  bool mesh = true;
  char separator = ' ';
  bool continued = false;  // lines may go on after a backslash
};

class ModelWriter {
 public:
  ModelWriter(const PolygonModel& model, Dice& dice) : model_(model), dice_(dice) {
    const bool polygons = dice.once_in(2);
    for (const auto& face : model.faces) {
      if (polygons) {
        faces_.push_back(face);
      } else {
        for (std::size_t k = 2; k < face.size(); ++k) faces_.push_back({face[0], face[k - 1], face[k]});
      }
    }
  }

  ModelText off() {
    const bool normals = dice_.once_in(3), colours = dice_.once_in(4),
               homogeneous = !normals && dice_.once_in(5);
    text_ = {
        dice_.one_of({"a.off", "a.OFF", "a", "a.txt", "a.obj", "a.coff", "a.unknown"}), "a.off", {}, normals};
    std::string keyword =
        std::string(colours ? "C" : "") + (normals ? "N" : "") + (homogeneous ? "4" : "") + "OFF";
    if (keyword == "OFF") keyword = dice_.one_of({"OFF", "off", "Off"});
    comments();
    const std::string counts[] = {std::to_string(model_.vertices.size()), std::to_string(faces_.size()), "0"};
    switch (dice_.below(4)) {
      case 0:
        add({keyword, counts[0], counts[1], counts[2]});
        break;
      case 1:
        add({keyword + counts[0], counts[1], counts[2]});
        break;
      default:
        add({keyword});
        comments();
        add({counts[0], counts[1], counts[2]});
    }
    for (std::size_t v = 0; v < model_.vertices.size(); ++v) {
      auto& line = add_point({}, v, normals);
      if (homogeneous) line.tokens.push_back(dice_.one_of({"1", "1.0"}));
      line.needed = line.tokens.size();
      if (colours) line.tokens.insert(line.tokens.end(), {"255", "0", "7", "255"});
    }
    for (const auto& face : faces_) {
      auto& line = add({std::to_string(face.size())}, LineKind::face);
      for (const std::int32_t v : face) line.tokens.push_back(std::to_string(v));
      line.needed = line.tokens.size();
      if (dice_.once_in(4)) line.tokens.insert(line.tokens.end(), {"0.5", "0.25", "1"});
    }
    return std::move(text_);
  }

  ModelText obj() {
    // 0: v, 1: v/vt, 2: v//vn, 3: v/vt/vn, 4: v//vn without normals
    const std::size_t style = dice_.below(5);
    const bool normals = style == 2 || style == 3, before = dice_.once_in(3),
               negative = !before && dice_.once_in(2);
    text_ = {dice_.one_of({"a.obj", "a.OBJ", "a", "a.dat", "a.stl", "a.none"}), "a.obj", {}, normals};
    text_.continued = true;
    comments();
    if (dice_.once_in(2)) add({"mtllib", "a.mtl"});
    if (before) obj_faces(style, negative);
    for (std::size_t v = 0; v < model_.vertices.size(); ++v) {
      auto& line = add_point({"v"}, v, false);
      line.needed = line.tokens.size();
      if (dice_.once_in(5)) line.tokens.push_back("1.0");
    }
    for (std::size_t v = 0; v < model_.vertices.size() && normals; ++v) {
      const auto n = made_up_normal(v);
      add({"vn", number(n.x, dice_), number(n.y, dice_), number(n.z, dice_)});
    }
    if (dice_.once_in(2)) add({dice_.one_of({"g", "o"}), "part", "one"});
    if (!before) obj_faces(style, negative);
    return std::move(text_);
  }

  ModelText ply() {
    const bool normals = dice_.once_in(3), faces_first = dice_.once_in(3), extras = dice_.once_in(3);
    text_ = {dice_.one_of({"a.ply", "a.PLY", "a", "a.txt", "a.off"}), "a.ply", {}, normals};
    add({"ply"});
    add({"format", "ascii", "1.0"});
    if (dice_.once_in(2)) add({"comment", "made", "by", "a", "test"});
    const auto vertex_header = [&] {
      add({"element", "vertex", std::to_string(model_.vertices.size())});
      if (extras) add({"property", "uchar", "red"});
      for (const char* name : {"x", "y", "z"}) add({"property", dice_.one_of({"double", "float64"}), name});
      for (const char* name : {"nx", "ny", "nz"}) {
        if (normals) add({"property", "double", name});
      }
    };
    const auto face_header = [&] {
      add({"element", "face", std::to_string(faces_.size())});
      add({"property", "list", dice_.one_of({"uchar", "uint8", "int"}),
           dice_.one_of({"int", "uint", "int32"}), dice_.one_of({"vertex_indices", "vertex_index"})});
      if (extras) add({"property", "float", "quality"});
    };
    const auto vertices = [&] {
      for (std::size_t v = 0; v < model_.vertices.size(); ++v) {
        auto& line =
            add_point(extras ? std::vector<std::string>{"200"} : std::vector<std::string>{}, v, normals);
        line.needed = line.tokens.size();
      }
    };
    const auto faces = [&] {
      for (const auto& face : faces_) {
        auto& line = add({std::to_string(face.size())}, LineKind::face);
        for (const std::int32_t v : face) line.tokens.push_back(std::to_string(v));
        line.needed = line.tokens.size();
        if (extras) line.tokens.push_back("0.5");
      }
    };
    faces_first ? face_header() : vertex_header();
    faces_first ? vertex_header() : face_header();
    add({"end_header"});
    faces_first ? faces() : vertices();
    faces_first ? vertices() : faces();
    return std::move(text_);
  }

  ModelText stl() {
    text_ = {dice_.one_of({"a.stl", "a.STL", "a", "a.txt", "a.ply"}), "a.stl", {}, false};
    const bool capitals = dice_.once_in(4), apart = dice_.once_in(4), one_line = dice_.once_in(4);
    const auto word = [&](std::string text) {
      if (capitals)
        std::transform(text.begin(), text.end(), text.begin(),
                       [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
      return text;
    };
    const auto end = [&](const char* what) {
      return apart ? std::vector{word("end"), word(what)} : std::vector{word(std::string("end") + what)};
    };
    add({word("solid"), "a", "part"});
    for (const auto& t : model_.triangles()) {
      std::vector<ModelText::Line> facet = {
          {{word("facet"), word("normal"), "0", "0", "1"}, LineKind::words, 1},
          {{word("outer"), word("loop")}, LineKind::words, 2}};
      for (const std::int32_t v : t) {
        const auto& p = model_.vertices[static_cast<std::size_t>(v)];
        facet.push_back({{word("vertex"), number(p.x, dice_), number(p.y, dice_), number(p.z, dice_)},
                         LineKind::vertex,
                         4});
      }
      facet.push_back({end("loop"), LineKind::words, 1});
      facet.push_back({end("facet"), LineKind::words, 1});
      if (one_line) {
        ModelText::Line line;
        for (const auto& part : facet)
          line.tokens.insert(line.tokens.end(), part.tokens.begin(), part.tokens.end());
        text_.lines.push_back(line);
      } else {
        text_.lines.insert(text_.lines.end(), facet.begin(), facet.end());
      }
    }
    text_.lines.push_back({end("solid"), LineKind::words, 1});
    return std::move(text_);
  }

  ModelText xyz() {
    const bool normals = dice_.once_in(3), named = dice_.once_in(3), counted = !named && dice_.once_in(4);
    text_ = {dice_.one_of({"a.xyz", "a.csv", "a.asc", "a.txt", "a"}),
             "a.xyz",
             {},
             normals,
             false,
             dice_.one_of({' ', ' ', ',', ';', '\t'})};
    comments();
    if (named && normals) add({"X", "Y", "Z", "nx", "ny", "nz"});
    if (named && !normals) add({"x", "y", "z"});
    if (counted) add({std::to_string(model_.vertices.size())});
    for (std::size_t v = 0; v < model_.vertices.size(); ++v) {
      auto& line = add_point({}, v, normals);
      line.needed = 3;
    }
    return std::move(text_);
  }

 private:
  ModelText::Line& add(std::vector<std::string> tokens, LineKind kind = LineKind::other) {
    text_.lines.push_back({std::move(tokens), kind, 0});
    return text_.lines.back();
  }
  ModelText::Line& add_point(std::vector<std::string> tokens, std::size_t v, bool normals) {
    const auto put = [&](const geometry::Vec3& p) {
      for (const double x : {p.x, p.y, p.z}) tokens.push_back(number(x, dice_));
    };
    put(model_.vertices[v]);
    if (normals) put(made_up_normal(v));
    return add(std::move(tokens), LineKind::vertex);
  }
  void comments() {
    for (std::size_t k = dice_.below(3); k > 0; --k) {
      add({});
      if (dice_.once_in(2)) text_.lines.back().comment = "# made by a test, 1 2 3";
    }
  }
  void obj_faces(std::size_t style, bool negative) {
    for (const auto& face : faces_) {
      auto& line = add({"f"}, LineKind::face);
      for (const std::int32_t v : face) {
        const auto index = [&] {
          return std::to_string(negative ? v - static_cast<std::int32_t>(model_.vertices.size()) : v + 1);
        };
        static constexpr const char* const middle[] = {"", "/1", "//", "/3/", "//"};
        line.tokens.push_back(index() + middle[style] + (style >= 2 ? index() : ""));
      }
      line.needed = line.tokens.size();
    }
  }

  const PolygonModel& model_;
  Dice& dice_;
  std::vector<std::vector<std::int32_t>> faces_;
  ModelText text_;
};

}  // namespace ballflow::test

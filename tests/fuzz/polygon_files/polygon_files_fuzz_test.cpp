// Damaged files of polygons are read or refused; they never crash the reader, hang it, or leave broken
// polygons behind.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/random.hpp"
#include "planar/read_polygon.hpp"

namespace ballflow::geometry {
namespace {

const std::vector<std::string>& seeds() {
  static const std::vector<std::string> texts = {
      "2\n4\n0 0\n9 0\n9 9\n0 9\n3\n1 1\n2 1\n1 2\n",
      "SRID=4326;POLYGON Z ((0 0 1, 9 0 1, 0 9 1, 0 0 1), (1 1 1, 2 1 1, 1 2 1, 1 1 1))",
      "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6, 5 5)))",
      "GEOMETRYCOLLECTION (POLYGON EMPTY, POLYGON ((0 0, 1 0, 0 1)))",
      R"({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, 1], [0, 0]]]}})",
      R"({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": null}, {"type": "Feature",
          "geometry": {"type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [0, 1]]]]}}]})",
      R"x(<svg><g transform="translate(1,2) rotate(45 0 0)"><path d="M0 0h9v9H0zm1 1l1 0 0 1z"/></g></svg>)x",
      R"(<?xml version="1.0"?><svg xmlns="x"><rect x="1" width="2" height="3"/><polygon points="8,8 9,8 9-1"/></svg>)"};
  return texts;
}

void read(const std::string& content) {
  try {
    // A copy of exact size: a sanitizer sees every byte read beyond its end.
    const std::vector<char> exact(content.begin(), content.end());
    const NestedRings nested = nest(parse_polygon({exact.data(), exact.size()}).rings);
    ASSERT_EQ(broken_invariant(nested.polygon), "");
    ASSERT_GT(nested.polygon.components(), 0u);
    ASSERT_LE(nested.polygon.vertices.size(), content.size());
  } catch (const InputError& error) {
    const std::string text = error.what();
    ASSERT_NE(text.find('\n'), std::string::npos) << text;
    ASSERT_EQ(text.find('\0'), std::string::npos);
  }
}

std::string damaged(std::string content, Random& random) {
  static const std::vector<std::string> tokens = {"-1",   "99999999999999999999",
                                                  "nan",  "1e999",
                                                  "\n",   " ",
                                                  "#",    ",",
                                                  "((",   "))",
                                                  "0",    "1.5",
                                                  "{",    "}",
                                                  "[",    "]",
                                                  "\"",   "<",
                                                  ">",    "<g>",
                                                  "z",    "M",
                                                  "EMPTY"};
  const auto below = [&random](std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(random.bits() % n);
  };
  for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
    const std::size_t place = below(content.size() + 1);
    switch (below(4)) {
      case 0:
        content.insert(place, tokens[below(tokens.size())]);
        break;
      case 1:
        content.erase(place, 1 + below(6));
        break;
      case 2:
        if (place < content.size()) content[place] = static_cast<char>(random.bits() & 0xff);
        break;
      default:
        content.resize(place);
    }
  }
  return content;
}

TEST(polygon_files, that_are_whole_are_read) {
  for (const std::string& seed : seeds()) {
    SCOPED_TRACE(seed);
    EXPECT_GT(nest(parse_polygon(seed).rings).polygon.components(), 0u);
  }
}

TEST(polygon_files, that_are_damaged_are_read_or_refused) {
  Random random(7);
  for (int i = 0; i < 4000; ++i) {
    for (const std::string& seed : seeds()) {
      const std::string content = damaged(seed, random);
      SCOPED_TRACE(content);
      read(content);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(polygon_files, nested_without_end_are_refused) {
  for (const auto& [begin, end] :
       {std::pair("GEOMETRYCOLLECTION (", ")"),
        std::pair(R"({"type": "GeometryCollection", "geometries": [)", "]}"), std::pair("<g>", "</g>")}) {
    std::string text = *begin == '<' ? "<svg>" : "", tail;
    for (int i = 0; i < 100'000; ++i) {
      text += begin;
      tail += end;
    }
    read(text);
    read(text + tail);
  }
}

}  // namespace
}  // namespace ballflow::geometry

// Damaged set covering files are read or refused; they never crash the reader, hang it, or leave a broken
// matrix behind.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/random.hpp"
#include "cover/load_cover.hpp"
#include "cover/save_cover.hpp"

namespace ballflow::geometry {
namespace {

std::string scp() {
  std::string text;
  save_scp(load_cover({.file = "steiner:9"}).cover, [&text](std::string_view piece) { text += piece; });
  return text;
}

const std::vector<std::string>& seeds() {
  static const std::vector<std::string> texts = {
      scp(), " 5 4\n 2 3 1 2 3\n 1 2 4 5\n 1 1 1\n 3 2 2 5\n", "7 3\n1 2 3\n3 4 5\n5 6 7\n",
      "v 0 0 0 1\nv 1 0.5 -2 .25\nv 1e-3 2 3 4\n", "x,y,z,r\n0,0,0,1\n1,2,3,0.5\n"};
  return texts;
}

/// Reads; whatever comes out must be whole, and no larger than the file allows.
void read(const std::string& content, CoverFormat format) {
  const PointSet points{{Vec3{0, 0, 0}, Vec3{1, 0.5, -2}, Vec3{5, 5, 5}}, {}};
  try {
    // A copy of exact size: a sanitizer sees every byte read beyond its end.
    const std::vector<char> exact(content.begin(), content.end());
    const LoadedCover loaded = parse_cover({exact.data(), exact.size()}, format, 0.5, &points);
    ASSERT_EQ(broken_invariant(loaded.cover), "");
    ASSERT_EQ(broken_invariant(loaded.balls), "");
    ASSERT_LE(loaded.cover.rows() + loaded.cover.cols(), content.size() + 3);
  } catch (const InputError& error) {
    ASSERT_NE(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

std::string damaged(std::string content, Random& random) {
  static const std::vector<std::string> tokens = {"-1",         "99999999999999999999",
                                                  "2147483647", "2147483648",
                                                  "nan",        "inf",
                                                  "1e999",      "\n",
                                                  " ",          "#",
                                                  ",",          "v ",
                                                  "0",          "1.5",
                                                  "\r"};
  const auto below = [&random](std::size_t n) {
    return n == 0 ? 0 : static_cast<std::size_t>(random.bits() % n);
  };
  for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
    const std::size_t at = below(content.size() + 1);
    switch (below(5)) {
      case 0:
        if (at < content.size()) content[at] = static_cast<char>(content[at] ^ (1 << below(8)));
        break;
      case 1:
        content.resize(at);
        break;
      case 2:
        content.erase(at, below(8));
        break;
      case 3:
        content.replace(at, below(4), tokens[below(tokens.size())]);
        break;
      default:
        content.insert(at, content.substr(below(content.size()), below(16)));
    }
  }
  return content;
}

constexpr CoverFormat formats[] = {CoverFormat::automatic, CoverFormat::scp, CoverFormat::rail,
                                   CoverFormat::steiner, CoverFormat::balls};

TEST(cover_files, survive_random_damage_in_every_format) {
  Random random(20260101);
  for (int round = 0; round < 4000 && !HasFatalFailure(); ++round) {
    for (const std::string& seed : seeds()) read(damaged(seed, random), formats[round % 5]);
  }
}

TEST(cover_files, survive_being_cut_anywhere_and_read_as_anything) {
  for (const std::string& seed : seeds()) {
    for (std::size_t size = 0; size <= seed.size() && !HasFatalFailure(); ++size) {
      for (const CoverFormat format : formats) read(seed.substr(0, size), format);
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry

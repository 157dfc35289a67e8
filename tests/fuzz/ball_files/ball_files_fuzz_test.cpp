// Damaged lists of balls are read or refused; they never crash the reader, hang it, or leave broken balls
// behind.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/random.hpp"
#include "io/load_balls.hpp"

namespace ballflow::geometry {
namespace {

const std::vector<std::string>& seeds() {
  static const std::vector<std::string> texts = {
      "4 4 1\nv 0 0 0 1\nv 1 0 0 .5\nv 0 1e-3 0 1\nv 0 0 1 2\ne 0 1\ne 1 2\ne 2 0\ne 3 0\nf 0 1 2\n",
      "3 1 1\nv 0 0 0 1 2 0\nv 1 0 0 1 0 1\nv 0 1 0 1 2 0\ne 0 2 1 0\nf 0 1 2 1\n",
      "3\n0 0 0 1\n1 0.5 -2 .25\n1e-3 2 3 4\n",
      "4 2\n0 0 0 1 3 0 1\n1 0 0 1 3 1 1\n",
      "v 0 0 0 1\nv 1 0.5 -2 .25\nv 1e-3 2 3 4\n",
      "x,y,z,r,label\n0,0,0,1,2\n1,2,3,0.5,1\n",
      "Z;\"Y [mm]\";x;diameter\n0,5;1;2;1,5\n1;2;3;1,25\n",
      "1,5 0 0,25 1\n0 0 1 0,5\n",
      "2 2\n0 0 0 4 1\n-1 0 0 2 1\n1 0 0 -1 1\n",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "property double radius\nend_header\n0 0 0 1\n1 2 3 4\n"};
  return texts;
}

/// Reads; whatever comes out must be whole, and no larger than the file allows.
void read(const std::string& content) {
  try {
    // A copy of exact size: a sanitizer sees every byte read beyond its end.
    const std::vector<char> exact(content.begin(), content.end());
    const LoadedBalls loaded = parse_balls({exact.data(), exact.size()});
    ASSERT_EQ(broken_invariant(loaded.balls), "");
    ASSERT_EQ(broken_invariant(loaded.axis), "");
    ASSERT_GT(loaded.balls.size(), 0u);
    ASSERT_LE(8 * loaded.balls.size(), content.size() + 1);
  } catch (const InputError& error) {
    const std::string text = error.what();
    ASSERT_NE(text.find('\n'), std::string::npos) << text;
    ASSERT_EQ(text.find('\0'), std::string::npos);
  }
}

std::string damaged(std::string content, Random& random) {
  static const std::vector<std::string> tokens = {"-1",         "99999999999999999999",
                                                  "2147483647", "2147483648",
                                                  "nan",        "inf",
                                                  "1e999",      "\n",
                                                  " ",          "#",
                                                  ",",          "v ",
                                                  "e 0 1",      "f ",
                                                  "0",          "1.5",
                                                  "\r",         "3 0 0\n"};
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

TEST(ball_files, survive_random_damage) {
  Random random(20261122);
  for (int round = 0; round < 8000 && !HasFatalFailure(); ++round) {
    for (const std::string& seed : seeds()) read(damaged(seed, random));
  }
}

TEST(ball_files, survive_being_cut_anywhere) {
  for (const std::string& seed : seeds()) {
    for (std::size_t size = 0; size <= seed.size() && !HasFatalFailure(); ++size) read(seed.substr(0, size));
  }
}

}  // namespace
}  // namespace ballflow::geometry

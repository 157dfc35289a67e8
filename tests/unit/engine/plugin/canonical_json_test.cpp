#include "ballflow/canonical_json.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "ballflow/error.hpp"

namespace ballflow {

TEST(canonical_json, has_one_spelling) {
  const auto canonical = [](const std::string& text) { return canonical_json(text, ExitCode::usage); };
  EXPECT_EQ(
      canonical(R"( { "b" : [ 1 , 2.50 , true , null ] , "a" : { "z" : "\u00e9\u0007\/" , "Z" : -0.0 } } )"),
      "{\"a\":{\"Z\":0,\"z\":\"\xc3\xa9\\u0007/\"},\"b\":[1,2.5,true,null]}");
  EXPECT_EQ(canonical("{}"), "{}");
  EXPECT_EQ(canonical("[[],{}]"), "[[],{}]");
  EXPECT_EQ(canonical("18446744073709551615"), "18446744073709551615");
  EXPECT_EQ(canonical("-9223372036854775808"), "-9223372036854775808");
  for (const std::string number :
       {"0.1", "1e300", "5e-324", "1.0", "100000000000000000000000", "123456789012345680000.0", "-0.0",
        "0.30000000000000004", "1e22", "1e21"}) {
    const std::string once = canonical(number);
    EXPECT_EQ(canonical(once), once) << number;
    EXPECT_EQ(std::strtod(once.c_str(), nullptr), std::strtod(number.c_str(), nullptr)) << number;
  }
}

TEST(canonical_json, writes_numbers_as_ecmascript_does) {
  // RFC 8785, appendix B, and the borders between the four forms of ECMAScript's Number::toString.
  const std::vector<std::pair<std::uint64_t, std::string>> samples = {
      {0x0000000000000000, "0"},
      {0x8000000000000000, "0"},
      {0x0000000000000001, "5e-324"},
      {0x8000000000000001, "-5e-324"},
      {0x7fefffffffffffff, "1.7976931348623157e+308"},
      {0xffefffffffffffff, "-1.7976931348623157e+308"},
      {0x4340000000000000, "9007199254740992"},
      {0xc340000000000000, "-9007199254740992"},
      {0x4430000000000000, "295147905179352830000"},
      {0x44b52d02c7e14af5, "9.999999999999997e+22"},
      {0x44b52d02c7e14af6, "1e+23"},
      {0x44b52d02c7e14af7, "1.0000000000000001e+23"},
      {0x444b1ae4d6e2ef4e, "999999999999999700000"},
      {0x444b1ae4d6e2ef4f, "999999999999999900000"},
      {0x444b1ae4d6e2ef50, "1e+21"},
      {0x3eb0c6f7a0b5ed8c, "9.999999999999997e-7"},
      {0x3eb0c6f7a0b5ed8d, "0.000001"},
      {0x41b3de4355555553, "333333333.3333332"},
      {0x41b3de4355555554, "333333333.33333325"},
      {0x41b3de4355555555, "333333333.3333333"},
      {0x41b3de4355555556, "333333333.3333334"},
      {0x41b3de4355555557, "333333333.33333343"},
      {0xbecbf647612f3696, "-0.0000033333333333333333"},
      {0x43143ff3c1cb0959, "1424953923781206.2"},
  };
  for (const auto& [bits, text] : samples) {
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.17e", std::bit_cast<double>(bits));
    EXPECT_EQ(canonical_json(digits, ExitCode::usage), text);
    EXPECT_EQ(canonical_json(text, ExitCode::usage), text);
  }
}

TEST(canonical_json, sorts_members_at_every_depth) {
  // nlohmann's usual tree sorts its keys; its text is canonical where there are no doubles.
  std::mt19937 random(11);
  const auto below = [&random](unsigned n) { return static_cast<unsigned>(random() % n); };
  const std::function<std::string(int)> value = [&](int depth) -> std::string {
    switch (below(depth > 0 ? 6 : 4)) {
      case 0:
        return std::to_string(static_cast<int>(below(2000)) - 1000);
      case 1:
        return "\"s" + std::to_string(below(100)) + ",}\"";
      case 2:
        return "null";
      case 3:
        return below(2) == 0 ? "true" : "false";
      case 4: {
        std::string text;
        for (unsigned i = below(4); i > 0; --i) text += (text.empty() ? "" : " ,") + value(depth - 1);
        return "[" + text + "]";
      }
      default: {
        std::vector<int> keys(20);
        std::iota(keys.begin(), keys.end(), 0);
        std::shuffle(keys.begin(), keys.end(), random);
        std::string text;
        for (unsigned i = below(5); i > 0; --i) {
          text += (text.empty() ? "" : ", ") + std::string("\"k") + std::to_string(keys[i]) +
                  "\": " + value(depth - 1);
        }
        return "{" + text + "}";
      }
    }
  };
  for (int round = 0; round < 2000; ++round) {
    const std::string text = value(5);
    ASSERT_EQ(canonical_json(text, ExitCode::usage), nlohmann::json::parse(text).dump()) << text;
  }
}

TEST(canonical_json, names_a_key_that_occurs_twice) {
  for (const std::string text :
       {R"({"b":1,"a":{},"b":2})", R"([{"x":{"b":1,"b":1}}])", R"({"\u0062":1,"b":2})"}) {
    try {
      canonical_json(text, ExitCode::usage);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), std::string("JSON names the key \"b\" twice")) << text;
    }
  }
}

TEST(canonical_json, nests_64_deep_and_no_deeper) {
  const auto nested = [](int depth) {
    std::string text = "1";
    for (int i = 0; i < depth; ++i) text = i % 2 == 0 ? "[" + text + "]" : R"({"a":)" + text + "}";
    return text;
  };
  EXPECT_EQ(canonical_json(nested(64), ExitCode::usage), nested(64));
  EXPECT_THROW(canonical_json(nested(65), ExitCode::usage), Error);
  EXPECT_THROW(canonical_json(std::string(1'000'000, '['), ExitCode::usage), Error);
}

TEST(canonical_json, refuses_what_is_not_json) {
  for (const std::string text : {"", "{", "NaN", "1e999", "{\"a\":1,\"a\":2}", "\"\xff\"", "[1,]", "{} {}"}) {
    EXPECT_THROW(canonical_json(text, ExitCode::usage), Error) << text;
  }
}

}  // namespace ballflow

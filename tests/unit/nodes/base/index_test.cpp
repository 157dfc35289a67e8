#include "base/index.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/disjoint_sets.hpp"
#include "base/first_equal.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t too_many = std::size_t{1} << 31;

/// The message of the error that `run` ends with.
template <class Run>
std::string refusal(Run run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(index, numbers_up_to_the_largest_are_taken_and_more_are_named) {
  EXPECT_EQ(index_of(0, "cells"), 0);
  EXPECT_EQ(index_of(too_many - 1, "cells"), 2147483647);
  const std::string message = refusal([] { index_of(too_many, "cells of a triangulation"); });
  EXPECT_EQ(message.find("2147483648 cells of a triangulation are more than 2^31 - 1"), 0u) << message;
  EXPECT_NE(message.find('\n'), std::string::npos) << "no hint";
  EXPECT_NE(refusal([] { index_of(~std::size_t{0}, "cells"); }), "");
}

TEST(index, sets_and_equal_things_are_refused_before_there_is_memory_for_them) {
  EXPECT_NE(refusal([] { DisjointSets sets(too_many + 1); }).find("2147483649 elements"), std::string::npos);
  const auto unasked = [](auto...) -> std::uint64_t {
    ADD_FAILURE() << "nothing may be looked at";
    return 0;
  };
  EXPECT_NE(refusal([&] { first_equal(too_many, unasked, unasked); }).find("2147483648"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry

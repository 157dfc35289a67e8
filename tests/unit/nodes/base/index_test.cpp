#include "base/index.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "base/disjoint_sets.hpp"
#include "base/first_equal.hpp"
#include "homology/binary_system.hpp"
#include "power/regular_cells.hpp"
#include "search/box_tree.hpp"

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

TEST(index, trees_and_triangulations_are_refused_before_there_is_memory_for_them) {
  // Spans of more than there is: nothing may be read.
  const Vec3 point;
  const double weight = 0;
  const Box box;
  const std::span<const Vec3> points(&point, too_many);
  EXPECT_NE(refusal([&] { BoxTree tree(points, 1); }).find("of a box tree"), std::string::npos);
  EXPECT_NE(refusal([&] { BoxTree tree(std::span<const Box>(&box, too_many), 4); }).find("of a box tree"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              regular_cells(points, std::span<const double>(&weight, too_many), no_monitor());
            }).find("2147483648 balls"),
            std::string::npos);
  EXPECT_NE(
      refusal([&] { BinarySystem system(too_many, {}, {}, {}, no_monitor()); }).find("2147483648 variables"),
      std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry

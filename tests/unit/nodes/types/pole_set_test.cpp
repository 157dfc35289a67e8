#include "types/pole_set.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace ballflow {
namespace {

using geometry::broken_invariant;
using geometry::PoleSet;

// Two poles of five samples: 0 with samples 0 to 3, 1 unbounded with samples 1 and 4.
PoleSet valid() {
  PoleSet poles;
  poles.centers = {{0, 0, 0}, {9, 0, 0}};
  poles.radii = {1, 8};
  poles.labels = {1, 2};
  poles.defining_offsets = {0, 4, 6};
  poles.defining_samples = {0, 1, 2, 3, 1, 4};
  poles.unbounded = {0, 1};
  poles.sample_poles = {{0, -1, -1}, {1, 0, -1}, {0, -1, -1}, {0, -1, -1}, {1, -1, -1}};
  return poles;
}

TEST(pole_set, that_is_valid_has_no_broken_invariant) { EXPECT_EQ(broken_invariant(valid()), ""); }

TEST(pole_set, may_have_third_poles_and_unlabelled_candidates) {
  PoleSet poles = valid();
  poles.sample_poles = {{0, -1, -1}, {1, -1, 0}, {0, -1, -1}, {0, -1, -1}, {1, -1, -1}};
  EXPECT_EQ(broken_invariant(poles), "");
  EXPECT_EQ(geometry::is_pole(poles), (std::vector<std::uint8_t>{1, 1}));
  poles.labels = {0, 0};
  poles.sample_poles = {{-1, -1, -1}, {1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}, {1, -1, -1}};
  EXPECT_EQ(broken_invariant(poles), "");
  EXPECT_EQ(geometry::is_pole(poles), (std::vector<std::uint8_t>{0, 1}));
}

TEST(pole_set, names_the_broken_invariant) {
  const auto broken = [](auto damage) {
    PoleSet poles = valid();
    damage(poles);
    return broken_invariant(poles);
  };
  const auto expect = [&](const char* what, auto damage) {
    EXPECT_NE(broken(damage).find(what), std::string::npos) << what << " != " << broken(damage);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect("labels has 1 entries", [](PoleSet& p) { p.labels = {0}; });
  expect("defining_offsets has 0", [](PoleSet& p) { p.defining_offsets = {}; });
  expect("decreases after pole 1", [](PoleSet& p) { p.defining_offsets = {0, 6, 4}; });
  expect("ends at 5", [](PoleSet& p) { p.defining_offsets = {0, 4, 5}; });
  expect("pole 1 has a centre", [&](PoleSet& p) { p.centers = {{0, 0, 0}, {nan, 0, 0}}; });
  expect("pole 0 has radius", [&](PoleSet& p) { p.radii = {nan, 8}; });
  expect("pole 0 has radius", [](PoleSet& p) { p.radii = {-1, 8}; });
  expect("pole 0 has label 3", [](PoleSet& p) { p.labels = {3, 0}; });
  expect("labelled inner", [](PoleSet& p) { p.labels = {1, 1}; });
  expect("fewer than 4", [](PoleSet& p) { p.unbounded = {0, 0}; });
  expect("sample 7 of 5", [](PoleSet& p) { p.defining_samples = {0, 1, 2, 7, 1, 4}; });
  expect("do not ascend", [](PoleSet& p) { p.defining_samples = {0, 2, 1, 3, 1, 4}; });
  expect("out of order", [](PoleSet& p) { p.defining_samples = {0, 1, 2, 3, 0, 1}; });
  const auto expect_of_poles = [&](const char* what, std::size_t sample, std::array<std::int32_t, 3> own) {
    expect(what, [&](PoleSet& p) {
      std::vector<std::array<std::int32_t, 3>> changed(p.sample_poles.begin(), p.sample_poles.end());
      changed[sample] = own;
      p.sample_poles = changed;
    });
  };
  expect_of_poles("sample 0 has pole 2 of 2", 0, {2, -1, -1});
  expect_of_poles("sample 0 has pole 1, which it does not define", 0, {1, -1, -1});
  expect_of_poles("second pole but no first", 0, {-1, 0, -1});
  expect_of_poles("same pole on both sides", 1, {1, 1, -1});
  expect_of_poles("third pole on the side of its others", 0, {0, -1, 0});
  expect_of_poles("third pole on the side of its others", 1, {1, 0, 0});
  expect("third pole before all are labelled", [](PoleSet& p) {
    p.labels = {0, 0};
    p.sample_poles = {{0, -1, -1}, {1, -1, 0}, {0, -1, -1}, {0, -1, -1}, {1, -1, -1}};
  });
  expect("pole 1 is the pole of no sample, and unbounded", [](PoleSet& p) {
    p.labels = {0, 0};
    p.sample_poles = {{0, -1, -1}, {0, -1, -1}, {0, -1, -1}, {0, -1, -1}, {-1, -1, -1}};
  });
}

}  // namespace
}  // namespace ballflow

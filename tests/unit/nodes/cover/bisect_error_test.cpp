#include "cover/bisect_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace ballflow::geometry {
namespace {

/// Of balls of a closed surface that are as far off as it says, on both sides together.
Enclosure off_by(double gap, double protrusion) {
  Enclosure e;
  e.balls = 1;
  e.triangles = 4;
  e.closed = 1;
  e.gap_at_most = e.gap = gap;
  if (gap > 0) {
    e.open_triangles = {0};
    e.open_points = {{0, 0, 0}};
    e.open_why = {0};
  }
  e.protrusion = protrusion;
  return e;
}

/// Searches where the error of a growth in % is known; the box has an edge of 10.
Bisection searched_for(const std::function<double(double)>& error, BisectErrorOptions options) {
  Bisection search = begin_error_search(options, 10);
  for (int i = 0; i < 100 && search.done == 0; ++i) {
    EXPECT_EQ(broken_invariant(search), "");
    search = bisect_error(search, off_by(0, error(search.value)), options, 10);
  }
  EXPECT_EQ(broken_invariant(search), "");
  EXPECT_EQ(search.done, 1);
  return search;
}

BisectErrorOptions allowing(double max_error, double share = 1) {
  BisectErrorOptions options;
  options.max_error = max_error;
  options.share = share;
  return options;
}

TEST(bisect_error, finds_a_growth_with_about_the_error_that_is_allowed) {
  const std::vector<std::function<double(double)>> errors{
      [](double growth) { return growth / 10; },                    // the growth itself
      [](double growth) { return 0.02 + 0.3 * growth / 10; },       // less than it
      [](double growth) { return 0.05 + 2 * growth / 10; },         // more
      [](double growth) { return 0.04 + std::sqrt(growth) / 10; },  // not linear
      [](double growth) { return std::floor(growth * 20) / 200; },  // in steps
  };
  for (std::size_t k = 0; k < errors.size(); ++k) {
    for (const double allowed : {0.06, 0.1, 0.35}) {
      const Bisection found = searched_for(errors[k], allowing(2 * allowed, 0.5));
      EXPECT_EQ(errors[k](found.value), found.error) << k;
      EXPECT_LE(found.error, allowed) << k;
      // Or a growth of 10 %, or a little more growth is too much.
      const double more = found.value * 1.03 + 0.02 * 100 * allowed / 10;
      EXPECT_TRUE(found.error >= 0.9 * allowed || found.value == 10 || errors[k](more) > allowed)
          << k << ": " << found.value << " has " << found.error << " of " << allowed;
      EXPECT_LE(found.tried, 16) << k << ' ' << allowed;
    }
  }
}

TEST(bisect_error, takes_the_larger_one_of_both_distances) {
  EXPECT_EQ(proven_error(off_by(0.25, 0.5)), 0.5);
  EXPECT_EQ(proven_error(off_by(0.5, 0.25)), 0.5);
  EXPECT_EQ(proven_error(off_by(0, 0)), 0);
}

TEST(bisect_error, is_done_before_it_begins_where_nothing_is_asked_for) {
  BisectErrorOptions options;
  options.epsilon = 0.7;
  const Bisection search = begin_error_search(options, 0);
  EXPECT_EQ(search.done, 1);
  EXPECT_EQ(search.value, 0.7);
  EXPECT_EQ(broken_invariant(search), "");
  EXPECT_EQ(bisect_error(search, off_by(0, 9), options, 10).value, 0.7);
}

TEST(bisect_error, says_which_error_is_reached_where_it_is_not_allowed) {
  const auto error = [](double growth) { return 0.5 + growth / 10; };
  try {
    searched_for(error, allowing(0.4, 0.5));
    ADD_FAILURE() << "found what does not exist";
  } catch (const InputError& refused) {
    const std::string text = refused.what();
    EXPECT_NE(text.find("still 0.5 off, not the 0.2"), std::string::npos) << text;
    EXPECT_NE(text.find("max_error of 1.01 or more"), std::string::npos) << text;
  }
}

TEST(bisect_error, finds_no_growth_where_only_that_is_allowed) {
  const auto error = [](double growth) { return growth > 0 ? 1.0 : 0.1; };
  EXPECT_EQ(searched_for(error, allowing(0.2)).value, 0);
}

TEST(bisect_error, refuses_what_has_no_error) {
  Enclosure open = off_by(0, 1), points, none = off_by(0, 0);
  open.closed = 0;
  none.balls = 0;
  none.gap_at_most = -1;
  for (const Enclosure& e : {open, points, none}) EXPECT_THROW(proven_error(e), InputError);
  EXPECT_THROW(begin_error_search(allowing(-1), 1), InputError);
  EXPECT_THROW(begin_error_search(allowing(std::nan("")), 1), InputError);
  EXPECT_THROW(begin_error_search(allowing(1, 0), 1), InputError);
  EXPECT_THROW(begin_error_search(allowing(1), 0), InputError);
}

TEST(bisection, without_an_error_for_a_value_is_damaged) {
  Bisection search;
  search.within = 1;
  EXPECT_NE(broken_invariant(search), "");
  search.error = 0.1;
  EXPECT_EQ(broken_invariant(search), "");
  search.beyond = 0.5;
  search.error_before = 0.2;
  EXPECT_NE(broken_invariant(search), "");
}

}  // namespace
}  // namespace ballflow::geometry

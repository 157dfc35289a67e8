#include "cover/load_cover.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "cover/residual.hpp"
#include "cover/save_cover.hpp"
#include "cover/verify_cover.hpp"
#include "cover_oracle.hpp"
#include "io/read_mesh.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

using test::row_sets;
using test::Sets;
using test::state_of;

struct WarningText final : Monitor {
  std::string text;
  void warn(const std::string& warning) override { text += warning + "\n"; }
};

std::string scp_of(const CoverState& state) {
  std::string text;
  save_scp(state, [&text](std::string_view piece) { text += piece; });
  return text;
}

std::string lp_of(const CoverState& state) {
  std::string text;
  save_lp(state, [&text](std::string_view piece) { text += piece; });
  return text;
}

std::string refusal(std::string_view content, CoverFormat format) {
  try {
    parse_cover(content, format);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Whether `text` names all of `words`.
testing::AssertionResult names(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (text.find(word) == std::string::npos) {
      return testing::AssertionFailure() << "\"" << text << "\" lacks \"" << word << "\"";
    }
  }
  return testing::AssertionSuccess();
}

TEST(load_cover, reads_an_scp_file_element_by_element) {
  const CoverState cover =
      parse_cover(" 3 4\n 1 1 1 1\n 2\n 1 3\n 1\n 2\n 2\n 4 3\n", CoverFormat::scp).cover;
  EXPECT_EQ(row_sets(cover), (Sets{{0}, {1}, {0, 2}, {2}}));
  EXPECT_EQ(cover.balls, 4);
  EXPECT_EQ(cover.samples, 3);
  EXPECT_EQ(cover.lower_bound, 2);
  EXPECT_EQ(broken_invariant(cover), "");
}

TEST(load_cover, reads_a_rail_file_set_by_set) {
  const CoverState cover = parse_cover("3 4\n1 2 3 1\n1 1 2\n1 0\n1 1 3\n", CoverFormat::rail).cover;
  EXPECT_EQ(row_sets(cover), (Sets{{0, 2}, {1}, {}, {2}}));
}

TEST(load_cover, reads_steiner_triples_as_elements) {
  const CoverState cover = parse_cover("4 2\n2 3 4\n1 3 2\n", CoverFormat::steiner).cover;
  EXPECT_EQ(row_sets(cover), (Sets{{1}, {0, 1}, {0, 1}, {0}}));
}

TEST(load_cover, ignores_costs_with_a_warning_and_is_silent_without) {
  WarningText some, none;
  EXPECT_EQ(row_sets(parse_cover("1 2 7 3 2 1 2", CoverFormat::scp, 0, nullptr, some).cover),
            (Sets{{0}, {0}}));
  EXPECT_TRUE(names(some.text, {"costs, from 1 to 7"}));
  parse_cover("1 2 1 1 2 1 2", CoverFormat::scp, 0, nullptr, none);
  EXPECT_EQ(none.text, "");
}

TEST(load_cover, lists_an_element_of_no_set_as_uncovered) {
  WarningText warnings;
  const CoverState cover =
      parse_cover("3 2\n1 1\n1 2\n0\n2 1 2\n", CoverFormat::scp, 0, nullptr, warnings).cover;
  EXPECT_EQ(row_sets(cover), (Sets{{2}, {0, 2}}));
  EXPECT_EQ(cover.uncovered, (Array<std::int32_t>{1}));
  EXPECT_EQ(broken_invariant(cover), "");
  EXPECT_TRUE(names(warnings.text, {"1 of 3", "element 2"}));
}

TEST(load_cover, finds_the_format_that_the_file_fits) {
  for (const char* text :
       {"3 4\n1 1 1 1\n2\n1 3\n1\n2\n2\n4 3\n", "3 4\n1 2 3 1\n1 1 2\n1 0\n1 1 3\n", "4 2\n2 3 4\n1 3 2\n"}) {
    const CoverState cover = parse_cover(text, CoverFormat::automatic).cover;
    int equal = 0;
    for (const CoverFormat format : {CoverFormat::scp, CoverFormat::rail, CoverFormat::steiner}) {
      try {
        equal += test::same(parse_cover(text, format).cover, cover) ? 1 : 0;
      } catch (const InputError&) {
      }
    }
    EXPECT_EQ(equal, 1) << text;
  }
}

TEST(load_cover, asks_when_a_file_fits_two_formats_and_explains_when_it_fits_none) {
  // As scp: 1 element, 1 set of cost 1, the element has 1 set: 1. As rail: 1 set of cost 1 with 1 element: 1.
  EXPECT_TRUE(names(refusal("1 1 1 1 1", CoverFormat::automatic), {"scp and rail", "set format"}));
  EXPECT_TRUE(
      names(refusal("2 2 1 1 1", CoverFormat::automatic), {"as scp", "as rail", "as steiner", "line 1"}));
}

TEST(load_cover, names_the_line_of_what_is_wrong) {
  EXPECT_TRUE(names(refusal("1 2\n1 1\n1\nx\n", CoverFormat::scp), {"\"x\"", "line 4"}));
  EXPECT_TRUE(
      names(refusal("1 2\n1 1\n1\n3\n", CoverFormat::scp), {"set of element 1 is 3", "1 to 2", "line 4"}));
  EXPECT_TRUE(names(refusal("1 2\n1 1\n1\n0\n", CoverFormat::scp), {"is 0", "line 4"}));
  EXPECT_TRUE(names(refusal("1 2\n1 -1\n1\n1\n", CoverFormat::scp), {"\"-1\"", "line 2"}));
  EXPECT_TRUE(names(refusal("1 2\n1 1\n2\n2 2\n", CoverFormat::scp), {"element 1 is twice 2", "line 4"}));
  EXPECT_TRUE(names(refusal("1 2\n1 1\n2\n2", CoverFormat::scp), {"number of sets of element 1", "line 3"}));
  EXPECT_TRUE(names(refusal("2 1\n1\n1 1\n", CoverFormat::scp), {"file ends", "element 2", "line 4"}));
  EXPECT_TRUE(names(refusal("1 1\n1\n1 1\n9 9\n", CoverFormat::scp), {"2 numbers follow", "line 4"}));
  EXPECT_TRUE(names(refusal("2 1\n1 1 3\n", CoverFormat::rail), {"element of set 1 is 3", "line 2"}));
  EXPECT_TRUE(
      names(refusal("3 1\n1 2 2\n", CoverFormat::steiner), {"point of block 1 is twice 2", "line 2"}));
  EXPECT_TRUE(names(refusal("2000000000 2000000000 1", CoverFormat::rail), {"number of elements", "line 1"}));
  EXPECT_TRUE(names(refusal("0 0 0 1\nv 0 0 0 -2", CoverFormat::balls), {"no points"}));
}

TEST(load_cover, names_the_line_of_a_bad_ball) {
  const PointSet points{{Vec3{0, 0, 0}}, {}};
  const auto refused = [&](std::string_view content) {
    try {
      parse_cover(content, CoverFormat::balls, 0, &points);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(names(refused("v 0 0 0 1\nv 0 0 0 -2"), {"ball 1", "\"-2\"", "line 2"}));
  EXPECT_TRUE(names(refused("0 0 0 1\n0 0 0\n"), {"ball 1", "r is missing", "line 2"}));
  EXPECT_TRUE(names(refused("0 0 0 1 5\n"), {"\"5\" follows", "line 1"}));
  EXPECT_TRUE(names(refused("0 nan 0 1\n"), {"y is nan", "line 1"}));
  EXPECT_TRUE(names(refused("# none\n"), {"no ball"}));
}

TEST(load_cover, covers_samples_by_dilated_balls) {
  const PointSet points{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{9, 0, 0}}, {}};
  for (const char* text :
       {"v 0 0 0 0.5\nv 1 0 0 .25\n", "0 0 0 0.5\r\n1 0 0 .25", "x,y,z,r\n0,0,0,0.5\n1,0,0,.25\n"}) {
    const LoadedCover loaded = parse_cover(text, CoverFormat::balls, 0.5, &points);
    EXPECT_EQ(row_sets(loaded.cover), (Sets{{0, 1}, {1}})) << text;
    EXPECT_EQ(loaded.cover.uncovered, (Array<std::int32_t>{2}));
    EXPECT_EQ(loaded.balls.radii, (Array<double>{1, 0.75}));
  }
}

TEST(load_cover, makes_the_lines_of_an_affine_space) {
  const CoverState cover = load_cover({.file = "steiner:9"}).cover;
  EXPECT_EQ(cover.samples, 12);
  const Sets lines = row_sets(cover);
  for (std::size_t a = 0; a < lines.size(); ++a) {
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      Sets::value_type common;
      std::set_intersection(lines[a].begin(), lines[a].end(), lines[b].begin(), lines[b].end(),
                            std::back_inserter(common));
      EXPECT_EQ(common.size(), 1u) << "the points " << a << " and " << b << " are on one line";
    }
  }
  // At most 4 of the 9 points are on no line together.
  EXPECT_EQ(test::optimum(cover), 5);
  EXPECT_EQ(load_cover({.file = "steiner:81"}).cover.samples, 81 * 80 / 6);
  EXPECT_THROW(load_cover({.file = "steiner:15"}), InputError);
}

TEST(load_cover, makes_the_published_systems_up_to_the_names_of_points) {
  const std::string file = test::data_file("setcover/sts_data.27.gz");
  if (file.empty()) GTEST_SKIP() << "no test data";
  const CoverState published = load_cover({.file = file}).cover,
                   made = load_cover({.file = "steiner:27"}).cover;
  EXPECT_EQ(published.rows(), made.rows());
  EXPECT_EQ(published.cols(), made.cols());
  EXPECT_EQ(published.nnz(), made.nnz());
}

TEST(load_cover, reads_the_published_instances) {
  struct Known {
    const char* file;
    std::int64_t elements, sets, entries;
  };
  // Sizes from the literature; entries by counting the numbers of the file that are neither sizes nor costs.
  for (const Known& known :
       {Known{"scp41", 200, 1000, 4009}, Known{"scpe1", 50, 500, 4914}, Known{"scpclr10", 511, 210, 13230},
        Known{"scpcyc06", 240, 192, 960}, Known{"rail507", 507, 63009, 409349}}) {
    const std::string file = test::data_file("setcover/" + std::string(known.file) + ".txt.gz");
    if (file.empty()) GTEST_SKIP() << "no test data";
    const CoverState cover = load_cover({.file = file}).cover;
    EXPECT_EQ(broken_invariant(cover), "");
    EXPECT_EQ(cover.samples, known.elements) << known.file;
    EXPECT_EQ(cover.balls, known.sets) << known.file;
    EXPECT_EQ(static_cast<std::int64_t>(cover.nnz()), known.entries) << known.file;
    EXPECT_TRUE(cover.uncovered.empty());
  }
}

TEST(load_cover, reads_a_coverage_axis_instance) {
  const std::string balls = test::data_file("coverage_axis/01Ants-27_candidates.txt.gz"),
                    samples = test::data_file("coverage_axis/01Ants-27_samples.pts.gz");
  if (balls.empty() || samples.empty()) GTEST_SKIP() << "no test data";
  const PointSet points = read_mesh_file(samples).points;
  const LoadedCover loaded = load_cover({.file = balls, .dilation = 0.03}, &points);
  EXPECT_EQ(loaded.cover.balls, 2000);
  EXPECT_EQ(loaded.cover.samples, 1500);
  EXPECT_TRUE(verify_cover(loaded.balls, points).uncovered.empty());
}

TEST(save_cover, comes_back_from_an_scp_file) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    const CoverState state =
        state_of(test::random_sets(random, 1 + random() % 40, 1 + random() % 40, 0.15), 40);
    CoverState whole = state;  // the file numbers what is there
    whole.samples = static_cast<std::int64_t>(state.cols());
    whole.uncovered = {};
    std::vector<std::int32_t> ids(state.cols());
    std::iota(ids.begin(), ids.end(), 0);
    whole.column_ids = ids;
    raise_lower_bound(whole);
    EXPECT_TRUE(test::same(parse_cover(scp_of(state), CoverFormat::scp).cover, whole));
  }
}

TEST(save_cover, saves_what_is_left_after_choices) {
  const CoverState state = state_of({{0, 1}, {2}, {2, 3}}, 4);
  const CoverState rest = choose(state, std::vector<std::int32_t>{0}, Choice::greedy);
  EXPECT_EQ(row_sets(parse_cover(scp_of(rest), CoverFormat::scp).cover), (Sets{{0}, {0, 1}}));
  EXPECT_EQ(scp_of(state_of({}, 0)), " 0 0\n");
}

TEST(save_cover, writes_an_integer_program_with_original_numbers) {
  const CoverState rest =
      choose(state_of({{0, 1}, {2}, {2, 3}}, 4), std::vector<std::int32_t>{0}, Choice::greedy);
  EXPECT_EQ(lp_of(rest),
            "\\ Balls 2, samples 2, balls chosen before 1\nMinimize\n balls: b1 + b2\nSubject To\n"
            " s2: b1 + b2 >= 1\n s3: b2 >= 1\nBinaries\n b1\n b2\nEnd\n");
}

}  // namespace
}  // namespace ballflow::geometry

#include "terminal/facts.hpp"

#include <gtest/gtest.h>

#include <array>

#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

NamedOutputs outputs(const std::vector<std::array<std::string, 3>>& named) {
  NamedOutputs result;
  for (const auto& [name, type, summary] : named) {
    OutputEntry entry;
    entry.port = name;
    entry.type = type;
    entry.summary = summary;
    result.emplace_back(name, entry);
  }
  return result;
}

const std::array<std::string, 3> cover = {
    "cover", "CoverState", R"({"remaining": 0, "chosen": 286, "lower_bound": 265, "gap": 0.0792})"};
const std::array<std::string, 3> balls = {"balls", "Balls", R"({"count": 286})"};
const std::array<std::string, 3> kept = {"topology", "TopologyTable",
                                         R"({"words": "1 component", "changes": 0})"};
const std::array<std::string, 3> changed = {"topology", "TopologyTable",
                                            R"({"words": "pruning opened 9 tunnels", "changes": 1})"};

TEST(key_facts, are_the_balls_and_the_topology) {
  const auto facts = key_facts(outputs({balls, kept, cover}), Json::object());
  ASSERT_EQ(facts.size(), 2u);
  EXPECT_EQ(facts[0], "286 balls chosen, at least 265 needed, gap 7.92 %");
  EXPECT_EQ(facts[1], "topology kept: 1 component");
}

TEST(key_facts, tell_returned_balls_from_those_that_cover) {
  const std::array<std::string, 3> repaired = {
      "cover", "CoverState",
      R"({"remaining": 0, "chosen": 300, "returned": 60, "lower_bound": 200, "gap": 0.5})"};
  EXPECT_EQ(
      key_facts(outputs({repaired, balls}), Json::object())[0],
      "300 balls chosen (60 of them for the topology), at least 200 needed to cover, gap 50.00 %, 20.00 % "
      "without those");
}

TEST(key_facts, do_not_call_what_covers_balls_where_no_balls_come_out) {
  EXPECT_EQ(key_facts(outputs({cover}), Json::object())[0], "286 chosen, at least 265 needed, gap 7.92 %");
  const std::array<std::string, 3> one = {"cover", "CoverState",
                                          R"({"remaining": 0, "chosen": 1, "lower_bound": 1, "gap": 0})"};
  EXPECT_EQ(key_facts(outputs({one, balls}), Json::object())[0], "1 ball chosen, the fewest possible");
  EXPECT_EQ(key_facts(outputs({one}), Json::object())[0], "1 chosen, the fewest possible");
}

TEST(key_facts, name_the_balls_that_are_the_result) {
  const std::array<std::string, 3> a = {"a", "Balls", R"({"count": 3})"},
                                   sum = {"sum", "Balls", R"({"count": 9})"};
  EXPECT_EQ(key_facts(outputs({a, sum}), Json::object()), (std::vector<std::string>{"9 sum balls"}));
  EXPECT_EQ(key_facts(outputs({a, balls, sum}), Json::object()), (std::vector<std::string>{"286 balls"}));
}

TEST(key_facts, say_what_to_do_about_a_changed_topology) {
  const auto facts = key_facts(outputs({changed}), Json{{"repair", "none"}});
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_NE(facts[0].find("CHANGED: pruning opened 9 tunnels; --set repair=topology"), std::string::npos)
      << facts[0];
  // A graph without that parameter, or with repair, has no such remedy.
  EXPECT_EQ(key_facts(outputs({changed}), Json::object())[0], "topology CHANGED: pruning opened 9 tunnels");
  EXPECT_EQ(key_facts(outputs({changed}), Json{{"repair", "topology"}})[0],
            "topology CHANGED: pruning opened 9 tunnels");
}

TEST(key_facts, do_not_call_the_topology_kept_that_nobody_knows) {
  const auto facts = key_facts(
      outputs({{"t", "TopologyTable", R"({"words": "1 component", "changes": 0, "surface": null})"}}),
      Json::object());
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_NE(facts[0].find("that of a solid is not known"), std::string::npos) << facts[0];
  EXPECT_NE(
      remedy_for("the topology of the solid is unknown: the surface is open", Json::object()).find("look"),
      std::string::npos);
}

TEST(key_facts, say_when_samples_are_left_uncovered) {
  const auto facts = key_facts(
      outputs({{"check", "CoverCheck", R"({"covered": 48483, "samples": 48485})"}, cover}), Json::object());
  ASSERT_EQ(facts.size(), 2u);
  EXPECT_EQ(facts[1], "NOT everything is covered: 48 483 of 48 485 covered");
  EXPECT_EQ(
      key_facts(outputs({{"check", "CoverCheck", R"({"covered": 5, "samples": 5})"}, cover}), Json::object())
          .size(),
      1u);
}

TEST(key_facts, are_three_at_most_and_none_for_foreign_types_and_broken_summaries) {
  const std::array<std::string, 3> mass = {"measure", "MassProperties",
                                           R"({"volume": 0.523598, "area": 3.14159})"};
  EXPECT_EQ(key_facts(outputs({mass}), Json::object()),
            (std::vector<std::string>{"volume 0.5236, area 3.142"}));
  const std::array<std::string, 3> growth = {"search", "Bisection", R"({"value": 0.25, "tried": 7})"};
  const auto facts = key_facts(outputs({mass, growth, cover, kept}), Json::object());
  ASSERT_EQ(facts.size(), 3u);
  EXPECT_EQ(facts[2], "growth 0.25 after 7 trials");
  EXPECT_TRUE(key_facts(outputs({{"x", "acme.Grid", R"({"cells": 3})"}}), Json::object()).empty());
  EXPECT_TRUE(key_facts(outputs({{"x", "CoverState", R"({"chosen": "many"})"}}), Json::object()).empty());
  EXPECT_TRUE(key_facts(outputs({{"x", "TopologyTable", "not JSON"}}), Json::object()).empty());
}

TEST(key_facts, of_shapes_say_how_good_a_model_is_and_how_far_from_it_a_scan) {
  const std::array<std::string, 3> prior = {
      "prior", "ShapePrior",
      R"({"instances": 4, "balls": 40, "modes": 3, "compactness": [0.5, 0.75, 1], "generalization": [2, 1.5, 1.25]})"};
  const std::array<std::string, 3> fit = {
      "fit", "ShapeFit",
      R"({"observed": 1000, "residual": 0.5, "expected": 1.25, "outliers": 0.1, "mahalanobis": 2, "converged": false})"};
  EXPECT_EQ(key_facts(outputs({prior, fit}), Json::object()),
            (std::vector<std::string>{"1 000 points or balls, 0.5 away (unknown instances: 1.25), 10.00 % "
                                      "outliers, scores of size 2, NOT at rest",
                                      "4 instances of 40 balls, 3 modes, of the variance in the first ones: "
                                      "50.00 %, 75.00 %, 100.00 %; unknown "
                                      "instances 1.25 away, from the mean 2"}));
  EXPECT_EQ(key_facts(outputs({{"x", "ShapePrior", R"({"balls": 3})"}}), Json::object()),
            (std::vector<std::string>{"ShapePrior, balls 3"}));
}

TEST(describe, says_which_instance_is_the_template_and_how_a_mesh_of_a_model_folds) {
  const auto said = [](const char* type, const char* summary) {
    return describe(outputs({{"x", type, summary}}).front().second);
  };
  EXPECT_EQ(said("PointSet", R"({"count": 1000})"), "1 000 points");
  EXPECT_EQ(said("PointSet", R"({"count": 1000, "instance": 3})"),
            "1 000 points of the template, instance 3 (template=3 keeps it when shapes are added)");
  EXPECT_EQ(said("TriangleMesh", R"({"faces": 12, "closed": true, "genus": 0, "folded_triangles": 0,
                                     "self_intersections": 0, "mean_distance_from_balls": 0.25})"),
            "12 triangles, closed, genus 0, 0.25 from the balls");
  EXPECT_EQ(said("TriangleMesh", R"({"faces": 12, "closed": true, "genus": 0, "folded_triangles": 2,
                                     "self_intersections": 1, "mean_distance_from_balls": 0.25})"),
            "12 triangles, closed, genus 0, 2 triangles FOLDED, 1 self-intersection, 0.25 from the balls");
  EXPECT_EQ(said("TriangleMesh", R"({"faces": 1, "closed": false, "frame": "the axes of the grid"})"),
            "1 triangle, open; x, y, z: the axes of the grid");
}

// The rows of a cover may be ellipsoids: strategies of pruning do not ask.
TEST(describe, says_of_a_cover_how_many_and_not_what) {
  const auto said = [](const char* summary) {
    return describe(outputs({{"x", "CoverState", summary}}).front().second);
  };
  EXPECT_EQ(said(R"({"remaining": 0, "chosen": 60, "lower_bound": 7, "gap": 7.5})"),
            "60 chosen, at least 7 needed, gap 750.00 %");
  EXPECT_EQ(said(R"({"remaining": 9, "rows": 70, "cols": 9, "nnz": 300, "left_out": 2, "chosen": 5})"),
            "70 x 9, 300 entries, 2 balls left out, 5 chosen");
}

TEST(remedy, is_about_the_first_step_that_changed_the_topology) {
  const Json params = {{"repair", "none"}, {"epsilon", 0.3}};
  EXPECT_NE(remedy_for("the union of inner balls closed 2 tunnels", params).find("ballflow look"),
            std::string::npos);
  EXPECT_NE(remedy_for("growing closed 1 tunnel", params).find("epsilon"), std::string::npos);
  EXPECT_EQ(remedy_for("growing closed 1 tunnel", Json::object()), "");
  // It names what the graph has, and nothing that is chosen already.
  EXPECT_NE(remedy_for("growing closed 1 tunnel", params).find("enlarge.mode=power_diagram"),
            std::string::npos);
  EXPECT_NE(remedy_for("growing closed 1 tunnel", {{"epsilon", 1}, {"growth", "additive"}})
                .find("growth=power_diagram"),
            std::string::npos);
  EXPECT_EQ(remedy_for("growing closed 1 tunnel", {{"epsilon", 1}, {"growth", "power_diagram"}}),
            "a smaller epsilon grows less");
  const std::string coarse = "the union of inner balls opened 1 tunnel";
  EXPECT_NE(remedy_for(coarse, {{"sampling", "vertices"}}).find("sampling=adaptive"), std::string::npos);
  EXPECT_NE(remedy_for(coarse, {{"sampling", "auto"}}).find("smaller delta"), std::string::npos);
  EXPECT_EQ(remedy_for("12 vertices equal earlier ones and are welded to it", params), "");
}

}  // namespace
}  // namespace ballflow::cli

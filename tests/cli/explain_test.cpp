// Why a node runs again, as a user asks it.
#include <gtest/gtest.h>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

struct ExplainCliTest : testing::Test {
  std::string ballflow(std::vector<std::string> arguments, int expected = 0) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    const auto result = test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
    EXPECT_EQ(result.exit_code, expected) << result.err;
    return result.out + result.err;
  }
  void run(const std::string& epsilon) {
    ballflow({"run", graph, "--quiet", "--set", "input=shape:torus?n=600", "--set", "strategy=hybrid",
              "--set", "sampling=vertices", "--set", "epsilon=" + epsilon});
  }
  static void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
      EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  }

  test::TempFolder folder;
  const std::string graph = test::source_file("graphs/medial_axis.json");
};

TEST_F(ExplainCliTest, tells_what_changed_since_the_run_before_without_having_been_asked_to_record) {
  run("0.3");
  run("0.5");
  const std::string enlarge = ballflow({"explain", "enlarge"});
  expect_words(enlarge, {"enlarge (Enlarge): run 2", "params.epsilon 0.3 -> 0.5",
                         "input balls: same content (dmt/sampling/label.inner)"});
  EXPECT_EQ(enlarge.find("because of"), std::string::npos) << enlarge;
  const std::string matrix = ballflow({"explain", "matrix"});
  expect_words(matrix, {"input balls: other content (enlarge.balls)",
                        "because of enlarge: params.epsilon 0.3 -> 0.5"});
  expect_words(ballflow({"explain", "prune/rounds"}), {"input cover: other content (prune/share.cover)",
                                                       "because of enlarge: params.epsilon 0.3 -> 0.5"});
  expect_words(ballflow({"explain", "prune/rounds/reduce"}),
               {"prune/rounds/reduce (Reduce)", "input cover: other content (prune/rounds.cover)",
                "because of enlarge"});
  expect_words(ballflow({"explain", "prune/rounds/exact"}),
               {"input cover: from the same port (prune/rounds/reduce.cover)",
                "nothing differs; the loop prune/rounds is what has a key"});
  expect_words(ballflow({"explain", "dmt/sampling/sample"}), {"nothing differs: the key is the same"});
}

TEST_F(ExplainCliTest, tells_what_the_next_run_of_a_graph_would_do) {
  run("0.3");
  const std::vector<std::string> next = {graph,
                                         "--set",
                                         "input=shape:torus?n=600",
                                         "--set",
                                         "strategy=hybrid",
                                         "--set",
                                         "sampling=vertices",
                                         "--set",
                                         "epsilon=0.5"};
  const auto ask = [&](const std::string& node) {
    std::vector<std::string> arguments = {"explain", node};
    arguments.insert(arguments.end(), next.begin(), next.end());
    return ballflow(arguments);
  };
  expect_words(ask("enlarge"), {"the next run against run ", "params.epsilon 0.3 -> 0.5"});
  expect_words(ask("select"), {"input balls: not known before matrix has run", "because of enlarge"});
  run("0.5");
  expect_words(ask("select"), {"nothing differs"});
  std::vector<std::string> against = {"explain", "enlarge", "--against", "previous"};
  against.insert(against.end(), next.begin(), next.end());
  expect_words(ballflow(against), {"params.epsilon 0.3 -> 0.5"});
}

TEST_F(ExplainCliTest, says_what_it_lacks) {
  expect_words(ballflow({"explain", "enlarge"}, 2), {"run"});
  run("0.3");
  expect_words(ballflow({"explain", "enlarg", graph}, 2),
               {"there is no node \"enlarg\"", "did you mean \"enlarge\"?"});
  expect_words(ballflow({"explain", "enlarge", graph, "--against", "nonsense"}, 2), {"nonsense"});
}

}  // namespace
}  // namespace ballflow

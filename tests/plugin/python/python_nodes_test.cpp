// Nodes that are written in Python: what they give, and when they are computed again.
#include <gtest/gtest.h>

#include "python_nodes_fixture.hpp"

namespace ballflow {
namespace {

TEST_F(PythonNodes, run_in_a_graph_and_are_found_in_the_cache) {
  using States = std::map<std::string, std::string>;
  EXPECT_EQ(states({"--out", folder.path(), "--format", "balls=csv"}),
            (States{{"row", "run"}, {"scale", "run"}, {"alpha", "run"}}));
  const std::string balls = test::read_file(folder.file("balls.csv"));
  EXPECT_NE(balls.find("\n6,0,0,3"), std::string::npos) << balls;
  EXPECT_EQ(states(), (States{{"row", "hit"}, {"scale", "hit"}, {"alpha", "hit"}}));
  EXPECT_TRUE(processes().empty());

  // A comment, and a function that the node does not call.
  replace("nodes.py", "def unrelated():\n    return 1", "def unrelated():  # a comment\n    return 2");
  EXPECT_EQ(states(), (States{{"row", "hit"}, {"scale", "hit"}, {"alpha", "hit"}}));
  // A function that it does call, and to what gives the same: what comes after it stays.
  replace("nodes.py", "return x * 1.0", "return x / 1.0");
  EXPECT_EQ(states(), (States{{"row", "hit"}, {"scale", "run"}, {"alpha", "hit"}}));
  replace("nodes.py", "return x / 1.0", "return x + 1.0");
  const ProcessResult plan = ballflow({"plan", folder.file("graph.json")});
  EXPECT_NE(plan.out.find("source of the node: other content"), std::string::npos) << plan.out;
  EXPECT_EQ(states(), (States{{"row", "hit"}, {"scale", "run"}, {"alpha", "run"}}));
}

TEST_F(PythonNodes, are_described_and_listed_like_others) {
  const ProcessResult described = ballflow({"nodes", "Scale"});
  EXPECT_NE(described.out.find("Multiplies every radius."), std::string::npos) << described.out;
  EXPECT_NE(described.out.find("factor = 2.0"), std::string::npos) << described.out;
  const ProcessResult listed = ballflow({"plugins"});
  EXPECT_NE(listed.out.find("nodes Python 3."), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("  nodes: Row, Scale\n"), std::string::npos) << listed.out;
}

TEST_F(PythonNodes, have_summaries_and_digests_like_nodes_in_cpp) {
  // The same balls from a node in C++: what comes after cannot tell who made them.
  file("same.py", R"(import ballflow as bf
@bf.node
def Again(balls: bf.Balls) -> bf.Balls:
    arrays = dict(balls.arrays)
    assert balls.summary["count"] == len(balls.radii)
    assert not balls.centers.flags.writeable
    return bf.Balls(**arrays)
)");
  file("same.json", R"({"nodes": {
    "sample": {"type": "Shape", "params": {"shape": "sphere", "n": 300}},
    "poles": {"type": "VoronoiPoles", "inputs": {"points": "sample.points"}},
    "labels": {"type": "LabelPoles", "inputs": {"poles": "poles.poles", "mesh": "sample.mesh"}},
    "again": {"type": "Again", "inputs": {"balls": "labels.inner"}}},
    "outputs": {"before": "labels.inner", "after": "again.balls"}})");
  const ProcessResult result =
      ballflow({"run", folder.file("same.json"), "--report", folder.file("report.json")}, "same.py");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json nodes = json::parse(test::read_file(folder.file("report.json"))).at("nodes");
  const json before = nodes.at("labels").at("outputs").at("inner");
  EXPECT_EQ(before, nodes.at("again").at("outputs").at("balls"));
  EXPECT_GT(before.at("summary").at("count"), 100);
}

TEST_F(PythonNodes, give_the_same_with_one_thread_and_with_several) {
  const ProcessResult same =
      ballflow({"run", folder.file("graph.json"), "--check-determinism", "--threads", "2"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  file("nodes.py", "import os\n" + scale);
  replace("nodes.py", "np.ones(count)", "np.full(count, 1.0 + int.from_bytes(os.urandom(6), \"big\"))");
  const ProcessResult other =
      ballflow({"run", folder.file("graph.json"), "--check-determinism", "--threads", "2"});
  EXPECT_EQ(other.exit_code, 3) << other.err;
}

TEST_F(PythonNodes, print_and_warn_in_their_own_name) {
  replace("nodes.py", "    print(\"scaling\")\n", R"(    import sys, warnings, subprocess
    print("first", end=" ")
    print("line \x1b[31m")
    print("to stderr", file=sys.stderr)
    subprocess.run(["echo", "from a child"])
    warnings.warn("be careful")
    np.log(np.zeros(1))
)");
  const ProcessResult result = ballflow({"run", folder.file("graph.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* line : {"scale: first line ", "scale: to stderr", "scale: from a child",
                           "scale: warning: UserWarning: be careful (nodes.py:",
                           "scale: warning: RuntimeWarning: divide by zero encountered in log (nodes.py:"})
    EXPECT_NE(result.err.find(line), std::string::npos) << line << " in " << result.err;
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos) << "nothing of it reaches the terminal raw";
}

TEST_F(PythonNodes, run_side_by_side) {
  // Each waits until all four have begun.
  file("meet.py", R"(import os, time
import ballflow as bf
import numpy as np
@bf.node
def Meet(place: str, number: int) -> bf.Balls:
    open(os.path.join(place, f"here{number}"), "w").close()
    end = time.monotonic() + 60
    while not all(os.path.exists(os.path.join(place, f"here{i}")) for i in range(4)):
        if time.monotonic() > end:
            raise RuntimeError("nobody came")
        time.sleep(0.005)
    return bf.Balls(np.zeros((1, 3)), [float(number)])
)");
  json graph = {{"nodes", json::object()}};
  for (int i = 0; i < 4; ++i) {
    graph["nodes"]["meet" + std::to_string(i)] = {{"type", "Meet"},
                                                  {"params", {{"place", folder.path()}, {"number", i}}}};
    graph["outputs"]["balls" + std::to_string(i)] = "meet" + std::to_string(i) + ".balls";
  }
  file("meet.json", graph.dump());
  const ProcessResult result = ballflow({"run", folder.file("meet.json"), "--threads", "4"}, "meet.py");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(all_end());
}

TEST_F(PythonNodes, take_lists_files_choices_and_what_may_be_absent) {
  file("all.py", R"(from pathlib import Path
from typing import Annotated, Literal, Optional
import ballflow as bf
import numpy as np
@bf.node
def All(
    many: list[bf.Balls],
    maybe: Optional[bf.Balls],
    ctx: bf.Context,
    data: Path,
    how: Literal["a", "b"] = "b",
    yes: bool = True,
    text: Annotated[str, "some words"] = "x\"y",
    count: int = 2,
) -> bf.Balls:
    radii = [len(many), 0 if maybe is None else 1, float(data.read_text()), how == "b", yes, len(text), count,
             ctx.threads > 0]
    return bf.Balls(np.zeros((8, 3)), radii)
@bf.node(seed=True)
def Random(ctx: bf.Context) -> bf.Balls:
    rng = np.random.default_rng(ctx.seed)
    return bf.Balls(rng.random((4, 3)), np.ones(4))
@bf.node
def NoSeed(ctx: bf.Context) -> bf.Balls:
    return bf.Balls(np.zeros((1, 3)), [ctx.seed])
)");
  file("number", "12.5");
  file("graph.json", R"({"params": {"data": {"kind": "file", "doc": "a number"}}, "nodes": {
    "r": {"type": "Random"},
    "all": {"type": "All", "params": {"data": "${data}"}, "inputs": {"many": ["r.balls", "r.balls", "r.balls"]}}},
    "outputs": {"balls": "all.balls"}})");
  const auto run = [&](const std::string& seed) {
    return ballflow({"run", folder.file("graph.json"), "--set", "data=" + folder.file("number"), "--seed",
                     seed, "--out", folder.path(), "--format", "balls=csv"},
                    "all.py");
  };
  const ProcessResult first = run("1");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  std::string radii;
  std::istringstream csv(test::read_file(folder.file("balls.csv")));
  for (std::string line; std::getline(csv, line);) radii += line.substr(line.rfind(',') + 1) + " ";
  EXPECT_NE(radii.find("3 0 12.5 1 1 3 2 1 "), std::string::npos) << radii;
  EXPECT_NE(run("1").out.find("0 run, 2 from the cache"), std::string::npos);
  EXPECT_NE(run("2").out.find("2 run, 0 from the cache"), std::string::npos) << "the seed is in the key";
  file("number", "13");
  EXPECT_NE(run("2").out.find("1 run, 1 from the cache"), std::string::npos)
      << "so is the content of the file";
  const ProcessResult refused = ballflow({"exec-node", "NoSeed"}, "all.py");
  EXPECT_NE(refused.err.find("the node does not say that it uses the seed"), std::string::npos)
      << refused.err;
}

TEST_F(PythonNodes, of_the_documentation_run) {
  const std::string page = test::read_file(test::source_file("docs/python_nodes.md"));
  const auto block = [&](const std::string& language) {
    const std::string begin = "```" + language + "\n";
    const std::size_t at = page.find(begin) + begin.size();
    return page.substr(at, page.find("```", at) - at);
  };
  file("nodes.py", block("python"));
  file("graph.json", block("json"));
  const ProcessResult result = ballflow({"run", folder.file("graph.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("4 run"), std::string::npos) << result.out;
}

TEST_F(PythonNodes, digests_follow_what_a_function_is_made_of) {
  const ProcessResult result =
      test::run_process({interpreter(), test::source_file("tests/plugin/python/digests.py"),
                         test::source_file("tools/python/ballflow"), folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(PythonNodes, have_the_same_keys_in_a_python_program) {
  std::map<std::string, std::string> variables = environment();
  variables["PYTHONPATH"] = test::binary_file("python") + ":" + folder.path();
  if (test::run_process({interpreter(), "-c", "import ballflow"}, variables).exit_code != 0)
    GTEST_SKIP() << "the Python package is not built";
  states();
  const ProcessResult result =
      test::run_process({interpreter(), "-c",
                         "import sys, ballflow as bf, nodes\n"
                         "run = bf.run(sys.argv[1])\n"
                         "print(run['row'].status, run['scale'].status, run.balls.radii[0])\n",
                         folder.file("graph.json")},
                        variables);
  EXPECT_EQ(result.out, "hit hit 3.0\n") << result.err;
}

}  // namespace
}  // namespace ballflow

// Nodes that are written in Python: what they give, when they are computed again, how they fail and end.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "ballflow/registry.hpp"
#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

/// An interpreter that has numpy; empty where there is none.
const std::string& interpreter() {
  static const std::string found = [] {
    const char* const named = std::getenv("BALLFLOW_PYTHON");
    for (const std::string& python :
         {std::string(named != nullptr ? named : ""), std::string("/usr/bin/python3"),
          std::string("/usr/local/bin/python3")}) {
      if (!python.empty() && fs::exists(python) &&
          test::run_process({python, "-c", "import sys, numpy; assert sys.version_info >= (3, 10)"})
                  .exit_code == 0)
        return python;
    }
    return std::string();
  }();
  return found;
}

const std::string scale = R"(import ballflow as bf
import numpy as np

def factor_of(x):
    return x * 1.0

def unrelated():
    return 1

@bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
def Scale(balls, factor: float = 2.0):
    "Multiplies every radius."
    print("scaling")
    return bf.Balls(balls.centers, balls.radii * factor_of(factor))

@bf.node
def Row(count: int = 5) -> bf.Balls:
    "Balls in a row."
    centers = np.zeros((count, 3))
    centers[:, 0] = np.arange(count)
    return bf.Balls(centers, np.ones(count))
)";

const std::string scale_graph = R"({"nodes": {
  "row": {"type": "Row", "params": {"count": 7}},
  "scale": {"type": "Scale", "params": {"factor": 3}, "inputs": {"balls": "row.balls"}},
  "alpha": {"type": "AlphaShape", "inputs": {"balls": "scale.balls"}}},
  "outputs": {"balls": "scale.balls", "complex": "alpha.complex"}})";

struct PythonNodes : testing::Test {
  void SetUp() override {
    if (interpreter().empty())
      GTEST_SKIP() << "no python3 (3.10 or later) with numpy; see tools/packages.txt";
    file("nodes.py", scale);
    file("graph.json", scale_graph);
  }

  std::string file(const std::string& name, const std::string& content) {
    test::write_file(folder.file(name), content);
    return folder.file(name);
  }
  std::map<std::string, std::string> environment() const {
    return {{"BALLFLOW_CACHE", folder.file("cache")}, {"BALLFLOW_PYTHON", interpreter()}};
  }
  ProcessResult ballflow(std::vector<std::string> arguments, const std::string& library = "nodes.py") const {
    arguments.insert(arguments.begin(),
                     {test::binary_file("bin/ballflow"), "--plugin", folder.file(library)});
    return test::run_process(arguments, environment());
  }
  /// Runs the graph, or another one; what each node did ("run", "hit").
  std::map<std::string, std::string> states(std::vector<std::string> options = {},
                                            const std::string& graph = "graph.json") const {
    options.insert(options.begin(), {"run", folder.file(graph), "--report", folder.file("report.json")});
    const ProcessResult result = ballflow(options);
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    std::map<std::string, std::string> all;
    if (result.exit_code != 0) return all;
    const json report = json::parse(test::read_file(folder.file("report.json")));
    for (const auto& [path, node] : report.at("nodes").items()) all[path] = node.at("status");
    return all;
  }
  void replace(const std::string& name, const std::string& what, const std::string& by) const {
    std::string content = test::read_file(folder.file(name));
    const std::size_t at = content.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    test::write_file(folder.file(name), content.replace(at, what.size(), by));
  }
  /// Processes that were started with this cache: no other test has it.
  std::vector<std::string> processes() const {
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      try {
        const std::string command = test::read_file("/proc/" + name + "/cmdline");
        if (command.find("_worker.py") != std::string::npos &&
            test::read_file("/proc/" + name + "/environ").find(folder.path()) != std::string::npos)
          found.push_back(name);
      } catch (const std::exception&) {
        continue;  // it has ended meanwhile, or is somebody else's
      }
    }
    return found;
  }
  /// The kernel takes a moment to end what a killed process has left.
  bool all_end() const {
    for (int i = 0; i < 1000 && !processes().empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return processes().empty();
  }

  test::TempFolder folder;
};

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

TEST_F(PythonNodes, that_fail_say_where_and_what) {
  file("bad.py", R"(import ctypes, os, sys
import numpy as np
import ballflow as bf

def inner():
    raise ValueError("too few\nballs")

@bf.node
def Raise() -> bf.Balls:
    inner()

@bf.node
def Exit() -> bf.Balls:
    print("last words", end="")
    os._exit(3)

@bf.node
def Crash() -> bf.Balls:
    ctypes.string_at(0)

@bf.node
def Leave() -> bf.Balls:
    sys.exit(4)

@bf.node
def WrongType() -> bf.Balls:
    return np.zeros(3)

@bf.node
def WrongShape() -> bf.Balls:
    return bf.Balls(np.zeros((3, 2)), np.zeros(3))

@bf.node
def NoNumber() -> bf.Balls:
    return bf.Balls(np.zeros((3, 3)), [1, 2, np.nan])

@bf.node(outputs={"a": bf.Balls, "b": bf.Balls})
def TooFew():
    return {"a": bf.Balls(np.zeros((1, 3)), [1])}

def write(text):
    names = os.listdir("/proc/self/fd")
    channel = next(int(n) for n in names if os.path.realpath(f"/proc/self/fd/{n}").split("/")[-1].startswith("socket:"))
    os.write(channel, text)

radii = b'{"name": "radii", "dtype": "f64", "shape": [9], "offset": 0}'

@bf.node
def Rubbish() -> bf.Balls:
    write(b'rubbish\n[1]\n{"of": 0, "outputs": 3}\n{"of": 1000000, "outputs": {}}\n{"progress": 1}\n')
    for number in range(1, 30):  # one of them is its own
        write(b'{"of": %d, "outputs": {"balls": {"arrays": [%s]}}}\n' % (number, radii))
    while True:
        pass

@bf.node
def Fine() -> bf.Balls:
    return bf.Balls(np.zeros((3, 3)), [1, 2, 3])
)");
  const std::vector<std::pair<std::string, std::string>> causes = {
      {"Raise", "ValueError: too few balls (bad.py:6, in inner)"},
      {"Exit", "its Python process ended with exit status 3 before the function returned"},
      {"Crash", "its Python process was ended by signal 11 (Segmentation fault)"},
      {"Leave", "SystemExit: 4 (bad.py:23, in Leave)"},
      {"WrongType", "TypeError: WrongType returned a ndarray for its output 'balls', must be ballflow.Balls"},
      {"WrongShape", "ValueError: Balls.centers is 3 x 2, must be n x 3 (bad.py:31, in WrongShape)"},
      {"NoNumber", "output \"balls\" is no valid Balls: ball 2 has radius nan"},
      {"TooFew", "TypeError: TooFew returned nothing for its output 'b', must be ballflow.Balls"},
      {"Rubbish", "its process handed over no memory that can be sealed"}};
  json graph = {{"nodes", json::object()}, {"outputs", json::object()}};
  for (const auto& [node, cause] : causes) graph["nodes"][node] = {{"type", node}};
  graph["nodes"]["Fine"] = {{"type", "Fine"}};
  for (const auto& [node, description] : graph["nodes"].items())
    graph["outputs"][node] = node + (node == "TooFew" ? ".a" : ".balls");
  file("bad.json", graph.dump());
  const ProcessResult result = ballflow({"run", folder.file("bad.json"), "--keep-going"}, "bad.py");
  EXPECT_EQ(result.exit_code, 3);
  for (const auto& [node, cause] : causes)
    EXPECT_NE(result.err.find("node " + node + " (" + node + ") failed: " + cause), std::string::npos)
        << node;
  EXPECT_NE(result.err.find("Raise: ValueError: too few"), std::string::npos) << "the traceback is a message";
  EXPECT_NE(result.err.find("Exit: last words"), std::string::npos) << "so is what was printed";
  EXPECT_NE(result.err.find("--plugin " + folder.file("bad.py") + " exec-node Raise"), std::string::npos);
  EXPECT_NE(result.out.find("1 run"), std::string::npos) << "the others go on: " << result.out;
  if (HasFailure()) std::fputs(result.err.c_str(), stderr);
  EXPECT_TRUE(all_end());
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

/// Starts a node that never ends and a child of it, and sends `signal` to the program when both are there.
const std::string interrupt = R"(
"$1" --plugin "$2/loop.py" exec-node Loop --set "place=$2" 2>"$2/log" &
program=$!
until [[ -e $2/started ]]; do kill -0 $program || exit 1; sleep 0.01; done
kill "-$3" $program
wait $program
echo "exit code $?"
)";

TEST_F(PythonNodes, end_when_they_are_cancelled_and_when_the_engine_is_killed) {
  file("loop.py", R"(import os, signal, subprocess
import ballflow as bf
@bf.node
def Loop(place: str) -> bf.Balls:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    open(os.path.join(place, "started"), "w").close()
    while True:
        pass
)");
  for (const auto& [signal, code] : {std::pair{"TERM", 4}, std::pair{"KILL", 137}}) {
    fs::remove(folder.file("started"));
    const ProcessResult result = test::run_process(
        {"/bin/bash", "-c", interrupt, "interrupt", test::binary_file("bin/ballflow"), folder.path(), signal},
        environment());
    EXPECT_EQ(result.out, "exit code " + std::to_string(code) + "\n") << test::read_file(folder.file("log"));
    EXPECT_TRUE(all_end()) << signal;
  }
}

TEST_F(PythonNodes, files_that_cannot_be_used_are_refused_with_words) {
  const auto refusal = [&](const std::string& content) {
    file("wrong.py", content);
    const ProcessResult result = ballflow({"nodes"}, "wrong.py");
    EXPECT_EQ(result.exit_code, 6) << content;
    return result.err;
  };
  const std::string start = "the node library " + folder.file("wrong.py") + " ";
  const auto says = [&](const std::string& content, const std::string& words) {
    const std::string err = refusal(content);
    EXPECT_NE(err.find(start + words), std::string::npos) << err;
  };
  says("import ballflow as bf\ndef f(:\n", "cannot be imported: SyntaxError: invalid syntax (wrong.py:2)");
  says("\nimport nowhere_to_be_found\n",
       "cannot be imported: ModuleNotFoundError: No module named 'nowhere_to_be_found' (wrong.py:2)");
  says("x = 1\n", "declares no node: decorate a function with @ballflow.node(...)");
  says("import os\nprint('bye')\nos._exit(5)\n",
       "made " + interpreter() +
           " end while it was imported: it ended with exit status 5; "
           "the last that it printed: bye");
  says("import ballflow as bf\n@bf.node\ndef F(x: complex) -> bf.Balls: pass\n",
       "cannot be imported: TypeError: node F (wrong.py:2): parameter 'x' is annotated with <class "
       "'complex'>");
  says(
      "import ballflow as bf\n@bf.node\ndef F() -> bf.Balls: pass\n@bf.node\ndef F(x: int) -> bf.Balls: "
      "pass\n",
      "declares the node F twice, wrong.py:2 and wrong.py:4");
  says(
      "import ballflow as bf\nfrom typing import Annotated\n@bf.node\n"
      "def F(x: Annotated[float, bf.Range(1, 2)] = 3.0) -> bf.Balls: pass\n",
      "node \"F\": parameter \"x\": \"default\" must be");
  file("json.py", scale);
  EXPECT_NE(ballflow({"nodes"}, "json.py").err.find("has the name of the module json of Python: rename it"),
            std::string::npos);
  EXPECT_NE(ballflow({"nodes"}, "absent.py").err.find("cannot be read: No such file or directory"),
            std::string::npos);
}

TEST_F(PythonNodes, need_an_interpreter_with_numpy) {
  const auto with = [&](const std::string& python) {
    std::map<std::string, std::string> variables = environment();
    variables["BALLFLOW_PYTHON"] = python;
    return test::run_process(
        {test::binary_file("bin/ballflow"), "--plugin", folder.file("nodes.py"), "nodes"}, variables);
  };
  const ProcessResult absent = with(folder.file("no_python"));
  EXPECT_EQ(absent.exit_code, 6);
  EXPECT_NE(absent.err.find("needs Python with numpy: cannot start " + folder.file("no_python")),
            std::string::npos)
      << absent.err;
  EXPECT_NE(absent.err.find("$BALLFLOW_PYTHON"), std::string::npos);
  // An interpreter without its site packages.
  const std::string bare = file("bare", "#!/bin/sh\nexec " + interpreter() + " -S \"$@\"\n");
  fs::permissions(bare, fs::perms::owner_all);
  const ProcessResult without = with(bare);
  EXPECT_EQ(without.exit_code, 6);
  EXPECT_NE(without.err.find("needs numpy, which "), std::string::npos) << without.err;
}

TEST_F(PythonNodes, of_two_files_with_one_id_are_refused) {
  fs::create_directory(folder.file("other"));
  const std::string other = file("other/more.py", scale);
  const auto both = [&] {
    return test::run_process({test::binary_file("bin/ballflow"), "--plugin", folder.file("nodes.py"),
                              "--plugin", other, "run", folder.file("graph.json")},
                             environment());
  };
  EXPECT_EQ(both().exit_code, 0) << "equal functions are one node, wherever they are";
  replace("other/more.py", "return x * 1.0", "return x * 2.0");
  const ProcessResult differ = both();
  EXPECT_EQ(differ.exit_code, 6);
  EXPECT_NE(differ.err.find("node \"Scale\" is declared in the same words by two different files, " +
                            folder.file("nodes.py") + " and " + other),
            std::string::npos)
      << differ.err;
}

/// The engine, as a node sees it that gets nothing and whose outputs nobody wants.
struct Host {
  explicit Host(const std::string& id, std::string parameters) : node(id), params(std::move(parameters)) {
    run.struct_size = sizeof run;
    run.max_threads = 1;
    run.node = {node.data(), node.size()};
    run.params = {params.data(), params.size()};
    run.host = this;
    run.cancelled = [](void*) { return 0; };
    run.progress = [](void*, double) {};
    run.log = [](void*, std::uint32_t, bf_bytes) {};
    run.input_count = [](void*, bf_bytes) { return std::uint64_t{0}; };
    run.input = [](void*, bf_bytes, std::uint64_t, bf_artifact*) { return 0; };
    run.output = [](void*, bf_bytes, const bf_array* arrays, std::uint64_t count, bf_bytes) {
      for (std::uint64_t i = 0; i < count; ++i) arrays[i].release(arrays[i].owner);
      return 0;
    };
    run.fail = [](void* self, bf_bytes why, bf_bytes) {
      static_cast<Host*>(self)->cause = std::string(why.data, why.size);
    };
  }
  int execute(const NodeDeclaration& declaration) {
    return declaration.entry->run(declaration.entry->self, &run);
  }

  std::string node, params, cause;
  bf_run run{};
};

TEST_F(PythonNodes, that_changed_while_a_run_goes_on_fail) {
  const std::string path = file("wait.py", R"(import os, time
import ballflow as bf
import numpy as np
@bf.node
def Wait(place: str) -> bf.Balls:
    open(os.path.join(place, "started"), "w").close()
    while not os.path.exists(os.path.join(place, "go_on")):
        time.sleep(0.005)
    return bf.Balls(np.zeros((1, 3)), [1.0])
@bf.node
def Other() -> bf.Balls:
    return bf.Balls(np.zeros((1, 3)), [2.0])
)");
  setenv("BALLFLOW_PYTHON", interpreter().c_str(), 1);
  const auto registry = Registry::load({path});
  Host waiting("Wait", json{{"place", folder.path()}}.dump()), other("Other", "{}");
  int status = -1;
  std::thread first([&] { status = waiting.execute(*registry->node("Wait")); });
  while (!fs::exists(folder.file("started"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  // The first process is busy: another one reads the file again.
  replace("wait.py", "[2.0]", "[3.0]");
  EXPECT_EQ(other.execute(*registry->node("Other")), BF_FAILED);
  EXPECT_EQ(other.cause, "its file wait.py, or one that it imports, was changed while the run went on");
  file("go_on", "");
  first.join();
  EXPECT_EQ(status, BF_OK) << waiting.cause;
  EXPECT_GT(registry->node("Wait")->memory_fixed, 10'000'000u) << "a process has its size";
  // What waits still has the file as it was.
  EXPECT_EQ(other.execute(*registry->node("Other")), BF_OK);
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

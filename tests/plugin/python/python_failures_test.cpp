// Nodes that are written in Python: how they fail, and how they end.
#include <gtest/gtest.h>

#include "ballflow/registry.hpp"
#include "python_nodes_fixture.hpp"

namespace ballflow {
namespace {

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

}  // namespace
}  // namespace ballflow

// Every registered node looks often enough whether its result is still wanted, and ends soon when it is not.
//
// A host of its own runs the nodes of all graphs across the plugin boundary and takes the time between two
// looks at bf_run::cancelled, and from a cancellation to the end. It is CPU time of the process, so that a
// busy machine does not matter. A graph is left out when other graphs have run all its nodes with the same
// choices. BALLFLOW_TEST_SAMPLES=250000 makes the models large (tools/nightly): then a second is the limit
// that a user meets. BALLFLOW_TEST_GRAPH=medial_axis, or =prune:greedy, runs one graph, with all strategies
// or with one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>

#include "ballflow/artifact_view.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/registry.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using Artifacts = std::map<std::string, ArtifactPtr>;  // by port

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// One execution of one node.
class Execution {
 public:
  /// Cancels at look number `cancel_at`; 0: never.
  Execution(const DagNode& node, Artifacts inputs, std::int64_t cancel_at = 0)
      : node_(node), inputs_(std::move(inputs)), cancel_at_(cancel_at) {
    Json params = Json::object();
    for (const ParamDecl& param : node.kind.params()) params[param.name] = node.params.at(param.name);
    const std::string text = params.dump();
    for (const auto& [port, artifact] : inputs_) views_.emplace(port, artifact);
    bf_run run{};
    run.struct_size = sizeof run;
    run.max_threads = 2;
    run.params = {text.data(), text.size()};
    run.node = {node.kind.type().data(), node.kind.type().size()};
    run.host = this;
    run.cancelled = [](void* self) -> int { return of(self).look() ? 1 : 0; };
    run.progress = [](void*, double) {};
    run.log = [](void*, std::uint32_t, bf_bytes) {};
    run.input_count = [](void* self, bf_bytes port) -> std::uint64_t {
      std::uint64_t count = 0;
      while (of(self).find({port.data, port.size}, count) != of(self).views_.end()) ++count;
      return count;
    };
    run.input = [](void* self, bf_bytes port, std::uint64_t index, bf_artifact* artifact) -> int {
      const auto found = of(self).find({port.data, port.size}, index);
      if (found == of(self).views_.end()) return 0;
      *artifact = found->second.raw();
      return 1;
    };
    run.output = [](void* self, bf_bytes port, const bf_array* arrays, std::uint64_t count,
                    bf_bytes summary) -> int {
      of(self).keep(std::string(port.data, port.size), arrays, count, {summary.data, summary.size});
      return 0;
    };
    run.fail = [](void* self, bf_bytes why, bf_bytes) { of(self).cause.assign(why.data, why.size); };
    const bf_node& entry = *node.kind.declared()->entry;
    last_ = cpu_seconds();
    status = entry.run(entry.self, &run);
    const double end = cpu_seconds();
    since_last_look(end);
    if (cancelled_at_ >= 0) latency = end - cancelled_at_;
  }
  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;

  int status = BF_FAILED;
  std::string cause;
  Artifacts outputs;
  std::int64_t looks = 0;
  double longest = 0;  // between two looks, from the start to the first, or from the last to the end
  std::int64_t longest_after = 0;  // that many looks
  double latency = 0;              // from the cancellation to the end

 private:
  /// An input by its port and, of a list, its place there.
  std::map<std::string, ArtifactView>::const_iterator find(const std::string& port,
                                                           std::uint64_t index) const {
    const PortDecl* decl = find_input(node_.kind.inputs(), port);
    const bool list = find_input(node_.kind.inputs(), list_slot(port, 0)) != nullptr;
    if (decl == nullptr && !list) return views_.end();
    if (list) return views_.find(list_slot(port, index));
    return index == 0 ? views_.find(port) : views_.end();
  }

  static Execution& of(void* self) { return *static_cast<Execution*>(self); }

  void since_last_look(double now) {
    if (now - last_ <= longest) return;
    longest = now - last_;
    longest_after = looks;
  }

  bool look() {
    const std::lock_guard lock(mutex_);
    const double now = cpu_seconds();
    since_last_look(now);
    last_ = now;
    if (++looks == cancel_at_) cancelled_at_ = now;
    return cancelled_at_ >= 0;
  }

  void keep(const std::string& port, const bf_array* arrays, std::uint64_t count, std::string_view summary) {
    struct Owner {
      std::vector<bf_array> arrays;
      Artifacts inputs;  // an output may share their arrays
      ~Owner() {
        for (const bf_array& array : arrays) array.release(array.owner);
      }
    };
    const auto owner = std::make_shared<Owner>();
    owner->arrays.assign(arrays, arrays + count);
    owner->inputs = inputs_;
    std::vector<NamedArray> named;
    for (const bf_array& array : owner->arrays) {
      named.push_back({{array.name.data, static_cast<std::size_t>(array.name.size)},
                       array.dtype,
                       {array.shape, array.shape + array.rank},
                       array.data});
    }
    const PortDecl* decl = node_.kind.output(port);
    outputs[port] = Artifact::seal(decl->type, decl->type_version, std::move(named), summary, owner);
  }

  const DagNode& node_;
  const Artifacts inputs_;
  const std::int64_t cancel_at_;
  std::map<std::string, ArtifactView> views_;
  std::mutex mutex_;
  double last_ = 0, cancelled_at_ = -1;
};

std::size_t samples() {
  const char* const variable = std::getenv("BALLFLOW_TEST_SAMPLES");
  return variable == nullptr ? 20000 : std::stoul(variable);
}

bool large() { return samples() > 200000; }

/// The models of these graphs have a fifth of the samples: they would take most of the time. Large models are
/// whole.
bool is_dear(const std::string& graph) {
  static const std::set<std::string> dear{"ball_mesh", "dmt", "enclose", "inside", "medial_axis", "protrude"};
  return !large() && dear.count(graph) != 0;
}

/// CPU seconds.
double limit() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr double slower = 10;
#else
  constexpr double slower = 1;
#endif
  return large() ? 1.0 : 0.12 * slower;
}

class Cancellation : public testing::Test {
 protected:
  static const Registry& registry() {
    static const auto instance = Registry::load();
    return *instance;
  }

  /// The state of a loop when it no longer changes.
  Artifacts repeat(const Loop& loop, Artifacts state) {
    for (int iteration = 0; iteration < 1000 && !HasFatalFailure(); ++iteration) {
      bool changed = false;
      for (auto& [name, artifact] : examine(loop.body, state)) {
        changed = changed || artifact->digest() != state[name]->digest();
        state[name] = artifact;
      }
      if (!changed) break;
    }
    return state;
  }

  /// Runs all nodes; returns the outputs of `dag`.
  Artifacts examine(const Dag& dag, const Artifacts& from_outside) {
    std::vector<Artifacts> made(dag.nodes.size());
    const auto artifact = [&](const EdgeRef& edge) {
      const Artifacts& all = edge.node == loop_input ? from_outside : made[edge.node];
      const auto found = all.find(edge.port);
      return found == all.end() ? nullptr : found->second;
    };
    for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
      const DagNode& node = dag.nodes[i];
      Artifacts inputs;
      for (const auto& [port, edge] : node.inputs) {
        if (ArtifactPtr input = artifact(edge)) inputs[port] = std::move(input);
      }
      const Loop* const loop = node.kind.loop();
      made[i] = loop != nullptr ? repeat(*loop, inputs) : examine(node, inputs);
      if (HasFatalFailure()) return {};
    }
    Artifacts outputs;
    for (const DagOutput& output : dag.outputs) outputs[output.name] = artifact(output.from);
    return outputs;
  }

  /// The node, its parameters and what it takes.
  static std::string key(const DagNode& node, const Artifacts& inputs) {
    std::string key = node.kind.type();
    for (const auto& [name, value] : node.params) key += ' ' + name + '=' + value.dump();
    for (const auto& [port, input] : inputs) key += ' ' + port + '=' + input->digest().hex();
    return key;
  }

  Artifacts examine(const DagNode& node, const Artifacts& inputs) {
    // Graphs have beginnings in common. Large results are not kept.
    if (large()) return execute(node, inputs);
    const std::string same = key(node, inputs);
    if (const auto found = made_.find(same); found != made_.end()) return found->second;
    return made_[same] = execute(node, inputs);
  }

  Artifacts execute(const DagNode& node, const Artifacts& inputs) {
    Execution whole(node, inputs);
    if (whole.status != BF_OK) throw std::runtime_error(node.path + ": " + whole.cause);
    EXPECT_LE(whole.longest, limit_) << node.path << " (" << node.kind.type()
                                     << ") does not look for so long after " << whole.longest_after << " of "
                                     << whole.looks << " looks";
    double& longest = longest_[node.kind.type()];
    longest = std::max(longest, whole.longest);
    ways_.insert(way(node));
    if (seen_.insert(node.kind.type()).second) {
      for (const double moment : {0.02, 0.3, 0.6, 0.95}) {
        const auto at = static_cast<std::int64_t>(moment * static_cast<double>(whole.looks)) + 1;
        if (at > whole.looks) continue;
        const Execution cut(node, inputs, at);
        // Its last looks may come when nothing is left to be done.
        EXPECT_TRUE(cut.status == BF_CANCELLED || moment > 0.9) << node.path << " at look " << at;
        EXPECT_LE(cut.latency, limit_)
            << node.path << " (" << node.kind.type() << ") at look " << at << " of " << whole.looks;
        longest = std::max(longest, cut.latency);
      }
    }
    return std::move(whole.outputs);
  }

  /// False when every node of `dag` was examined with the same choices.
  bool has_something_new(const Dag& dag) const {
    return std::any_of(dag.nodes.begin(), dag.nodes.end(), [this](const DagNode& node) {
      const Loop* const loop = node.kind.loop();
      return loop != nullptr ? has_something_new(loop->body) : ways_.count(way(node)) == 0;
    });
  }
  /// The type of a node and its choices.
  static std::string way(const DagNode& node) {
    std::string way = node.kind.type();
    for (const auto& [name, value] : node.params) {
      if (value.is_string()) way += ' ' + name + '=' + value.get<std::string>();
    }
    return way;
  }

  double limit_ = limit();
  std::set<std::string> seen_, ways_;
  std::map<std::string, Artifacts> made_;  // by key()
  std::map<std::string, double> longest_;  // seconds, by node id
};

/// Whether BALLFLOW_TEST_GRAPH lets this graph, with this strategy, run.
bool is_wanted(const std::filesystem::path& graph, const std::string& strategy) {
  const char* const variable = std::getenv("BALLFLOW_TEST_GRAPH");
  if (variable == nullptr) return true;
  const std::string wanted = variable, name = graph.stem().string();
  return wanted == name || wanted == name + ":" + strategy;
}

TEST_F(Cancellation, every_node_ends_soon_after_it_was_cancelled_at_any_moment) {
  const auto model = [](const std::filesystem::path& file) {
    // The polar balls of a torus all touch each other, which meshes take for what they refuse at length.
    const std::string shape = file.stem() == "ball_mesh" ? "knot" : "torus";
    return "shape:" + shape + "?n=" + std::to_string(is_dear(file.stem()) ? samples() / 5 : samples());
  };
  std::vector<std::pair<std::string, std::vector<Setting>>> runs;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_file("graphs"))) {
    if (entry.path().extension() != ".json") continue;
    const std::string file = entry.path().string();
    // What takes an artifact has no default; shape_complete has the nodes of those that there are.
    if (test::read_file(file).find("\"kind\": \"artifact\"") != std::string::npos) continue;
    const Dag dag = load_graph(file, registry());
    std::vector<Setting> settings;
    if (entry.path().stem() == "shape_complete") {
      settings.push_back({"extent", "whole"});  // where a part may lie takes long to find
    } else if (entry.path().stem().string().ends_with("ellipsoids") && !large()) {
      // Samples follow from the tolerance, not from how many were asked for.
      settings = {{"input", "shape:torus?n=400"}, {"delta", "4"}, {"epsilon", "2"}, {"spacing", "5"}};
      std::erase_if(settings, [&](const Setting& s) { return dag.params.count(s.name) == 0; });
    } else if (dag.params.count("input") != 0) {
      settings.push_back({"input", model(file)});
    }
    // Fits with many balls take longest, and differ from these in their number alone.
    if (entry.path().stem() == "robot_spheres") settings.push_back({"curves.fits", "2,4"});
    // As many balls as samples were asked for; how samples are chosen follows below.
    if (dag.params.count("sampling") != 0) settings.push_back({"sampling", "vertices"});
    // Ellipsoids have a growth of another kind.
    if (dag.params.count("growth") != 0 && dag.params.at("growth") == "power_diagram")
      settings.push_back({"growth", "additive"});
    // A number of balls is not reached by every strategy; none keeps all of them.
    if (dag.params.count("strategy") == 0 ||
        dag.params.count("balls") + dag.params.count("ellipsoids") != 0) {
      if (is_wanted(entry.path(), "")) runs.emplace_back(file, settings);
      continue;
    }
    for (const auto& strategy : std::filesystem::directory_iterator(test::source_file("graphs/strategies"))) {
      if (strategy.path().extension() != ".json") continue;
      if (!is_wanted(entry.path(), strategy.path().stem().string())) continue;
      runs.emplace_back(file, settings);
      runs.back().second.push_back({"strategy", strategy.path().stem().string()});
    }
  }
  if (const std::string file = test::source_file("graphs/ball_mesh.json"); is_wanted(file, ""))
    runs.push_back({file, {{"input", model(file)}, {"sampling", "vertices"}, {"method", "grid"}}});
  for (const char* sampling : {"auto", "wrap"}) {
    const std::string file = test::source_file("graphs/dmt.json");
    if (is_wanted(file, ""))
      runs.push_back({file, {{"input", model(file)}, {"delta", "0.3"}, {"sampling", sampling}}});
  }
  for (const char* mode : {"inner", "outer"}) {
    const std::string file = test::source_file("graphs/offset.json");
    if (is_wanted(file, ""))
      runs.push_back({file, {{"input", model(file)}, {"sampling", "vertices"}, {"mode", mode}}});
  }
  // First those that keep all balls, so that nodes after the pruning meet many.
  const auto prunes = [](const auto& run) {
    return !run.second.empty() && run.second.back().value != "none";
  };
  std::sort(runs.begin(), runs.end(), [&](const auto& a, const auto& b) {
    return std::pair(prunes(a), a.first) < std::pair(prunes(b), b.first);
  });
  for (const auto& [file, settings] : runs) {
    SCOPED_TRACE(file + (settings.empty() ? "" : " " + settings.back().value));
    const Dag dag = load_graph(file, registry(), settings);
    if (!has_something_new(dag)) continue;
    // Not a fifth: what a graph makes follows from its tolerances, too.
    limit_ = is_dear(std::filesystem::path(file).stem()) ? limit() / 2 : limit();
    examine(dag, {});
    if (HasFatalFailure()) return;
  }
  ASSERT_FALSE(runs.empty()) << "BALLFLOW_TEST_GRAPH names no graph";
  if (std::getenv("BALLFLOW_TEST_GRAPH") == nullptr) {
    for (const auto& [id, node] : registry().nodes()) EXPECT_EQ(seen_.count(id), 1u) << id << " did not run";
  }
  for (const auto& [id, seconds] : longest_) std::printf("%-16s %6.3f s\n", id.c_str(), seconds);
}

TEST_F(Cancellation, reading_a_large_file_ends_soon) {
  const test::TempFolder folder;
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(4 * samples())));
  std::string points, corners;
  for (std::size_t i = 0; i < side * side; ++i) {
    const std::size_t x = i % side, y = i / side;
    const std::string line =
        std::to_string(x) + ".25 " + std::to_string(y) + ".5 " + std::to_string((x * y) % 7) + "\n";
    points += line;
    corners += "v " + line;
  }
  std::string faces, numbered;
  for (std::size_t y = 0; y + 1 < side; ++y) {
    for (std::size_t x = 0; x + 1 < side; ++x) {
      const std::size_t a = y * side + x;
      faces += "3 " + std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' + std::to_string(a + side) + '\n';
      numbered += "f " + std::to_string(a + 1) + ' ' + std::to_string(a + 2) + ' ' +
                  std::to_string(a + side + 1) + '\n';
    }
  }
  const std::string vertices = std::to_string(side * side),
                    triangle_count = std::to_string((side - 1) * (side - 1));
  test::write_file(folder.file("a.xyz"), points);
  test::write_file(folder.file("a.obj"), corners + numbered);
  test::write_file(folder.file("a.off"), "OFF\n" + vertices + ' ' + triangle_count + " 0\n" + points + faces);
  test::write_file(folder.file("a.ply"),
                   "ply\nformat ascii 1.0\nelement vertex " + vertices +
                       "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                       triangle_count + "\nproperty list uchar int vertex_indices\nend_header\n" + points +
                       faces);
  std::string balls, triangles;
  for (std::size_t i = 0; i < side * side; ++i) {
    balls += "v " + std::to_string(i % side) + ".25 " + std::to_string(i / side) + ".5 0 1\n";
  }
  for (std::size_t a = 0; a + side < side * side; ++a) {
    triangles +=
        "f " + std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' + std::to_string(a + side) + '\n';
  }
  const std::string all_triangles = std::to_string(side * side - side);
  test::write_file(folder.file("a.ma"), vertices + " 0 " + all_triangles + '\n' + balls + triangles);
  struct File {
    const char *name, *node, *output;
  };
  for (const auto& [name, node, output] :
       {File{"a.xyz", "Sample", "points"}, File{"a.obj", "Sample", "points"},
        File{"a.off", "Sample", "points"}, File{"a.ply", "Sample", "points"},
        File{"a.ma", "LoadBalls", "axis"}}) {
    SCOPED_TRACE(name);
    seen_.clear();
    const Json graph = {{"doc", "Reads."},
                        {"nodes", {{"read", {{"type", node}, {"params", {{"file", folder.file(name)}}}}}}},
                        {"outputs", {{"out", std::string("read.") + output}}}};
    const Dag dag = parse_graph(graph.dump(), "read.json", registry());
    examine(dag, {});
    std::printf("%-16s %6.3f s\n", name, longest_[node]);
    longest_.clear();
  }
}

}  // namespace
}  // namespace ballflow

// One HTML file that shows runs, graphs and artifacts, and loads nothing from elsewhere. The program in it is
// tools/viewer, bundled into a template; this writes the data into it.
//
//   <script type="application/json" id="ballflow-scene">   graphs, variants, layers; arrays by number of
//   block <script type="text/plain" id="block-0">                arrays (blocks.hpp)
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/history.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/run.hpp"
#include "show/page/blocks.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

constexpr std::uint64_t default_page_bytes = 64'000'000;

/// What the page takes from its surroundings.
struct PageSources {
  /// The artifact of a digest, null when it is not in the cache.
  std::function<ArtifactPtr(const Digest&)> load;
  /// An output in words: "942 balls".
  std::function<std::string(const OutputEntry&)> describe;
  /// Called before each artifact that is packed: how many are done, of how many, bytes so far.
  std::function<void(std::size_t, std::size_t, std::uint64_t)> progress = [](auto...) {};
};

class Page {
 public:
  Page(const Registry& registry, std::uint64_t max_bytes) : registry_(registry), max_bytes_(max_bytes) {}

  /// A run: its graph; its variants, one when it is no sweep; its artifacts.
  void add_run(const RunRecord& run);
  /// A graph that has not run; `plans` as Dag::nodes, or empty.
  void add_graph(const Dag& dag, const std::vector<NodePlan>& plans);
  /// An artifact that belongs to no run here.
  void add_artifact(const std::string& name, ArtifactPtr artifact);

  /// Packs artifacts as long as the page stays within its size: those given by add_artifact first, then
  /// outputs of graphs, then what nodes in between made, small ones first.
  void pack(const PageSources& sources);

  /// Artifacts that are missing, with the reason: "enlarge.balls: not in the cache any more".
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// Layers that the page can show.
  std::size_t layers() const { return layers_; }

  /// The page. `page_template` has the line <!-- ballflow data -->. Throws Error (code usage) when what is
  /// known of the nodes alone is larger than the page may be.
  std::string html(const std::string& page_template, const std::string& version) const;

 private:
  struct Wanted {
    std::string name, type;
    std::uint64_t bytes = 0;
    int rank = 0;  // 0: given, 1: output of a graph, 2: of a node in between
    nlohmann::json summary;
    ArtifactPtr artifact;  // of those that were given
  };
  void want(const std::string& digest, Wanted wanted);
  void document(const std::string& type);
  Json packed(const std::string& digest, const Wanted& wanted, const PageSources& sources);

  const Registry& registry_;
  std::uint64_t max_bytes_;
  Json graphs_ = Json::array(), variants_ = Json::array(), loose_ = Json::array();
  Json types_ = Json::object(), artifacts_ = Json::object();
  Json chains_ = Json::array();
  std::map<std::string, Wanted> wanted_;  // by digest
  Blocks blocks_;
  std::vector<std::string> left_out_;
  std::size_t layers_ = 0;
};

}  // namespace ballflow::show

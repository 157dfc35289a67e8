// Values that parameters get from outside: by --set, by an axis of a sweep.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "document/graph_file.hpp"

namespace ballflow {

/// A setting, and where it was written.
struct PlacedSetting {
  std::string name;                 // as in Setting
  std::string text;                 // from the command line
  std::optional<Json> value;        // from the graph file; `text` is not looked at then
  std::string origin;               // for messages: "--set epsilon=0.5"
  const GraphFile* file = nullptr;  // where it was written, instead of `origin`
  Offset offset = 0, name_offset = 0;
};

/// "epsilon" -> ".epsilon", "prune.greedy.mode" -> "prune/greedy.mode": equal names are the same parameter.
std::string setting_target(const std::string& name);

Diagnostic about_setting(const PlacedSetting& setting, std::string message, std::string hint);

/// Settings by the parameter that they name, with a note which of them found it.
class Settings {
 public:
  explicit Settings(const std::vector<const PlacedSetting*>& settings);

  /// The setting of a parameter of the node or subgraph `path` (empty: of the top graph), else null. Of
  /// several the last counts; one of all copies of a map ("links/enclose") less than one of this copy
  /// ("links[hand]/enclose").
  const PlacedSetting* find(const std::string& path, const std::string& param);

  /// Those that no parameter was looked up for.
  std::vector<const PlacedSetting*> unused() const;

 private:
  const std::vector<const PlacedSetting*>& all_;
  std::map<std::string, std::vector<std::size_t>> by_name_;
  std::vector<bool> used_;
};

}  // namespace ballflow

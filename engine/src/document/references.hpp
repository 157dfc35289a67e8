// References followed through the interfaces of subgraphs, to what gives the value.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "document/expand.hpp"

namespace ballflow {

/// What a reference leads to: an output port, an input of the loop around it, an artifact from outside, an
/// input that is not connected, an output of all copies of a map, or something reported.
struct Target {
  enum class Kind { broken, unconnected, leaf, from_loop, given, list };
  Kind kind = Kind::broken;
  std::size_t leaf = 0;  // of a list the map
  std::string port;
};

/// One of what a reference leads to, and the entries of the maps that it came through: "hand", "left/hand".
struct ListedTarget {
  std::string entry;  // empty where there is no map
  Target target;
};

class References {
 public:
  /// `given` are the artifacts for the inputs of the top graph.
  References(const Expansion& expansion, const std::map<std::string, ArtifactPtr>& given, Findings& findings);

  /// Follows a reference through subgraph outputs (down) and inputs (up) to the port that produces it.
  Target resolve(std::size_t scope, const Reference& reference);

  /// The same with lists taken apart, in order. A list that passed an input of a subgraph, which takes one
  /// artifact, is broken.
  std::vector<ListedTarget> resolve_all(std::size_t scope, const Reference& reference);

  /// Also outputs that nobody reads: a subgraph that only passes values around may run in a circle, which is
  /// reported.
  void resolve_outputs(std::size_t scope);

 private:
  struct Memo {
    enum class State { fresh, visiting, done };
    State state = State::fresh;
    Target target;
  };

  Target resolve_output(std::size_t scope, std::size_t output);
  void take_apart(const Target& target, const std::string& entry, std::vector<ListedTarget>& all);

  const Expansion& expansion_;
  const std::map<std::string, ArtifactPtr>& given_;
  Findings& findings_;
  std::vector<std::vector<Memo>> resolved_;  // by scope and output
};

}  // namespace ballflow

// How the graphs in graphs/ are run where every one of them is: on small models, with results that tests
// share.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "ballflow/run.hpp"
#include "built_registry.hpp"
#include "test_data.hpp"

namespace ballflow {

inline std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_file(folder))) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Of the node libraries and of this program: what other builds made does not count.
inline std::string build_mark() {
  std::string files = "/proc/self/exe";
  for (const PluginCandidate& library : registry().candidates()) files += '\n' + library.path;
  std::string states;
  std::istringstream lines(files);
  for (std::string file; std::getline(lines, file);) {
    states += file + ' ' + std::to_string(std::filesystem::file_size(file)) + ' ' +
              std::to_string(std::filesystem::last_write_time(file).time_since_epoch().count()) + '\n';
  }
  return sha256(states).hex().substr(0, 16);
}

/// A store for each number of threads, which the tests of all graphs share: what graphs have in common is
/// computed once with each of these numbers, by one test or another, and compared wherever it is looked at.
inline std::shared_ptr<Store> results_with(unsigned threads) {
  static const std::string root = test::binary_file("tests/contract/results/" + build_mark());
  std::filesystem::create_directories(root);
  return Store::open({root + "/" + std::to_string(threads), false, {}});
}

/// What makes a graph of graphs/ quick; `given` as for load_graph.
inline std::vector<Setting> quick_settings(const std::string& graph,
                                           const std::map<std::string, ArtifactPtr>& given = {}) {
  if (graph == "shape_prior") return {{"points", "1000"}, {"samples", "300"}};
  // A part can lie in many ways on the whole, which takes long.
  if (graph == "shape_fit" || graph == "shape_complete") {
    std::vector<Setting> settings{
        {"input", "shape:bumpBox?n=1500&r=0.65"}, {"extent", "whole"}, {"samples", "300"}};
    if (graph == "shape_complete") settings.push_back({"model.points", "1000"});
    return settings;
  }
  std::vector<Setting> settings;
  const std::string file = test::source_file("graphs/" + graph + ".json");
  if (load_graph(file, registry(), {}, {}, given).params.count("input") != 0)
    settings.push_back({"input", "shape:torus?n=4000"});
  // Fits with many balls take longest, and differ from these in their number alone.
  if (graph == "robot_spheres") settings.push_back({"curves.fits", "2,4"});
  // Comparing takes most of the time, and looks at as many things with fewer samples.
  if (graph == "ellipsoids" || graph == "k_ellipsoids")
    settings.insert(settings.end(), {{"spacing", "5"}, {"delta", "2"}});
  if (graph == "ellipsoids") settings.push_back({"epsilon", "2"});
  return settings;
}

}  // namespace ballflow

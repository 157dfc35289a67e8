// The folder of --out: one file per output of the graph, and a record of what they were made from, so that
// a rerun that computes nothing also writes nothing.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ballflow/run.hpp"

namespace ballflow::cli {

struct WrittenFile {
  std::string output;  // name of the graph's output
  std::string path;
  std::string what;      // in words
  bool written = false;  // false: it was there already
};

/// Brings `folder` up to date with the outputs of a finished run. `formats` overrides the usual format of an
/// output by its name ("balls" -> "csv"). `load` is called only for files that are not current. Throws Error.
std::vector<WrittenFile> write_outputs(const std::string& folder, const Dag& dag, const RunResult& result,
                                       const std::map<std::string, std::string>& formats,
                                       const std::function<ArtifactPtr(const EdgeRef&)>& load);

}  // namespace ballflow::cli

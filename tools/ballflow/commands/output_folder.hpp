// The folder of --out: one file per output of the graph, and a record of what they were made from, so that
// a rerun that computes nothing also writes nothing.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/run.hpp"
#include "commands/places.hpp"

namespace ballflow::cli {

struct WrittenFile {
  std::string output;  // name of the graph's output
  std::string path;
  std::string what;      // in words
  bool written = false;  // false: it was there already
};

struct WrittenOutputs {
  std::vector<WrittenFile> files;
  std::optional<Error> failure;  // the first; the other outputs are written nevertheless
};

/// Tells `places` what write_outputs() would write: also the outputs of nodes that may not run.
void claim_outputs(Places& places, const std::string& folder, const Dag& dag,
                   const std::map<std::string, std::string>& formats);

/// Creates the folder. Throws Error when that is not possible or nothing can be written in it: to be called
/// before anything is computed.
void prepare_folder(const std::string& folder);

/// Brings `folder` up to date with the outputs of a finished run. `formats` overrides the usual format of an
/// output by its name ("balls" -> "csv"). `load` is called only for files that are not current.
WrittenOutputs write_outputs(const std::string& folder, const Dag& dag, const RunResult& result,
                             const std::map<std::string, std::string>& formats,
                             const std::function<ArtifactPtr(const EdgeRef&)>& load);

}  // namespace ballflow::cli

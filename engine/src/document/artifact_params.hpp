// The artifacts that the parameters of kind artifact of a graph stand for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "document/findings.hpp"
#include "document/setting.hpp"

namespace ballflow {

/// The artifacts for the inputs of the top graph: `given`, and those that its parameters of kind artifact
/// name in settings or by default. `find` is asked once per name; what it found is in `found`. Each is
/// checked against its type.
std::map<std::string, ArtifactPtr> find_given(const GraphFile& top, const Registry& registry,
                                              const std::vector<const PlacedSetting*>& settings,
                                              const std::map<std::string, ArtifactPtr>& given,
                                              const FindArtifact& find,
                                              std::map<std::string, ArtifactPtr>& found, Findings& findings);

}  // namespace ballflow

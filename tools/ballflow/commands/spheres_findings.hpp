// What a run about spheres found, for its pages: graphs/check_spheres.json, robot_spheres.json,
// enclosure.json.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/run.hpp"
#include "base/monitor.hpp"
#include "report/spheres_page.hpp"

namespace ballflow::cli {

using LoadArtifact = std::function<ArtifactPtr(const EdgeRef&)>;

/// What is proven and measured of each link.
std::vector<report::LinkCheck> link_checks(const Dag& dag, const RunResult& result,
                                           const std::vector<std::string>& links, const LoadArtifact& load);

/// What was tried for each link, before spheres were handed out to them.
std::vector<report::LinkCurve> link_curves(const Dag& dag, const RunResult& result,
                                           const std::vector<std::string>& links);

/// The links with their spheres, from so many sides, one or two. Where spheres are checked, what they leave
/// out is red. None where no link has a surface.
std::vector<report::Picture> link_pictures(const Dag& dag, const report::SpheresCheck& check,
                                           const LoadArtifact& load, std::size_t sides,
                                           geometry::Monitor& monitor);

}  // namespace ballflow::cli

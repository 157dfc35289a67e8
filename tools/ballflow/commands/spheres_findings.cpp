#include "commands/spheres_findings.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "show/outside.hpp"
#include "show/picture/picture.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"

namespace ballflow::cli {
namespace {

/// The number of a field of a summary, or `none`.
double field(const OutputEntry& entry, const char* name, double none) {
  const Json summary = Json::parse(entry.summary, nullptr, false);
  const auto found = summary.is_object() ? summary.find(name) : summary.end();
  return summary.is_object() && found != summary.end() && found->is_number() ? found->get<double>() : none;
}

double sum_of_volumes(const geometry::Balls& balls) {
  double sum = 0;
  for (const double r : balls.radii) sum += 4.0 / 3 * 3.14159265358979323846 * r * r * r;
  return sum;
}

std::optional<EdgeRef> output_named(const Dag& dag, const std::string& name) {
  for (const DagOutput& output : dag.outputs) {
    if (output.name == name) return output.from;
  }
  return std::nullopt;
}

/// The robot that was read, or the mesh.
std::optional<EdgeRef> surface_of(const Dag& dag) {
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (dag.nodes[i].path == "robot") return EdgeRef{i, "robot"};
  }
  return output_named(dag, "mesh");
}

/// Leaves out the triangles of links that are not in question.
void keep_links(show::Layer& surface, const std::vector<report::LinkCheck>& links) {
  const show::Attribute* const link = surface.find("link");
  if (link == nullptr) return;
  std::set<std::string> names;
  for (const report::LinkCheck& check : links) names.insert(check.link);
  std::erase_if(surface.triangles, [&](const auto& triangle) {
    return !names.contains(link->categories[static_cast<std::size_t>(link->values[triangle[0]])]);
  });
}

/// Points of voids, which lie inside of the links, and of surfaces.
show::Layer open_points(const report::SpheresCheck& check, const std::vector<show::Layer>& spheres) {
  if (spheres.size() > 1) return spheres[1];  // of a robot, where its links are
  show::Layer layer;
  layer.name = "not covered";
  std::vector<geometry::Vec3> points;
  for (const report::LinkCheck& link : check.links) {
    const geometry::Enclosure& e = link.enclosure;
    points.insert(points.end(), e.open_points.begin(), e.open_points.end());
    points.insert(points.end(), e.void_points.begin(), e.void_points.end());
  }
  layer.vertices = std::move(points);
  return layer;
}

/// What is seen: where everything is in spheres these are coloured by link, else what they leave out is red.
std::vector<show::Layer> scene_of(const report::SpheresCheck& check, show::Layer surface,
                                  const std::vector<show::Layer>& spheres) {
  show::Layer balls = spheres.front();
  surface.name = "mesh";
  surface.colour_by.clear();
  surface.opacity = 1;
  if (!check.enclosing) {
    surface.opacity = 0.3;
    balls.opacity = 1;
    return {std::move(surface), std::move(balls)};
  }
  balls.opacity = 0.35;
  if (report::all_enclosed(check)) return {std::move(surface), std::move(balls)};
  balls.colour_by.clear();
  balls.opacity = 0.25;
  const double edge = geometry::bounding_box(surface.vertices.span()).longest_edge();
  show::SplitSurface parts = show::split_by_balls(surface, balls, 0.0025 * edge);
  if (!parts.outside.triangles.empty())
    return {std::move(parts.inside), std::move(parts.outside), std::move(balls)};
  surface.opacity = 0.3;
  return {std::move(surface), open_points(check, spheres), std::move(balls)};
}

}  // namespace

std::vector<report::LinkCheck> link_checks(const Dag& dag, const RunResult& result,
                                           const std::vector<std::string>& links, const LoadArtifact& load) {
  std::vector<report::LinkCheck> checks(links.size());
  std::size_t proven = 0, measured = 0, weighed = 0;
  for (const DagOutput& output : dag.outputs) {
    for (const OutputEntry& entry : result.nodes[output.from.node].outputs) {
      if (entry.port != output.from.port) continue;
      const std::string name = output.base_name();
      if (name == "enclosure" && proven < links.size()) {
        const ArtifactPtr artifact = load(output.from);
        checks[proven].link = links[proven];
        checks[proven++].enclosure = typed<geometry::Enclosure>(*artifact);
      } else if (name == "measure" && measured < links.size()) {
        checks[measured].volume = field(entry, "volume", 0);
        checks[measured++].solid_volume = field(entry, "solid_volume", 0);
      } else if (name == "balls" && weighed < links.size()) {
        const ArtifactPtr artifact = load(output.from);
        checks[weighed++].ball_volume = sum_of_volumes(typed<geometry::Balls>(*artifact));
      }
    }
  }
  checks.resize(proven);
  return checks;
}

std::vector<report::LinkCurve> link_curves(const Dag& dag, const RunResult& result,
                                           const std::vector<std::string>& links) {
  std::vector<report::LinkCurve> curves;
  for (const std::string& link : links) {
    const std::string beginning = "curves[" + link + "]/";
    report::LinkCurve curve{link, {}};
    for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
      if (!dag.nodes[i].path.starts_with(beginning)) continue;
      for (const OutputEntry& entry : result.nodes[i].outputs) {
        if (entry.type != "EnclosureFit") continue;
        curve.points.emplace_back(field(entry, "balls", 0),
                                  field(entry, "loss_share", std::numeric_limits<double>::quiet_NaN()));
      }
    }
    std::sort(curve.points.begin(), curve.points.end());
    if (!curve.points.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<report::Picture> link_pictures(const Dag& dag, const report::SpheresCheck& check,
                                           const LoadArtifact& load, std::size_t sides,
                                           geometry::Monitor& monitor) {
  const std::optional<EdgeRef> surface_edge = surface_of(dag);
  std::optional<EdgeRef> balls_edge = output_named(dag, "spheres");
  if (!balls_edge) balls_edge = output_named(dag, "balls");
  if (!surface_edge || !balls_edge) return {};
  const ArtifactPtr surface = load(*surface_edge), balls = load(*balls_edge);
  std::vector<show::Layer> surfaces = show::layers_of(*surface), spheres = show::layers_of(*balls);
  if (surfaces.empty()) return {};
  if (spheres.empty() || spheres.front().shape != show::Shape::balls)
    spheres.insert(spheres.begin(), show::Layer{});
  spheres.front().shape = show::Shape::balls;
  keep_links(surfaces.front(), check.links);
  const std::vector<show::Layer> scene = scene_of(check, std::move(surfaces.front()), spheres);
  const char* const what = check.enclosing && !report::all_enclosed(check)
                               ? "What the spheres of a link leave out of it is red"
                               : "Links and spheres";
  std::vector<report::Picture> pictures;
  for (const auto& [side, azimuth] : {std::pair("", 30.0), std::pair(", from the other side", 210.0)}) {
    if (pictures.size() == sides) break;
    show::PictureOptions options;
    options.width = 1100, options.height = 680;
    options.up = show::Upward::z;
    options.from = {azimuth, 20};
    pictures.push_back({std::string(what) + side, show::png(show::draw(scene, options, monitor))});
  }
  return pictures;
}

}  // namespace ballflow::cli

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

std::string number(const Json& summary, const char* field) {
  if (!summary.contains(field) || !summary.at(field).is_number()) return "?";
  return grouped(summary.at(field).get<std::int64_t>());
}

/// "1 ball", "35 676 balls".
std::string counted(const Json& summary, const char* field, const std::string& thing) {
  const std::string count = number(summary, field);
  return count + " " + thing + (count == "1" ? "" : "s");
}

std::string percent(double fraction) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f %%", 100 * fraction);
  return text;
}

std::string rounded(const Json& summary, const char* field) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", summary.at(field).get<double>());
  return text;
}

std::string robot(const Json& s) {
  std::string text = "robot ";
  text.append(s.at("name").get<std::string>()).append(": ").append(counted(s, "links", "link"));
  text.append(", ").append(number(s, "links_with_surface")).append(" with a surface, ");
  text.append(counted(s, "moving_joints", "moving joint"))
      .append(", ")
      .append(counted(s, "triangles", "triangle"));
  return text;
}

std::string robot_spheres(const Json& s) {
  std::string text = counted(s, "balls", "ball");
  text.append(" for ").append(counted(s, "links_with_balls", "link")).append(" of ");
  text.append(s.at("name").get<std::string>());
  if (s.at("poses") == 0) return text;
  text.append("; ").append(counted(s, "untested_pairs", "pair")).append(" of links need no test, by ");
  return text.append(counted(s, "poses", "pose"));
}

std::string shape_pose(const Json& s) {
  std::string text =
      s.at("degrees").is_number() ? "turned by " + rounded(s, "degrees") + " degrees" : "mirrored";
  if (s.at("scale") != 1) text += ", scaled by " + rounded(s, "scale");
  text += ", " + percent(s.at("relative_residual").get<double>()) + " of the diagonal apart";
  if (s.at("second_best").is_number())
    text += "; another pose is " + rounded(s, "second_best") + " times as far";
  return text;
}

std::string matched_balls(const Json& s) {
  std::string text = counted(s, "balls", "ball") + ", " + number(s, "points") + " points";
  if (s.at("without_partner") != 0) text += ", " + number(s, "without_partner") + " without partner";
  if (s.at("shared") != 0) text += ", " + number(s, "shared") + " share theirs";
  const double diagonal = s.at("diagonal").get<double>();
  if (s.at("surface_residual").is_number() && diagonal > 0)
    text += "; points " + percent(s.at("surface_residual").get<double>() / diagonal) +
            " of the diagonal off the surface";
  return text;
}

/// Chosen are balls or ellipsoids: the cover does not know. (Left out are balls alone, by CoverMatrix.)
std::string cover(const Json& s) {
  if (s.contains("remaining") && s.at("remaining") == 0) {
    std::string text = number(s, "chosen") + " chosen";
    if (s.at("lower_bound") == s.at("chosen")) return text + ", the fewest possible";
    // The bound is one for covering: it knows nothing of balls that the topology asked for.
    const std::int64_t returned = s.value("returned", std::int64_t{0});
    if (returned > 0) text += " (" + grouped(returned) + " of them for the topology)";
    if (!s.at("lower_bound").is_number()) return text;
    text += ", at least " + number(s, "lower_bound") + (returned > 0 ? " needed to cover" : " needed");
    if (s.at("gap").is_number()) text += ", gap " + percent(s.at("gap").get<double>());
    if (s.at("gap").is_number() && returned > 0) {
      const double bound = s.at("lower_bound").get<double>(), chosen = s.at("chosen").get<double>();
      text += ", " + percent((chosen - static_cast<double>(returned) - bound) / bound) + " without those";
    }
    return text;
  }
  std::string text = number(s, "rows") + " x " + number(s, "cols") + ", " + number(s, "nnz") + " entries";
  if (s.value("left_out", std::int64_t{0}) > 0) text += ", " + number(s, "left_out") + " balls left out";
  if (s.contains("chosen") && s.at("chosen") != 0) text += ", " + number(s, "chosen") + " chosen";
  return text;
}

std::string mesh(const Json& s) {
  std::string text = counted(s, "faces", "triangle") + ", ";
  if (s.value("faces", 0) == 0) return "no triangles";
  text += s.value("closed", false) ? "closed" : "open";
  if (!s.value("manifold", true)) text += ", not manifold";
  if (s.contains("genus") && s.at("genus").is_number()) text += ", genus " + number(s, "genus");
  if (s.contains("frame")) text += "; x, y, z: " + s.at("frame").get<std::string>();
  if (s.contains("folded_triangles")) {  // an instance of a model
    if (s.at("folded_triangles") != 0) text += ", " + counted(s, "folded_triangles", "triangle") + " FOLDED";
    if (s.at("self_intersections") != 0) text += ", " + counted(s, "self_intersections", "self-intersection");
    text += ", " + rounded(s, "mean_distance_from_balls") + " from the balls";
  }
  return text;
}

std::string complex(const Json& s) {
  std::string text =
      number(s, "tetrahedra") + (s.value("tetrahedra", 0) == 1 ? " tetrahedron, " : " tetrahedra, ") +
      counted(s, "triangles", "triangle") + ", Euler characteristic " + number(s, "euler_characteristic");
  if (s.contains("betti") && s.at("betti").is_array() && s.at("betti").size() == 3) {
    text +=
        ", Betti " + s.at("betti")[0].dump() + " " + s.at("betti")[1].dump() + " " + s.at("betti")[2].dump();
  }
  return text;
}

std::string comparison(const Json& s) {
  std::string text = "Hausdorff distance " + rounded(s, "hausdorff") + " (at most " +
                     rounded(s, "hausdorff_at_most") + "), mean " + rounded(s, "chamfer");
  // A closed mesh is what everybody expects.
  const auto surface = s.at("compared_with").get<std::string>();
  if (surface != "a closed mesh") text += ", from " + surface;
  if (s.at("volume_error").is_number()) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%+.2f %%", 100 * s.at("volume_error").get<double>());
    text += ", volume " + std::string(percent);
  }
  return text;
}

std::string growth(const Json& s) {
  std::string text = number(s, "stopped") + " of " + counted(s, "balls", "ball") + " stopped";
  if (s.at("betti_after").is_array() && s.at("betti_after") == s.at("betti_before"))
    text += ", Betti numbers kept";
  return text;
}

std::string minkowski(const Json& s) {
  std::string text = number(s, "pairs") + " pairs, " + number(s, "contributing") + " contribute, ";
  if (s.at("minimal").is_number()) text += number(s, "minimal") + " are needed, ";
  text += number(s, "touching_boundary") + " on the boundary";
  if (s.at("proven").is_string()) {
    const bool contains = s.at("proven").get<std::string>().starts_with("contains");
    text += contains ? ", contains A + B: proven" : ", inside A + B: proven";
    const char* other = contains ? "excess_bound" : "error_bound";
    if (s.at(other).is_number())
      text += (contains ? ", beyond it by at most " : ", error at most ") + rounded(s, other);
  } else if (s.at("error_bound").is_number()) {
    text += ", error at most " + rounded(s, "error_bound");
    if (s.at("excess_bound").is_number()) text += ", beyond A + B by at most " + rounded(s, "excess_bound");
  } else if (s.at("error_bound_unknown").is_string()) {
    text += ", error unknown: " + s.at("error_bound_unknown").get<std::string>();
  }
  return text;
}

std::string mesh_report(const Json& s) {
  const bool skin = s.at("made_by") == "skin surface";
  std::string text = counted(s, "faces", "face") + ", " + s.at("made_by").get<std::string>() +
                     (skin ? ", off the union by " : ", error ") + rounded(s, "error") +
                     (skin ? "" : " (asked for " + rounded(s, "error_asked") + ")") +
                     ", Euler characteristic " + number(s, "euler");
  if (s.at("self_intersections").is_number() && s.at("self_intersections") != 0)
    text += ", " + counted(s, "self_intersections", "self-intersection");
  if (s.at("differs").is_string()) text += ", NOT as asked: " + s.at("differs").get<std::string>();
  return text;
}

std::string refinement(const Json& s) {
  if (!s.at("refined").get<bool>()) return "points as they came";
  const bool known = !s.at("wanted").is_null() || !s.at("cells").is_null();
  std::string text = s.at("reached").get<bool>() ? "topology reached"
                     : known                     ? "topology NOT reached"
                                                 : "topology of the solid not known";
  text += " in " + counted(s, "rounds", "round");
  if (s.at("limited") != 0) text += ", " + number(s, "limited") + " places too thin";
  if (s.at("uncovered") != 0) text += ", " + counted(s, "uncovered", "sample") + " without an inner ball";
  return text;
}

std::string surface(const Json& s) {
  std::string text = counted(s, "components", "component") + ", genus " + number(s, "genus");
  if (s.at("boundary_loops") != 0) text += ", " + counted(s, "boundary_loops", "boundary loop");
  if (s.at("filled") != 0)
    text += ", " + percent(s.at("filled_area").get<double>()) + " of the area closes gaps";
  if (s.at("wide_area") != 0 && s.at("boundary_loops") == 0)
    text += ", " + percent(s.at("wide_area").get<double>()) + " holes";
  if (s.at("overruled") != 0)
    text += ", " + percent(s.at("overruled").get<double>()) + " of the poles overruled";
  if (s.at("left_out") != 0) text += ", passes by " + counted(s, "left_out", "sample");
  if (s.at("specks") != 0) text += ", " + counted(s, "specks", "speck") + " left out";
  return text;
}

std::string shape_prior(const Json& s) {
  std::string text = counted(s, "instances", "instance") + " of " + counted(s, "balls", "ball") + ", " +
                     counted(s, "modes", "mode");
  const Json& parts = s.at("compactness");
  for (std::size_t i = 0; i < parts.size() && i < 3; ++i)
    text += (i == 0 ? ", of the variance in the first ones: " : ", ") + percent(parts[i].get<double>());
  const Json& unknown = s.at("generalization");
  if (unknown.size() < 2) return text;
  char words[96];
  std::snprintf(words, sizeof words, "; unknown instances %.4g away, from the mean %.4g",
                unknown.back().get<double>(), unknown.front().get<double>());
  return text + words;
}

std::string shape_fit(const Json& s) {
  std::string text = number(s, "observed") + " points or balls, " + rounded(s, "residual") + " away";
  if (s.at("expected").is_number()) text += " (unknown instances: " + rounded(s, "expected") + ")";
  text += ", " + percent(s.at("outliers").get<double>()) + " outliers, scores of size " +
          rounded(s, "mahalanobis");
  return text + (s.at("converged").get<bool>() ? "" : ", NOT at rest");
}

std::string axis(const Json& s) {
  return counted(s, "polygons", "polygon") + " in " + counted(s, "sheets", "sheet") + ", " +
         counted(s, "edges", "free edge") + ", Euler characteristic " + number(s, "euler_characteristic");
}

}  // namespace

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, " ");
  return value < 0 ? "-" + digits : digits;
}

std::string duration(double seconds) {
  char text[32];
  if (seconds < 10) {
    std::snprintf(text, sizeof text, "%.3f s", seconds);
  } else if (seconds < 120) {
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  } else {
    const auto whole = static_cast<long>(std::lround(seconds));
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  }
  return text;
}

std::string describe(const OutputEntry& output) {
  using Words = std::function<std::string(const Json&)>;
  static const std::map<std::string, Words> words = {
      {"PointSet",
       [](const Json& s) {
         std::string text = counted(s, "count", "point");
         if (s.contains("instance")) {  // of ChooseTemplate
           const std::string instance = number(s, "instance");
           text += " of the template, instance " + instance + " (template=" + instance +
                   " keeps it when shapes are added)";
         }
         return text;
       }},
      {"TriangleMesh", mesh},
      {"PoleSet",
       [](const Json& s) {
         const bool labelled = s.value("inner", 0) + s.value("outer", 0) != 0;
         return counted(s, "poles", "pole") +
                (labelled ? " (" + number(s, "inner") + " inner, " + number(s, "outer") + " outer)" : "");
       }},
      {"CoverState", cover},
      {"CoverCheck",
       [](const Json& s) { return number(s, "covered") + " of " + number(s, "samples") + " covered"; }},
      {"Comparison", comparison},
      {"Growth", growth},
      {"Bisection",
       [](const Json& s) {
         if (s.at("tried") == 0) return "growth " + rounded(s, "value") + ", as asked for";
         std::string text = "growth " + rounded(s, "value") + " after " + counted(s, "tried", "trial");
         if (s.contains("error") && s.at("error").is_number())
           text += ", error at most " + rounded(s, "error");
         return text;
       }},
      {"LocalFeatureSize",
       [](const Json& s) {
         std::string text = counted(s, "count", "sample") + ", nearest pole from " +
                            rounded(s, "min_pole_distance") + " to " + rounded(s, "max_pole_distance") +
                            " away";
         if (s.at("min_axis_by_pole").is_number()) {
           text += ", the axis " + rounded(s, "min_axis_by_pole") + " of that at least";
         }
         if (s.at("r_at_least").is_number()) {
           const bool open = !s.at("r_at_most").is_number();
           text += open ? "; no r-sample for r < 1" : "; an r-sample for r = " + rounded(s, "r_at_most");
         }
         return text;
       }},
      {"MinkowskiReport", minkowski},
      {"Polygon2",
       [](const Json& s) {
         std::string text = counted(s, "components", "polygon");
         if (s.at("holes") != 0) text += " with " + counted(s, "holes", "hole");
         return text + ", " + number(s, "vertices") + " vertices, area " + rounded(s, "area");
       }},
      {"OutlineComparison",
       [](const Json& s) {
         char text[96];
         const double larger = std::max(s.at("a_to_b")[1].get<double>(), s.at("b_to_a")[1].get<double>());
         std::snprintf(text, sizeof text, "boundaries at most %.4g apart", larger);
         std::string described = text;
         if (s.at("symmetric_difference").is_number())
           described += ", " + percent(s.at("symmetric_difference").get<double>()) + " of the area differs";
         return described;
       }},
      {"DiscOutline",
       [](const Json& s) {
         std::string text = counted(s, "arcs", "arc") + ", " + counted(s, "components", "component");
         if (s.at("holes") != 0) text += ", " + counted(s, "holes", "hole");
         return text + ", area " + rounded(s, "area");
       }},
      {"BallDistance",
       [](const Json& s) {
         std::string text = s.at("words").get<std::string>();
         if (s.at("pairs") != 0) {
           text += ", " + std::string(s.at("cut").get<bool>() ? "more than " : "") +
                   counted(s, "pairs", "pair") + " at most " + rounded(s, "threshold") + " apart";
         }
         if (s.at("solids_words").is_string()) text += "; " + s.at("solids_words").get<std::string>();
         return text;
       }},
      {"Ellipsoids",
       [](const Json& s) {
         std::string text = counted(s, "count", "ellipsoid");
         if (s.at("min_radius").is_number()) {
           text += ", half-axes " + rounded(s, "min_radius") + " to " + rounded(s, "max_radius");
         }
         return text;
       }},
      {"Scaling", [](const Json& s) { return s.at("words").get<std::string>(); }},
      {"Way", [](const Json& s) { return s.at("words").get<std::string>(); }},
      {"Path",
       [](const Json& s) {
         std::string text = counted(s, "points", "point") + ", " + rounded(s, "length") + " long";
         if (s.at("balls") != 0) {
           text += ", " + counted(s, "balls", "ball") +
                   (s.at("contains").get<bool>() ? " that contain it, by " : " in it, off by ") +
                   rounded(s, "error") + " at most";
         }
         return text;
       }},
      {"ShapePose", shape_pose},
      {"MatchedBalls", matched_balls},
      {"ShapePrior", shape_prior},
      {"ShapeFit", shape_fit},
      {"MeshReport", mesh_report},
      {"Robot", robot},
      {"RobotSpheres", robot_spheres},
      {"Enclosure",
       [](const Json& s) {
         const bool proven = s.at("encloses").get<bool>();
         if (!proven && !s.at("meant").get<bool>()) {
           return "no ball stands out by more than " + rounded(s, "protrusion") + "; " +
                  s.at("words").get<std::string>();
         }
         return (proven ? "" : "NOT enclosed: ") + s.at("words").get<std::string>() +
                (proven ? ": proven; they stand out by " : "; balls stand out by ") +
                rounded(s, "protrusion") + " at most";
       }},
      {"EnclosureFit", [](const Json& s) { return s.at("words").get<std::string>(); }},
      {"BallCounts",
       [](const Json& s) { return counted(s, "balls", "ball") + " for " + counted(s, "objects", "object"); }},
      {"MassProperties",
       [](const Json& s) {
         std::string text = "volume " + rounded(s, "volume");
         if (s.contains("volume_error") && s.at("volume_error").is_number()) {
           char error[48];
           std::snprintf(error, sizeof error, " (%+.2f %% of the solid's)",
                         100 * s.at("volume_error").get<double>());
           text += error;
         }
         return text + ", area " + rounded(s, "area");
       }},
      {"PowerDiagram",
       [](const Json& s) {
         return counted(s, "cells", "cell") + " of " + counted(s, "balls", "ball") + ", " +
                number(s, "cells_in_complex") + " in the complex, " + number(s, "hidden") + " balls hidden";
       }},
      {"Refinement", refinement},
      {"SurfaceReport", surface},
      {"SurfaceBallsReport",
       [](const Json& s) {
         return "rho " + rounded(s, "radius") + ", rho_bar " + rounded(s, "shrink") + ", " +
                s.at("regime").get<std::string>();
       }},
      {"NoiseReport",
       [](const Json& s) {
         std::string text = s.at("verdict").get<std::string>() + ", " +
                            percent(s.at("uncertain").get<double>()) + " of the poles uncertain";
         if (s.at("neighbors") != 0) text += ", denoised with " + number(s, "neighbors") + " neighbours";
         return text;
       }},
      {"SampleAssignment",
       [](const Json& s) {
         return counted(s, "samples", "sample") + " belong to " + number(s, "used") + ", at most " +
                number(s, "largest") + " to one";
       }},
      {"SimplicialComplex", complex},
      {"MedialAxis", axis},
      {"TopologyTable", [](const Json& s) { return s.at("words").get<std::string>(); }},
      {"TopologyCheck", [](const Json& s) { return s.at("words").get<std::string>(); }},
  };
  const Json summary = Json::parse(output.summary, nullptr, false);
  if (!summary.is_object()) return output.type;
  if (output.type == "Balls") {
    return counted(summary, "count", output.port == "balls" ? "ball" : output.port + " ball");
  }
  const auto found = words.find(output.type);
  if (found != words.end()) {
    try {
      return found->second(summary);
    } catch (const Json::exception&) {  // another plugin's idea of the summary
    }
  }
  std::string text = output.type;  // a type of another plugin: its numbers speak for themselves
  for (const auto& [field, value] : summary.items()) {
    if (value.is_number()) text += ", " + field + " " + value.dump();
  }
  return text;
}

std::string describe(const std::vector<OutputEntry>& outputs) {
  std::string text;
  for (const OutputEntry& output : outputs) text += (text.empty() ? "" : "; ") + describe(output);
  return text;
}

}  // namespace ballflow::cli

#include "types/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "types/topology_table.hpp"

namespace ballflow::geometry {
namespace {

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace

std::string what_is_missing(const Refinement& report) {
  if (report.refined == 0) return {};
  std::string words;
  if (report.left_out > 0) {
    words = std::to_string(report.left_out);
    words.append(
        " triangles lie inside the solid, with the inside on both sides, and are left out: turn their shell "
        "over in the file if it bounds a cavity");
  }
  // Of a surface whose solid is unknown (it crosses itself, say) SolidTopology has said so.
  if (report.aim() != Refinement::unknown && !report.reached()) {
    words.append(words.empty() ? "" : "; ").append("the union of the inner balls has ");
    words.append(describe(report.balls));
    words.append(", the solid ").append(describe(report.aim()));
    words.append(": lower delta or floor");
    if (!report.limited.empty()) {
      const Vec3 p = report.limited[0];
      words.append("; ")
          .append(std::to_string(report.limited.size()))
          .append(" balls reach deep into walls or slots down to ")
          .append(short_number(report.widths[0]))
          .append(" wide, first at (")
          .append(short_number(p.x) + ", ")
          .append(short_number(p.y) + ", ")
          .append(short_number(p.z) + ")");
    }
  }
  if (report.complete == 0) {
    words.append(words.empty() ? "" : "; ").append("refinement stopped at ");
    words.append(std::to_string(report.samples)).append(" samples: raise max_samples, or delta and floor");
  }
  return words;
}

std::string broken_invariant(const Refinement& report) {
  if (report.limited.size() != report.widths.size()) {
    return std::to_string(report.limited.size()) + " limited places and " +
           std::to_string(report.widths.size()) + " widths, they must be as many";
  }
  for (std::size_t i = 0; i < report.limited.size(); ++i) {
    if (!is_finite(report.limited[i])) return "limited place " + std::to_string(i) + " is not finite";
    if (!(report.widths[i] >= 0)) return "the width at limited place " + std::to_string(i) + " is no length";
  }
  for (std::size_t i = 0; i < report.uncovered.size(); ++i) {
    const std::int32_t sample = report.uncovered[i];
    if (sample < 0 || sample >= report.samples || (i > 0 && sample <= report.uncovered[i - 1])) {
      return "uncovered sample " + std::to_string(sample) + " is out of range or out of order";
    }
  }
  if (report.samples < 0 || report.rounds < 0 || report.left_out < 0)
    return "a number of samples or rounds is negative";
  return {};
}

}  // namespace ballflow::geometry

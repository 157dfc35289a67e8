#include "poles/label_poles.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "poles/angle_labels.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {

namespace {

constexpr auto inner = static_cast<std::uint8_t>(PoleLabel::inner);
constexpr auto outer = static_cast<std::uint8_t>(PoleLabel::outer);
constexpr auto unlabelled = static_cast<std::uint8_t>(PoleLabel::unlabelled);

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

void check_mesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    throw InputError("the mesh has no triangles, so it has no inside",
                     "label with a mesh of the surface, or by method angle, which needs none");
  }
  if (const std::string broken = broken_invariant(mesh); !broken.empty()) {
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  }
  if (bounding_box(mesh.vertices.span()).longest_edge() > 1e40) {
    throw InputError("the longest edge of the mesh's bounding box exceeds 1e40 model units",
                     "scale the model to a unit in which it has an ordinary size");
  }
}

Balls select_label(const PoleSet& poles, std::uint8_t label, OuterBalls which = OuterBalls::all) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> samples;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (poles.labels[i] != label || (which == OuterBalls::bounded && poles.unbounded[i] == 1)) continue;
    centers.push_back(poles.centers[i]);
    radii.push_back(poles.radii[i]);
    const auto first = poles.defining_samples.begin() + poles.defining_offsets[i];
    const auto last = poles.defining_samples.begin() + poles.defining_offsets[i + 1];
    samples.insert(samples.end(), first, last);
    offsets.push_back(static_cast<std::int64_t>(samples.size()));
  }
  return {std::move(centers), std::move(radii), std::move(offsets), std::move(samples)};
}

// The poles of every sample, with a third one wherever the first two have the same label: the farthest listed
// vertex of its cell that has the other label.
std::vector<std::array<std::int32_t, 3>> with_third_poles(const PoleSet& poles,
                                                          const std::vector<std::uint8_t>& labels) {
  std::vector<std::array<std::int32_t, 3>> result(poles.sample_poles.begin(), poles.sample_poles.end());
  std::vector<std::uint8_t> missing(result.size(), 0);  // the label that none of them has
  for (std::size_t s = 0; s < result.size(); ++s) {
    const std::int32_t first = result[s][0], second = result[s][1];
    result[s][2] = -1;
    if (first < 0) continue;
    const std::uint8_t label = labels[at(first)];
    if (second >= 0 && labels[at(second)] != label) continue;
    missing[s] = label == inner ? outer : inner;
  }
  const auto better = [&](std::size_t i, std::int32_t best) {
    if (best < 0) return true;
    if (poles.radii[i] != poles.radii[at(best)]) return poles.radii[i] > poles.radii[at(best)];
    return poles.centers[i] < poles.centers[at(best)];
  };
  for (std::size_t i = 0; i < poles.size(); ++i) {
    for (std::int64_t k = poles.defining_offsets[i]; k < poles.defining_offsets[i + 1]; ++k) {
      const std::size_t s = at(poles.defining_samples[static_cast<std::size_t>(k)]);
      if (missing[s] == labels[i] && better(i, result[s][2])) result[s][2] = static_cast<std::int32_t>(i);
    }
  }
  return result;
}

// The entries of `poles` that are kept; no sample has a pole that is not.
PoleSet select_kept(const PoleSet& poles, const std::vector<std::uint8_t>& kept) {
  if (std::count(kept.begin(), kept.end(), 0) == 0) return poles;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  std::vector<std::uint8_t> labels, unbounded, uncertain;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> samples, number(poles.size(), -1);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (kept[i] == 0) continue;
    number[i] = static_cast<std::int32_t>(radii.size());
    centers.push_back(poles.centers[i]);
    radii.push_back(poles.radii[i]);
    labels.push_back(poles.labels[i]);
    unbounded.push_back(poles.unbounded[i]);
    if (!poles.uncertain.empty()) uncertain.push_back(poles.uncertain[i]);
    samples.insert(samples.end(), poles.defining_samples.begin() + poles.defining_offsets[i],
                   poles.defining_samples.begin() + poles.defining_offsets[i + 1]);
    offsets.push_back(static_cast<std::int64_t>(samples.size()));
  }
  std::vector<std::array<std::int32_t, 3>> sample_poles(poles.sample_poles.begin(), poles.sample_poles.end());
  for (auto& own : sample_poles) {
    for (std::int32_t& pole : own) pole = pole < 0 ? -1 : number[at(pole)];
  }
  return {std::move(centers), std::move(radii),     std::move(labels),       std::move(offsets),
          std::move(samples), std::move(unbounded), std::move(sample_poles), std::move(uncertain)};
}

LabelledPoles label_by_angle(const PoleSet& poles, const LabelPolesOptions& options, Monitor& monitor) {
  AngleLabels found = angle_labels(poles, monitor);
  LabelledPoles result;
  result.method = LabelMethod::angle;
  result.poles = poles;
  result.poles.sample_poles = with_third_poles(poles, found.labels);
  const std::vector<std::uint8_t> kept = is_pole(result.poles);
  std::int64_t all = 0, inside = 0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (kept[i] == 0) continue;
    ++all;
    if (found.labels[i] == inner) ++inside;
    if (found.labels[i] == unlabelled) ++result.unlabelled;
    if (found.uncertain[i] == 1) ++result.uncertain;
  }
  if (inside == 0) {
    throw InputError(
        "none of the " + std::to_string(all) + " poles is inside: the outside reaches all of them",
        "sample a closed surface more densely, or label with a mesh of it");
  }
  if (result.unlabelled > 0) {
    monitor.warn(std::to_string(result.unlabelled) + " of " + std::to_string(all) +
                 " poles are neither inner nor outer: nothing connects them with the outside");
  }
  if (result.uncertain * 100 > all) {
    monitor.warn(
        std::to_string(result.uncertain) + " of " + std::to_string(all) +
        " poles are uncertain, as at sharp edges, noise, and sheets close to each other: the evidence "
        "against their label is at least half as strong as that for it");
  }
  result.poles.labels = std::move(found.labels);
  result.poles.uncertain = std::move(found.uncertain);
  result.poles = select_kept(result.poles, kept);
  result.inner = select_label(result.poles, inner);
  result.outer = select_label(result.poles, outer, options.outer);
  monitor.step(1);
  return result;
}

struct Counts {
  std::int64_t all = 0, inner = 0, uncertain = 0, negative = 0;
};

}  // namespace

const char* name(LabelMethod method) {
  switch (method) {
    case LabelMethod::mesh:
      return "mesh";
    case LabelMethod::winding:
      return "winding";
    case LabelMethod::angle:
      return "angle";
    default:
      return "auto";
  }
}

LabelledPoles label_poles(const PoleSet& poles, const TriangleMesh& mesh, const LabelPolesOptions& options,
                          Monitor& monitor) {
  if (options.method == LabelMethod::angle ||
      (options.method == LabelMethod::automatic && mesh.triangles.empty())) {
    return label_by_angle(poles, options, monitor);
  }
  check_mesh(mesh);
  monitor.step(0);
  const WindingNumber winding(mesh, monitor);
  const bool closed = winding.chain().closed();
  if (!closed && options.method == LabelMethod::mesh) {
    throw InputError(why_not_closed(winding.chain(), mesh),
                     "close the mesh, or label with method winding, which accepts open meshes");
  }
  monitor.step(0.3);

  std::vector<WindingNumber::Value> values(poles.size());
  std::atomic<std::size_t> done = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, poles.size(), 512), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (poles.unbounded[i] == 0) values[i] = winding.around(poles.centers[i]);
    }
    const std::size_t before = done.fetch_add(range.size());
    monitor.progress(0.3 + 0.6 * static_cast<double>(before) / static_cast<double>(poles.size()));
  });
  monitor.step(0.9);

  // Components of closed meshes face outwards; an open mesh faces the way that finds more inside.
  Counts counts;
  std::vector<std::uint8_t> kept = is_pole(poles);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (kept[i] == 0) continue;
    if (values[i].number > 0.5) ++counts.inner;
    if (values[i].number < -0.5) ++counts.negative;
  }
  const double sign = !closed && counts.negative > counts.inner ? -1 : 1;
  LabelledPoles result;
  result.turned_triangles =
      sign > 0 ? winding.turned()
               : static_cast<std::int64_t>(winding.chain().triangles.size()) - winding.turned();
  result.method = closed && options.method != LabelMethod::winding ? LabelMethod::mesh : LabelMethod::winding;
  std::vector<std::uint8_t> labels(poles.size(), outer);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (sign * values[i].number > 0.5 && !values[i].on_surface) labels[i] = inner;
  }
  result.poles = poles;
  result.poles.sample_poles = with_third_poles(poles, labels);
  result.poles.labels = std::move(labels);

  counts = {};
  const bool all = options.vertices == Vertices::all || (closed && options.vertices == Vertices::automatic);
  kept = all ? std::vector<std::uint8_t>(poles.size(), 1) : is_pole(result.poles);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (kept[i] == 0) continue;
    const double number = sign * values[i].number;
    ++counts.all;
    if (result.poles.labels[i] == inner) ++counts.inner;
    if (values[i].on_surface || (number >= 0.25 && number <= 0.75)) ++counts.uncertain;
    if (number < -0.5) ++counts.negative;
  }
  const std::string uncertain =
      std::to_string(counts.uncertain) + " of " + std::to_string(counts.all) + " poles";
  if (counts.inner == 0) {
    throw InputError(
        "no pole is inside the mesh (" + uncertain + " are near the middle between inside and outside)" +
            (closed ? std::string() : "; " + why_not_closed(winding.chain(), mesh)),
        closed ? "the samples are too few for a ball to lie inside: sample the surface more densely, for "
                 "example with "
                 "mode=surface of Sample, or use the mesh of the solid that was sampled"
               : "use the mesh of the solid that was sampled; an open sheet has no inside: close it "
                 "first, or let a closed surface be put around it (sampling=wrap)");
  }
  if (!closed && options.method == LabelMethod::automatic) {
    // A sheet: hardly a pole is wound around enough, or many are near the middle.
    if (counts.uncertain * 5 > counts.all ||
        counts.inner * 5 < static_cast<std::int64_t>(poles.sample_poles.size())) {
      throw InputError(
          why_not_closed(winding.chain(), mesh) + "; the surface has no inside that could be told: only " +
              std::to_string(counts.inner) + " poles are inside for " +
              std::to_string(poles.sample_poles.size()) + " samples, and " + uncertain + " are uncertain",
          "fill the holes; or let a closed surface be put around it (sampling=wrap); or take the labels as "
          "they are (labels=winding)");
    }
    monitor.warn(why_not_closed(winding.chain(), mesh) +
                 "; poles were labelled by generalized winding number, " + uncertain + " are uncertain");
  } else if (counts.uncertain > 0) {
    monitor.warn(uncertain + (closed ? " lie exactly on the surface: they were labelled outer"
                                     : " are uncertain: their winding number is between 0.25 and 0.75"));
  }
  if (counts.inner * 100 < static_cast<std::int64_t>(poles.sample_poles.size())) {
    monitor.warn("only " + std::to_string(counts.inner) + " poles are inside for " +
                 std::to_string(poles.sample_poles.size()) +
                 " samples: the mesh bounds hardly any volume, or it is not the surface that was sampled");
  }
  if (counts.negative > 0) {
    monitor.warn(std::to_string(counts.negative) +
                 " poles have a negative winding number: a part of the mesh is inside out");
  }

  result.poles = select_kept(result.poles, kept);
  result.uncertain = counts.uncertain;
  result.inner = select_label(result.poles, inner);
  result.outer = select_label(result.poles, outer, options.outer);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry

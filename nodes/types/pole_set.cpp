#include "types/pole_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace ballflow::geometry {

namespace {

constexpr auto unlabelled = static_cast<std::uint8_t>(PoleLabel::unlabelled);

std::string pole_name(std::size_t pole) { return "pole " + std::to_string(pole); }

std::span<const std::int32_t> samples_of(const PoleSet& poles, std::size_t pole) {
  const auto first = static_cast<std::size_t>(poles.defining_offsets[pole]);
  const auto last = static_cast<std::size_t>(poles.defining_offsets[pole + 1]);
  return poles.defining_samples.span().subspan(first, last - first);
}

std::string broken_lengths(const PoleSet& poles) {
  const std::size_t n = poles.radii.size();
  const auto wrong = [n](const char* name, std::size_t length) {
    return std::string(name) + " has " + std::to_string(length) + " entries for " + std::to_string(n) +
           " poles";
  };
  if (poles.centers.size() != n) return wrong("centers", poles.centers.size());
  if (poles.labels.size() != n) return wrong("labels", poles.labels.size());
  if (poles.unbounded.size() != n) return wrong("unbounded", poles.unbounded.size());
  if (!poles.uncertain.empty() && poles.uncertain.size() != n)
    return wrong("uncertain", poles.uncertain.size());
  if (poles.defining_offsets.size() != n + 1) return wrong("defining_offsets", poles.defining_offsets.size());
  if (poles.defining_offsets[0] != 0)
    return "defining_offsets[0] is " + std::to_string(poles.defining_offsets[0]);
  for (std::size_t i = 0; i < n; ++i) {
    if (poles.defining_offsets[i + 1] < poles.defining_offsets[i]) {
      return "defining_offsets decreases after " + pole_name(i);
    }
  }
  if (poles.defining_offsets[n] != static_cast<std::int64_t>(poles.defining_samples.size())) {
    return "defining_offsets ends at " + std::to_string(poles.defining_offsets[n]) +
           ", defining_samples has " + std::to_string(poles.defining_samples.size()) + " entries";
  }
  return {};
}

std::string broken_pole(const PoleSet& poles, std::size_t i) {
  const auto samples = static_cast<std::int32_t>(poles.sample_poles.size());
  const auto defining = samples_of(poles, i);
  if (!is_finite(poles.centers[i])) return pole_name(i) + " has a centre that is not finite";
  if (!(std::isfinite(poles.radii[i]) && poles.radii[i] >= 0)) {
    return pole_name(i) + " has radius " + std::to_string(poles.radii[i]);
  }
  if (poles.labels[i] > static_cast<std::uint8_t>(PoleLabel::outer)) {
    return pole_name(i) + " has label " + std::to_string(poles.labels[i]);
  }
  if (poles.unbounded[i] > 1) return pole_name(i) + " has unbounded = " + std::to_string(poles.unbounded[i]);
  if (poles.unbounded[i] == 1 && poles.labels[i] == static_cast<std::uint8_t>(PoleLabel::inner)) {
    return pole_name(i) + " is unbounded and labelled inner";
  }
  const std::size_t least = poles.unbounded[i] == 1 ? 1 : 4;
  if (defining.size() < least) {
    return pole_name(i) + " has " + std::to_string(defining.size()) + " defining samples, fewer than " +
           std::to_string(least);
  }
  for (std::size_t k = 0; k < defining.size(); ++k) {
    if (defining[k] < 0 || defining[k] >= samples) {
      return pole_name(i) + " is defined by sample " + std::to_string(defining[k]) + " of " +
             std::to_string(samples);
    }
    if (k > 0 && defining[k] <= defining[k - 1])
      return pole_name(i) + " has defining samples that do not ascend";
  }
  if (i > 0) {
    const auto before = samples_of(poles, i - 1);
    if (std::lexicographical_compare(defining.begin(), defining.end(), before.begin(), before.end())) {
      return pole_name(i) + " is out of order: its defining samples precede those of the pole before it";
    }
  }
  return {};
}

std::string broken_sample(const PoleSet& poles, std::size_t s) {
  const std::array<std::int32_t, 3> own = poles.sample_poles[s];
  const std::string name = "sample " + std::to_string(s);
  for (const std::int32_t pole : own) {
    if (pole == -1) continue;
    if (pole < 0 || static_cast<std::size_t>(pole) >= poles.size()) {
      return name + " has pole " + std::to_string(pole) + " of " + std::to_string(poles.size());
    }
    const auto defining = samples_of(poles, static_cast<std::size_t>(pole));
    if (!std::binary_search(defining.begin(), defining.end(), static_cast<std::int32_t>(s))) {
      return name + " has " + pole_name(static_cast<std::size_t>(pole)) + ", which it does not define";
    }
  }
  if (own[0] == -1 && own[1] != -1) return name + " has a second pole but no first";
  if (own[0] != -1 && own[0] == own[1]) return name + " has the same pole on both sides";
  if (own[2] == -1) return {};
  const std::uint8_t third = poles.labels[static_cast<std::size_t>(own[2])];
  for (const std::int32_t pole : {own[0], own[1]}) {
    if (pole == -1) continue;
    const std::uint8_t label = poles.labels[static_cast<std::size_t>(pole)];
    if (label == unlabelled || third == unlabelled) return name + " has a third pole before all are labelled";
    if (label == third) return name + " has a third pole on the side of its others";
  }
  return {};
}

}  // namespace

std::vector<std::uint8_t> is_pole(const PoleSet& poles) {
  std::vector<std::uint8_t> pole(poles.size(), 0);
  for (const auto& own : poles.sample_poles) {
    for (const std::int32_t i : own) {
      if (i >= 0) pole[static_cast<std::size_t>(i)] = 1;
    }
  }
  return pole;
}

std::string broken_invariant(const PoleSet& poles) {
  if (std::string broken = broken_lengths(poles); !broken.empty()) return broken;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (std::string broken = broken_pole(poles, i); !broken.empty()) return broken;
  }
  for (std::size_t s = 0; s < poles.sample_poles.size(); ++s) {
    if (std::string broken = broken_sample(poles, s); !broken.empty()) return broken;
  }
  const std::vector<std::uint8_t> pole = is_pole(poles);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (pole[i] == 1) continue;
    if (poles.unbounded[i] == 1) return pole_name(i) + " is the pole of no sample, and unbounded";
  }
  return {};
}

}  // namespace ballflow::geometry

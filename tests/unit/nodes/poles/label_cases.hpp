// Poles and their labels, checked.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>

#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "shapes.hpp"

namespace ballflow::label_cases {

using geometry::InputError;
using geometry::label_poles;
using geometry::LabelledPoles;
using geometry::LabelMethod;
using geometry::PoleLabel;
using geometry::PoleSet;
using geometry::voronoi_poles;
using test::Mesh;
using test::TriangleMesh;
using test::Vec3;

inline constexpr auto inner = static_cast<std::uint8_t>(PoleLabel::inner);
inline constexpr auto outer = static_cast<std::uint8_t>(PoleLabel::outer);

struct Warnings final : geometry::Monitor {
  std::string text;
  void warn(const std::string& line) override { text += line + "\n"; }
};

inline std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

inline std::span<const std::int32_t> samples_of(const PoleSet& poles, std::size_t pole) {
  return poles.defining_samples.span().subspan(
      static_cast<std::size_t>(poles.defining_offsets[pole]),
      static_cast<std::size_t>(poles.defining_offsets[pole + 1] - poles.defining_offsets[pole]));
}

inline LabelledPoles label(const PoleSet& poles, const TriangleMesh& mesh,
                           LabelMethod method = LabelMethod::automatic) {
  LabelledPoles result = label_poles(poles, mesh, {method});
  EXPECT_EQ(geometry::broken_invariant(result.poles), "");
  EXPECT_EQ(geometry::broken_invariant(result.inner), "");
  EXPECT_EQ(geometry::broken_invariant(result.outer), "");
  EXPECT_EQ(result.inner.size() + result.outer.size(), result.poles.size());
  for (std::size_t s = 0; s < poles.sample_poles.size(); ++s) {
    const auto& before = poles.sample_poles[s];
    const auto& after = result.poles.sample_poles[s];
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(poles.centers[at(before[k])], result.poles.centers[at(after[k])]) << "pole of sample " << s;
    }
    const bool one_sided = result.poles.labels[at(after[0])] == result.poles.labels[at(after[1])];
    EXPECT_TRUE(one_sided || after[2] == -1) << "sample " << s << " needs no third pole";
  }
  return result;
}

inline std::string refusal(const PoleSet& poles, const TriangleMesh& mesh,
                           LabelMethod method = LabelMethod::automatic) {
  try {
    label_poles(poles, mesh, {method});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace ballflow::label_cases

// Medial axes of sets of balls that are degenerate, nearly degenerate, or just not any more.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "homology/axis_betti.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

/// How many sets: tools/nightly sets more.
std::uint64_t sets() {
  const char* const text = std::getenv("BALLFLOW_TEST_SETS");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 400;
}

class DegenerateListener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

class DegenerateSet {
 public:
  explicit DegenerateSet(std::uint64_t seed) : engine_(seed) {
    // How far from degenerate: by a power of ten that doubles see or do not see any more, or not at all.
    noise_ = std::pow(10.0, -static_cast<double>(below(17)));
    if (below(8) == 0) noise_ = std::pow(10.0, -20 - static_cast<double>(below(280)));
    if (below(8) == 0) noise_ = 0;
    const std::array<void (DegenerateSet::*)(), 8> kinds{
        &DegenerateSet::coplanar, &DegenerateSet::cospherical, &DegenerateSet::through_points,
        &DegenerateSet::touching, &DegenerateSet::on_a_grid,   &DegenerateSet::in_rings,
        &DegenerateSet::equal,    &DegenerateSet::collinear};
    (this->*kinds[seed % 8])();
  }
  Balls balls() const { return {centers_, radii_, {}, {}}; }

 private:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  double little() { return (2 * unit() - 1) * noise_; }
  Vec3 anywhere() { return {unit(), unit(), unit()}; }
  void add(Vec3 center, double radius) {
    centers_.push_back(center + Vec3{little(), little(), little()});
    radii_.push_back(radius * (1 + little() / 2));
  }

  void coplanar() {
    for (std::size_t n = 4 + below(30); n > 0; --n) add({unit(), unit(), 0}, 0.1 + 0.3 * unit());
  }
  void cospherical() {  // centres; where the radius is 1 all spheres pass through the middle
    const double radius = below(2) == 0 ? 1 : 0.3 + unit();
    for (std::size_t n = 4 + below(30); n > 0; --n) {
      const Vec3 p = anywhere() - Vec3{0.5, 0.5, 0.5};
      if (length(p) > 0.05) add((1 / length(p)) * p, radius);
    }
  }
  void through_points() {
    const std::vector<Vec3> points{anywhere(), anywhere(), anywhere()};
    const std::size_t of = 1 + below(3);
    for (std::size_t n = 4 + below(20); n > 0; --n) {
      const Vec3 center = anywhere();
      add(center, distance(center, points[below(of)]));
    }
  }
  void touching() {
    for (std::size_t n = 4 + below(30); n > 0; --n) {
      const Vec3 center = anywhere();
      double radius = 0.05 + 0.2 * unit();
      if (!centers_.empty()) {
        const std::size_t other = below(centers_.size());
        const double gap = distance(center, centers_[other]) - radii_[other];
        if (gap > 0 && gap < 0.5) radius = gap;
      }
      add(center, radius);
    }
  }
  void on_a_grid() {
    const std::array<double, 4> radii{0.5, 0.75, 0.7071067811865476, 0.8660254037844387};
    const double radius = radii[below(4)];
    for (std::size_t n = 5 + below(30); n > 0; --n)
      add({double(below(3)), double(below(3)), double(below(3))}, radius);
  }
  void in_rings() {
    const std::size_t corners = 3 + below(6), rings = 1 + below(3);
    const double radius = 0.5 + 0.7 * unit();
    for (std::size_t i = 0; i < corners * rings; ++i) {
      const double angle =
          6.283185307179586 * static_cast<double>(i % corners) / static_cast<double>(corners);
      add({std::cos(angle), std::sin(angle), 0.6 * static_cast<double>(i / corners)}, radius);
    }
    if (below(2) == 0) add({0, 0, 0}, radius);
  }
  void equal() {
    for (std::size_t n = 4 + below(12); n > 0; --n) {
      const Vec3 center = anywhere();
      const double radius = 0.2 + 0.3 * unit();
      for (std::size_t copies = 1 + below(3); copies > 0; --copies) add(center, radius);
    }
  }
  void collinear() {
    for (std::size_t n = 4 + below(12); n > 0; --n) add({3 * unit(), 0, 0}, 0.2 + 0.3 * unit());
  }

  std::mt19937_64 engine_;
  double noise_ = 0;
  std::vector<Vec3> centers_;
  std::vector<double> radii_;
};

TEST(DegenerateAxis, has_the_betti_numbers_of_the_union) {
  std::size_t solid = 0;
  for (std::uint64_t seed = 0; seed < sets(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    DegenerateListener listener;
    const SimplicialComplex complex = alpha_shape(DegenerateSet(seed).balls(), {}, no_monitor());
    const MedialAxis axis = medial_axis(complex, {}, listener);
    EXPECT_EQ(axis_betti(axis, no_monitor()), complex.betti);
    EXPECT_EQ(broken_invariant(axis), "");
    EXPECT_TRUE(listener.warnings.empty());
    solid += complex.tetrahedra.empty() ? 0 : 1;
  }
  EXPECT_GT(solid, sets() / 3);
}

TEST(DegenerateAxis, has_the_betti_numbers_of_the_union_by_exact_decisions_alone) {
  MedialAxisOptions exact;
  exact.exact = true;
  for (std::uint64_t seed = 0; seed < sets() / 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SimplicialComplex complex = alpha_shape(DegenerateSet(seed).balls(), {}, no_monitor());
    EXPECT_EQ(axis_betti(medial_axis(complex, exact, no_monitor()), no_monitor()), complex.betti);
  }
}

}  // namespace
}  // namespace ballflow::geometry

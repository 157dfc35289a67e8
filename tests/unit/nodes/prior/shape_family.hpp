// A family of shapes whose modes are known: labelled balls and surface points of an ellipsoid.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "prior_examples.hpp"
#include "types/matched_balls.hpp"

namespace ballflow::geometry {

inline bool says(const Warnings& warnings, const std::string& words) {
  return warnings.text.find(words) != std::string::npos;
}

/// k balls in, and m points on, an ellipsoid of about 3 x 2 x 1. `length` stretches it along x, `growth`
/// makes its balls larger and its surface with them along z: two modes that are linear in these numbers.
inline MatchedBalls family_member(double length, double growth, std::size_t k = 30, std::size_t m = 120) {
  Random random(7);
  std::vector<Vec3> centers, points, normals;
  std::vector<double> radii;
  for (std::size_t i = 0; i < k; ++i) {
    const Vec3 p{2 * random.unit() - 1, 2 * random.unit() - 1, random.unit() - 0.5};
    centers.push_back({(1 + length) * 2 * p.x, 1.5 * p.y + 0.3 * p.x * p.x, p.z});
    radii.push_back((0.3 + 0.2 * random.unit()) * std::exp(growth));
  }
  for (std::size_t i = 0; i < m; ++i) {
    const double z = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(m);
    const double turn = 2.399963229728653 * static_cast<double>(i), ring = std::sqrt(1 - z * z);
    const Vec3 u{ring * std::cos(turn), ring * std::sin(turn), z};
    // An end is thicker than the other, so that no turn maps the shape to itself.
    const double taper = 1 + 0.25 * u.x;
    points.push_back({(1 + length) * 3 * u.x, 2 * taper * u.y + 0.4 * u.x * u.x, (1 + growth) * u.z});
    const Vec3 n{u.x / 3, u.y / 2, u.z};
    normals.push_back((1 / std::sqrt(dot(n, n))) * n);
  }
  MatchedBalls matched;
  matched.partners = std::vector<std::uint8_t>(k, 1);
  matched.unique = std::vector<std::uint8_t>(k, 1);
  matched.residuals = std::vector<double>(k, 0.0);
  matched.point_residuals = std::vector<double>(m, 0.0);
  matched.carried = centers;
  matched.centers = std::move(centers);
  matched.radii = std::move(radii);
  matched.points = std::move(points);
  matched.normals = std::move(normals);
  matched.samples = matched.points;
  matched.sample_normals = matched.normals;
  return matched;
}

/// The instance somewhere else; a scale scales radii, too.
inline MatchedBalls moved(const MatchedBalls& matched, const ShapePose& pose) {
  MatchedBalls result = matched;
  const auto points = [&](const Array<Vec3>& from) {
    std::vector<Vec3> to;
    for (const Vec3& p : from) to.push_back(transformed(pose, p));
    return Array<Vec3>(std::move(to));
  };
  const auto directions = [&](const Array<Vec3>& from) {
    std::vector<Vec3> to;
    for (const Vec3& p : from) to.push_back(turned(pose, p));
    return Array<Vec3>(std::move(to));
  };
  result.centers = points(matched.centers);
  result.carried = points(matched.carried);
  result.points = points(matched.points);
  result.samples = points(matched.samples);
  result.normals = directions(matched.normals);
  result.sample_normals = directions(matched.sample_normals);
  std::vector<double> radii;
  for (const double r : matched.radii) radii.push_back(pose.scale * r);
  result.radii = std::move(radii);
  return result;
}

/// Members with independent numbers, each turned and shifted at random.
struct Family {
  std::vector<double> lengths, growths;
  std::vector<MatchedBalls> members;
};

inline Family family(std::size_t n, std::uint64_t seed = 1, bool turned = true) {
  Random random(seed);
  Family result;
  for (std::size_t i = 0; i < n; ++i) {
    result.lengths.push_back(0.4 * (random.unit() - 0.5));
    result.growths.push_back(0.2 * (random.unit() - 0.5));
    const MatchedBalls member = family_member(result.lengths.back(), result.growths.back());
    result.members.push_back(turned ? moved(member, random_pose(random, 1, 20)) : member);
  }
  return result;
}

/// How well a straight line explains y by x: the square of their correlation.
inline double squared_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xy * xy / (xx * yy);
}

}  // namespace ballflow::geometry

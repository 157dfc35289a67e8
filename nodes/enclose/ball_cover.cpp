#include "enclose/ball_cover.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/space_order.hpp"

namespace ballflow::geometry {

void PointBlocks::build(const std::vector<FloatPoints>& corners) {
  constexpr float far = 1e9F;
  corners_ = corners;
  size_ = corners_[0].size();
  const std::size_t blocks = (size_ + block - 1) / block, padded = (blocks + lanes - 1) / lanes * lanes;
  for (FloatPoints& points : corners_) {
    while (points.size() < padded * block) points.push_back(far, far, far);
  }
  for (std::size_t b = 0; b < padded; ++b) {
    constexpr float none = std::numeric_limits<float>::max();
    std::array<float, 3> low{none, none, none}, high{-none, -none, -none};
    for (std::size_t i = b * block; i < std::min(size_, (b + 1) * block); ++i) {
      for (const FloatPoints& points : corners_) {
        low = {std::min(low[0], points.x[i]), std::min(low[1], points.y[i]), std::min(low[2], points.z[i])};
        high = {std::max(high[0], points.x[i]), std::max(high[1], points.y[i]),
                std::max(high[2], points.z[i])};
      }
    }
    if (b * block >= size_) low = high = {far, far, far};
    lower_.push_back(low[0], low[1], low[2]);
    upper_.push_back(high[0], high[1], high[2]);
  }
}

BallCover::BallCover(const SurfacePatches& patches, std::span<const Vec3> points_inside,
                     const OutsidePoints& outside)
    : spacing_(static_cast<float>(outside.spacing)) {
  for (const Vec3 p : patches.vertices) vertices_.push_back(p);
  corner_ids_ = patches.corners;
  surface_patches_ = corner_ids_.size();
  for (const Vec3 p : points_inside) {
    const auto v = static_cast<std::int32_t>(vertices_.size());
    vertices_.push_back(p);
    corner_ids_.push_back({v, v, v});
  }
  std::vector<FloatPoints> corners(3);
  for (const auto& ids : corner_ids_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(ids[k]);
      corners[k].push_back(vertices_.x[v], vertices_.y[v], vertices_.z[v]);
    }
  }
  patches_.build(corners);
  const SpaceOrder place(bounding_box(outside.points));
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < outside.points.size(); ++i) order.emplace_back(place(outside.points[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<FloatPoints> points(1);
  for (const auto& [key, i] : order) {
    points[0].push_back(outside.points[i]);
    weights_.push_back(outside.weights[i]);
  }
  points_.build(points);
  patch_count_.resize(patches_.size());
  patch_xor_.resize(patches_.size());
  point_count_.resize(points_.size());
  point_xor_.resize(points_.size());
  uncovered_ = patches_.size();
  stamps_.resize(vertices_.size());
}

void BallCover::leave(std::size_t i) {
  const auto name = static_cast<std::uint32_t>(i + 1);
  for (const std::int32_t p : places_[i].patches) {
    const auto n = static_cast<std::size_t>(p);
    if (--patch_count_[n] == 0) ++uncovered_;
    patch_xor_[n] ^= name;
  }
  for (const std::int32_t p : places_[i].points) {
    const auto n = static_cast<std::size_t>(p);
    if (--point_count_[n] == 0) waste_ -= weights_[n];
    point_xor_[n] ^= name;
  }
  if (places_[i].used) --used_;
}

void BallCover::enter(std::size_t i) {
  const auto name = static_cast<std::uint32_t>(i + 1);
  for (const std::int32_t p : places_[i].patches) {
    const auto n = static_cast<std::size_t>(p);
    if (patch_count_[n]++ == 0) --uncovered_;
    patch_xor_[n] ^= name;
  }
  for (const std::int32_t p : places_[i].points) {
    const auto n = static_cast<std::size_t>(p);
    if (point_count_[n]++ == 0) waste_ += weights_[n];
    point_xor_[n] ^= name;
  }
  if (places_[i].used) ++used_;
}

void BallCover::set(std::size_t i, const FloatBall& ball) {
  leave(i);
  journal_.push_back({i, std::move(places_[i])});
  Place& place = places_[i];
  place = {};
  place.ball = ball;
  place.used = true;
  patches_.in_ball(ball, [&](std::size_t p) { place.patches.push_back(static_cast<std::int32_t>(p)); });
  points_.in_ball(ball, [&](std::size_t p) { place.points.push_back(static_cast<std::int32_t>(p)); });
  enter(i);
}

void BallCover::remove(std::size_t i) {
  leave(i);
  journal_.push_back({i, std::move(places_[i])});
  places_[i] = {};
}

void BallCover::undo_to(std::size_t mark) {
  while (journal_.size() > mark) {
    Change& change = journal_.back();
    leave(change.place);
    places_[change.place] = std::move(change.before);
    enter(change.place);
    journal_.pop_back();
  }
}

std::size_t BallCover::free_place() const {
  std::size_t i = 0;
  while (i < places_.size() && places_[i].used) ++i;
  return i;
}

void BallCover::only_in(std::size_t i, std::vector<std::int32_t>& result) const {
  result.clear();
  for (const std::int32_t p : places_[i].patches) {
    if (patch_count_[static_cast<std::size_t>(p)] == 1) result.push_back(p);
  }
}

float BallCover::farthest(std::size_t patch, const FloatBall& from) const {
  float most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const FloatPoints& c = patches_.corner(k);
    most = std::max(most, squared_from(from, c.x[patch], c.y[patch], c.z[patch]));
  }
  return std::sqrt(most);
}

void BallCover::prepare(std::size_t i, const FloatBall& around, std::span<const std::int32_t> patches,
                        BallFit& fit) const {
  const float reach = 1.35F * around.r + 2 * spacing_;
  fit.begin(around.x, around.y, around.z, reach, 0.7F * spacing_);
  ++stamp_;
  for (const std::int32_t p : patches) {
    for (const std::int32_t id : corner_ids_[static_cast<std::size_t>(p)]) {
      const auto v = static_cast<std::size_t>(id);
      if (stamps_[v] == stamp_) continue;
      stamps_[v] = stamp_;
      fit.hold(vertices_.x[v], vertices_.y[v], vertices_.z[v]);
    }
  }
  const auto name = static_cast<std::uint32_t>(i + 1);
  const FloatPoints& points = points_.corner(0);
  points_.in_ball({around.x, around.y, around.z, reach}, [&](std::size_t n) {
    if (point_count_[n] == 0 || (point_count_[n] == 1 && point_xor_[n] == name))
      fit.avoid(points.x[n], points.y[n], points.z[n], static_cast<float>(weights_[n]));
  });
  fit.end();
}

}  // namespace ballflow::geometry

// Balls that cover patches of a surface, and how much of the space outside they waste: kept up to date while
// balls change.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "enclose/ball_fit.hpp"
#include "enclose/lanes.hpp"
#include "enclose/solid_lattice.hpp"
#include "enclose/surface_patches.hpp"

namespace ballflow::geometry {

/// Points in blocks of neighbours with boxes, to find those in a ball.
class PointBlocks {
 public:
  static constexpr std::size_t block = 32;
  /// Points that follow each other are close; `corners` of them belong together and are found when all are
  /// in.
  void build(const std::vector<FloatPoints>& corners);
  std::size_t size() const { return size_; }
  const FloatPoints& corner(std::size_t k) const { return corners_[k]; }
  const FloatPoints& lower() const { return lower_; }
  const FloatPoints& upper() const { return upper_; }
  /// Calls visit(i) for every one that lies in the ball, ascending.
  template <class Visit>
  void in_ball(const FloatBall& ball, Visit visit) const;

 private:
  std::size_t size_ = 0;
  std::vector<FloatPoints> corners_;  // padded with points far away
  FloatPoints lower_, upper_;         // boxes, padded
};

/// k places for balls. Changes can be undone.
class BallCover {
 public:
  struct Place {
    FloatBall ball;
    bool used = false;
    std::vector<std::int32_t> patches, points;  // in the ball
  };

  BallCover(const SurfacePatches& patches, std::span<const Vec3> points_inside, const OutsidePoints& outside);

  std::size_t places() const { return places_.size(); }
  const Place& place(std::size_t i) const { return places_[i]; }
  std::size_t used() const { return used_; }
  /// Makes room for `count` balls.
  void resize(std::size_t count) { places_.resize(count); }
  void set(std::size_t i, const FloatBall& ball);
  void remove(std::size_t i);
  /// A place without a ball, or places().
  std::size_t free_place() const;

  /// Volume in the union outside of the solid, in units of the lattice.
  std::int64_t waste() const { return waste_; }
  std::size_t uncovered() const { return uncovered_; }
  /// Those of the surface; points inside follow.
  std::size_t surface_patches() const { return surface_patches_; }
  std::size_t patches() const { return patches_.size(); }
  std::span<const std::uint16_t> patch_counts() const { return patch_count_; }
  const PointBlocks& patch_blocks() const { return patches_; }
  const PointBlocks& point_blocks() const { return points_; }
  std::span<const std::int32_t> weights() const { return weights_; }
  std::array<std::int32_t, 3> patch_corners(std::size_t p) const { return corner_ids_[p]; }
  std::size_t vertices() const { return vertices_.size(); }
  const FloatPoints& vertex_points() const { return vertices_; }
  float spacing() const { return spacing_; }

  /// Patches in ball i and no other.
  void only_in(std::size_t i, std::vector<std::int32_t>& result) const;
  /// The place of the ball that a patch is in, of one that is in no other.
  std::size_t place_of(std::size_t patch) const { return patch_xor_[patch] - 1; }
  /// The greatest distance of a corner of the patch from a point.
  float farthest(std::size_t patch, const FloatBall& from) const;
  /// Begins a fit of the ball in place i to the patches named: points to avoid are those in no other ball.
  void prepare(std::size_t i, const FloatBall& around, std::span<const std::int32_t> patches,
               BallFit& fit) const;

  /// Changes from here on can be undone.
  std::size_t mark() const { return journal_.size(); }
  void undo_to(std::size_t mark);
  /// Nothing before can be undone any more.
  void forget() { journal_.clear(); }

 private:
  struct Change {
    std::size_t place;
    Place before;
  };
  void leave(std::size_t i);
  void enter(std::size_t i);

  std::size_t surface_patches_ = 0;
  PointBlocks patches_, points_;
  std::vector<std::array<std::int32_t, 3>> corner_ids_;
  FloatPoints vertices_;
  std::vector<std::int32_t> weights_;
  float spacing_ = 0;
  std::vector<std::uint16_t> patch_count_, point_count_;  // balls that hold it
  std::vector<std::uint32_t> patch_xor_, point_xor_;      // of their places + 1: the place where there is one
  std::vector<Place> places_;
  std::vector<Change> journal_;
  std::size_t used_ = 0, uncovered_ = 0;
  std::int64_t waste_ = 0;
  mutable std::vector<std::uint32_t> stamps_;  // of vertices
  mutable std::uint32_t stamp_ = 0;
};

template <class Visit>
void PointBlocks::in_ball(const FloatBall& ball, Visit visit) const {
  const Lanes cx = all(ball.x), cy = all(ball.y), cz = all(ball.z), zero = all(0);
  const float squared = ball.r * ball.r;
  const Lanes limit = all(squared), reach = all(squared * 1.00001F);
  for (std::size_t b = 0; b * block < size_; b += lanes) {
    const Lanes dx = greater_of(zero, greater_of(load(&lower_.x[b]) - cx, cx - load(&upper_.x[b])));
    const Lanes dy = greater_of(zero, greater_of(load(&lower_.y[b]) - cy, cy - load(&upper_.y[b])));
    const Lanes dz = greater_of(zero, greater_of(load(&lower_.z[b]) - cz, cz - load(&upper_.z[b])));
    for (unsigned near = bits(dx * dx + dy * dy + dz * dz <= reach); near != 0; near &= near - 1) {
      const std::size_t first = (b + static_cast<std::size_t>(std::countr_zero(near))) * block;
      for (std::size_t i = first; i < first + block; i += lanes) {
        Lanes most = corners_[0].squared_from(i, cx, cy, cz);
        for (std::size_t k = 1; k < corners_.size(); ++k)
          most = greater_of(most, corners_[k].squared_from(i, cx, cy, cz));
        for (unsigned in = bits(most <= limit); in != 0; in &= in - 1)
          visit(i + static_cast<std::size_t>(std::countr_zero(in)));
      }
    }
  }
}

}  // namespace ballflow::geometry

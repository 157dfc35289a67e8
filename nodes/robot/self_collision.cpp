#include "robot/self_collision.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

/// Balls of a link, and one around all of them.
struct LinkBalls {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  Vec3 middle;
  double reach = 0;
};

LinkBalls balls_around(const RobotSpheres& spheres, std::size_t link) {
  LinkBalls result;
  const Balls balls = balls_of(spheres, link);
  result.centers.assign(balls.centers.begin(), balls.centers.end());
  result.radii.assign(balls.radii.begin(), balls.radii.end());
  const Box box = bounding_box(balls);
  if (!box.empty()) result.middle = 0.5 * (box.lower + box.upper);
  for (std::size_t i = 0; i < balls.size(); ++i)
    result.reach = std::max(result.reach, distance(result.middle, result.centers[i]) + result.radii[i]);
  return result;
}

bool within(Vec3 a, Vec3 b, double r) { return squared_distance(a, b) <= r * r; }

bool meet(const LinkBalls& a, const Pose& at_a, const LinkBalls& b, const Pose& at_b) {
  if (!within(moved(at_a, a.middle), moved(at_b, b.middle), a.reach + b.reach)) return false;
  std::vector<Vec3> there;
  for (const Vec3& c : b.centers) there.push_back(moved(at_b, c));
  const Vec3 middle = moved(at_b, b.middle);
  for (std::size_t i = 0; i < a.centers.size(); ++i) {
    const Vec3 center = moved(at_a, a.centers[i]);
    if (!within(center, middle, a.radii[i] + b.reach)) continue;
    for (std::size_t k = 0; k < there.size(); ++k) {
      if (within(center, there[k], a.radii[i] + b.radii[k])) return true;
    }
  }
  return false;
}

class PairFinder {
 public:
  PairFinder(const RobotSpheres& spheres, const SelfCollisionOptions& options, Monitor& monitor)
      : spheres_(spheres), options_(options), monitor_(monitor) {}

  UntestedPairs run() {
    for (std::size_t link = 0; link < spheres_.links(); ++link) {
      balls_.push_back(balls_around(spheres_, link));
      if (!balls_.back().radii.empty()) links_.push_back(link);
    }
    for (std::size_t i = 0; i < links_.size(); ++i) {
      for (std::size_t k = i + 1; k < links_.size(); ++k) pairs_.push_back({links_[i], links_[k]});
    }
    const std::vector<bool> adjacent = adjacency();
    const std::vector<Pose> default_pose = link_poses(spheres_, default_values(spheres_));
    // How often each pair met. Poses differ only in their random numbers, so their order does not matter.
    std::vector<std::atomic<std::int64_t>> met(pairs_.size());
    std::atomic<std::int64_t> done = 0;
    tbb::parallel_for(std::int64_t{0}, options_.poses, [&](std::int64_t number) {
      if (number % 16 == 0 && monitor_.cancelled()) throw Cancelled();
      const std::vector<Pose> poses = link_poses(spheres_, random_values(static_cast<std::uint64_t>(number)));
      for (std::size_t i = 0; i < pairs_.size(); ++i) {
        if (!adjacent[i] && meets(i, poses)) met[i].fetch_add(1, std::memory_order_relaxed);
      }
      if (const std::int64_t now = ++done; now % 64 == 0)
        monitor_.progress(static_cast<double>(now) / static_cast<double>(options_.poses));
    });
    UntestedPairs result;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      PairReason reason;
      if (adjacent[i]) {
        reason = PairReason::adjacent;
      } else if (meets(i, default_pose)) {
        reason = met[i] == options_.poses ? PairReason::always : PairReason::in_default;
      } else if (met[i] == 0) {
        reason = PairReason::never;
      } else {
        continue;
      }
      result.links.push_back(
          {static_cast<std::int32_t>(pairs_[i].first), static_cast<std::int32_t>(pairs_[i].second)});
      result.reasons.push_back(static_cast<std::uint8_t>(reason));
    }
    return result;
  }

 private:
  bool meets(std::size_t pair, const std::vector<Pose>& poses) const {
    const auto [a, b] = pairs_[pair];
    return meet(balls_[a], poses[a], balls_[b], poses[b]);
  }

  /// By pair. Links without balls that a fixed joint holds belong to what holds them.
  std::vector<bool> adjacency() const {
    const std::size_t count = spheres_.links();
    std::vector<std::size_t> holder(count);  // the link that stands for it
    for (std::size_t i = 0; i < count; ++i) holder[i] = i;
    std::vector<std::size_t> joint_of(count, count);
    for (std::size_t j = 0; j < spheres_.joint_kinds.size(); ++j)
      joint_of[static_cast<std::size_t>(spheres_.joint_children[j])] = j;
    for (const std::size_t link : from_root(spheres_)) {
      const std::size_t joint = joint_of[link];
      if (joint == count || !balls_[link].radii.empty()) continue;
      if (spheres_.joint_kinds[joint] == static_cast<std::uint8_t>(JointKind::fixed))
        holder[link] = holder[static_cast<std::size_t>(spheres_.joint_parents[joint])];
    }
    std::vector<bool> adjacent(pairs_.size(), false);
    for (std::size_t j = 0; j < spheres_.joint_kinds.size(); ++j) {
      const std::size_t a = holder[static_cast<std::size_t>(spheres_.joint_parents[j])];
      const std::size_t b = static_cast<std::size_t>(spheres_.joint_children[j]);
      const std::pair pair = std::minmax(a, b);
      const auto found = std::find(pairs_.begin(), pairs_.end(), std::pair<std::size_t, std::size_t>(pair));
      if (found != pairs_.end()) adjacent[static_cast<std::size_t>(found - pairs_.begin())] = true;
    }
    return adjacent;
  }

  bool turns_or_slides(std::size_t joint) const {
    const auto kind = static_cast<JointKind>(spheres_.joint_kinds[joint]);
    return kind == JointKind::revolute || kind == JointKind::continuous || kind == JointKind::prismatic;
  }

  std::vector<double> random_values(std::uint64_t pose) const {
    Random random(pose);
    std::vector<double> values(spheres_.joint_kinds.size(), 0);
    for (std::size_t j = 0; j < values.size(); ++j) {
      auto [lower, upper] = spheres_.joint_limits[j];
      if (spheres_.joint_kinds[j] == static_cast<std::uint8_t>(JointKind::continuous))
        lower = -3.14159265358979323846, upper = -lower;
      if (turns_or_slides(j)) values[j] = lower + (upper - lower) * random.unit();
    }
    return values;
  }

  const RobotSpheres& spheres_;
  const SelfCollisionOptions& options_;
  Monitor& monitor_;
  std::vector<LinkBalls> balls_;  // by link
  std::vector<std::size_t> links_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

}  // namespace

UntestedPairs untested_pairs(const RobotSpheres& spheres, const SelfCollisionOptions& options,
                             Monitor& monitor) {
  if (options.poses == 0) return {};
  return PairFinder(spheres, options, monitor).run();
}

}  // namespace ballflow::geometry

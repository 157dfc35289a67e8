// The sums of all pairs of two sets of balls, made when they are needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

struct Ball {
  Vec3 center;
  double radius = 0;
};

/// -0 becomes 0, so that equal balls have equal bytes.
inline Ball operator+(const Ball& a, const Ball& b) {
  return {{(a.center.x + b.center.x) + 0.0, (a.center.y + b.center.y) + 0.0, (a.center.z + b.center.z) + 0.0},
          a.radius + b.radius};
}

/// Balls of one of the sets that are close to each other.
struct Bucket {
  std::vector<Ball> balls;
  Ball bound;    // around them all
  Ball largest;  // one of them
};

class Sums {
 public:
  Sums(const Balls& a, const Balls& b);

  std::int64_t pairs() const { return pairs_; }
  /// Of the centers of all sums.
  const Box& box() const { return box_; }

  /// Pairs of a bucket of one set and a bucket of the other.
  std::size_t bucket_pairs() const { return a_.size() * b_.size(); }
  /// Calls visit(bucket of one set, bucket of the other) for the pairs [first, last) of buckets.
  template <class Visit>
  void for_each_bucket(std::size_t first, std::size_t last, Visit visit) const {
    if (first == last) return;
    for (std::size_t i = first / b_.size(), j = first % b_.size(); first < last; ++first) {
      visit(a_[i], b_[j]);
      if (++j == b_.size()) ++i, j = 0;
    }
  }

  /// Calls visit(sum) for all pairs; the progress goes from `begin` to `end`. A pair of balls is as much work
  /// as visiting `work` array elements.
  template <class Visit>
  void for_each(Monitor& monitor, double begin, double end, Visit visit, std::size_t work = 8) const {
    PartMonitor part(monitor, begin, end);
    Lookout look(monitor);
    std::size_t done = 0;
    for_each_bucket(0, bucket_pairs(), [&](const Bucket& one, const Bucket& other) {
      if (look.due(work * one.balls.size() * other.balls.size())) {
        part.step(static_cast<double>(done) / static_cast<double>(bucket_pairs()));
      }
      ++done;
      for (const Ball& a : one.balls) {
        for (const Ball& b : other.balls) visit(a + b);
      }
    });
  }

 private:
  std::vector<Bucket> a_, b_;
  std::int64_t pairs_ = 0;
  Box box_;
};

}  // namespace ballflow::geometry

#include "measure/compare.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "search/box_tree.hpp"
#include "search/surface_chain.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t most_samples = 30'000'000;
constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_spacing(const std::string& what) {
  throw InputError("the spacing needs more than 30 million " + what,
                   "set a larger spacing, or compare fewer balls");
}

/// Counts what is made, in all threads, and ends what was cancelled or takes too much.
class Budget {
 public:
  Budget(Monitor& monitor, const char* what) : monitor_(monitor), what_(what) {}
  void spend(std::int64_t count) {
    if (monitor_.cancelled()) throw Cancelled();
    if ((spent_ += count) <= most_samples) return;
    refuse_spacing(what_);
  }

 private:
  Monitor& monitor_;
  const char* what_;
  std::atomic<std::int64_t> spent_{0};
};

double segment_distance(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double squared = squared_length(ab);
  const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0;
  return distance(p, a + t * ab);
}

/// Degenerate triangles are their edges.
double triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const double squared = squared_length(normal);
  const auto left_of = [&](Vec3 from, Vec3 to) { return dot(cross(to - from, p - from), normal) >= 0; };
  if (squared > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    return std::abs(dot(p - a, normal)) / std::sqrt(squared);
  }
  return std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

/// The union of the balls.
class Union {
 public:
  explicit Union(const Balls& balls) : balls_(balls) {
    tree_ = BoxTree(balls.centers.span());
    tree_.set_slacks(balls.radii);
  }

  /// The smallest |p - c| - r of the balls but `except`, or `limit`; see BoxTree::smallest. Minus how
  /// deep p is in the ball in which it is deepest; outside the union its distance.
  double depth(Vec3 p, double limit = infinity, double enough = -infinity, std::size_t except = none) const {
    return tree_.smallest(p, limit, enough, [&](std::size_t i) {
      return i == except ? infinity : distance(p, balls_.centers[i]) - balls_.radii[i];
    });
  }

  /// Calls visit(j) for all balls that the sphere of ball i may meet.
  template <class Visit>
  void neighbours(std::size_t i, Visit visit) const {
    tree_.below(balls_.centers[i], balls_.radii[i], visit);
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  const Balls& balls_;
  BoxTree tree_;
};

/// The surface: triangles, or points where there are none.
class Surface {
 public:
  Surface(const PointSet& points, const TriangleMesh& mesh) : points_(points.points), mesh_(mesh) {
    if (is_cloud()) {
      tree_ = BoxTree(points_.span());
      return;
    }
    tree_ = BoxTree(boxes_of(mesh.vertices, mesh.triangles));
  }

  bool is_cloud() const { return mesh_.triangles.empty(); }
  std::size_t parts() const { return is_cloud() ? points_.size() : mesh_.triangles.size(); }
  Box box() const { return bounding_box(is_cloud() ? points_.span() : mesh_.vertices.span()); }

  double distance_to(Vec3 p) const {
    return tree_.smallest(p, infinity, -infinity, [&](std::size_t i) {
      if (is_cloud()) return distance(p, points_[i]);
      const auto [a, b, c] = triangle(i);
      return triangle_distance(p, a, b, c);
    });
  }

  /// How many samples `sample` makes in all.
  double samples(double spacing) const {
    if (is_cloud()) return static_cast<double>(parts());
    double count = 0;
    for (std::size_t t = 0; t < parts(); ++t) {
      const double k = parts_of_edge(t, spacing);
      count += k * k;
    }
    return count;
  }

  /// Calls sample(position, area) for the samples of part t, none of whose points is farther than `spacing`
  /// from one. Points have an area of 1.
  template <class Sample>
  void sample(std::size_t t, double spacing, Sample sample) const {
    if (is_cloud()) {
      sample(points_[t], 1.0);
      return;
    }
    const auto [a, b, c] = triangle(t);
    const double parts = parts_of_edge(t, spacing);
    const auto k = static_cast<int>(parts);
    const double area = length(cross(b - a, c - a)) / 2 / (parts * parts);
    const auto at = [&](double i, double j) { return a + (i / parts) * (b - a) + (j / parts) * (c - a); };
    for (int i = 0; i < k; ++i) {
      for (int j = 0; i + j < k; ++j) {
        sample(at(i + 1.0 / 3, j + 1.0 / 3), area);
        if (i + j + 1 < k) sample(at(i + 2.0 / 3, j + 2.0 / 3), area);
      }
    }
  }

 private:
  /// In so many parts every edge of triangle t is split.
  double parts_of_edge(std::size_t t, double spacing) const {
    const auto [a, b, c] = triangle(t);
    const Vec3 centroid = (1.0 / 3) * (a + b + c);
    const double radius = std::max({distance(a, centroid), distance(b, centroid), distance(c, centroid)});
    return std::max(1.0, std::ceil(radius / spacing));
  }
  std::array<Vec3, 3> triangle(std::size_t t) const {
    const Triangle& ids = mesh_.triangles[t];
    return {mesh_.vertices[static_cast<std::size_t>(ids[0])],
            mesh_.vertices[static_cast<std::size_t>(ids[1])],
            mesh_.vertices[static_cast<std::size_t>(ids[2])]};
  }

  const Array<Vec3> points_;
  const TriangleMesh& mesh_;
  BoxTree tree_;
};

/// Samples of the boundary of a union.
struct BoundarySamples {
  std::vector<Vec3> positions;
  std::vector<double> areas;
  std::vector<std::uint8_t> on_boundary;  // 0: up to the spacing inside another ball

  void append(const BoundarySamples& more) {
    positions.insert(positions.end(), more.positions.begin(), more.positions.end());
    areas.insert(areas.end(), more.areas.begin(), more.areas.end());
    on_boundary.insert(on_boundary.end(), more.on_boundary.begin(), more.on_boundary.end());
  }
};

/// Splits the sphere of ball i. A part is compared with the balls alone that reach into the part it was split
/// from.
class SphereSampler {
 public:
  SphereSampler(const Balls& balls, const Union& all, double spacing, double tolerance, Budget& budget,
                Monitor& monitor, std::size_t i, BoundarySamples& samples)
      : all_(all),
        spacing_(spacing),
        tolerance_(tolerance),
        budget_(budget),
        look_(monitor),
        ball_(i),
        center_(balls.centers[i]),
        radius_(balls.radii[i]),
        samples_(samples) {
    if (radius_ == 0) {
      const double depth = all.depth(center_, infinity, -tolerance_, i);
      if (depth >= -tolerance_) add(center_, 0, depth);
      return;
    }
    all.neighbours(i, [&](std::size_t j) {
      // A ball inside this one takes nothing of its sphere. There may be thousands, also equal ones.
      const double between = distance(center_, balls.centers[j]);
      if (j == i || between + balls.radii[j] <= radius_ + tolerance_ / 2) return;
      near_.push_back({balls.centers[j], balls.radii[j]});
    });
    const std::size_t all_near = near_.size();
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) split({x, 0, 0}, {0, y, 0}, {0, 0, z}, 0.5, 0, all_near);
      }
    }
  }

 private:
  /// A triangle of a face |x| + |y| + |z| = 1, which is seen from the centre under about the angle
  /// weight / |centroid|^3. The balls that may contain some of it are in near_[first .. last), the end of
  /// near_.
  void split(Vec3 a, Vec3 b, Vec3 c, double weight, std::size_t first, std::size_t last) {
    if (++patches_ % 256 == 0) budget_.spend(256);
    const Vec3 centroid = (1.0 / 3) * (a + b + c), direction = unit(centroid);
    const double reach = radius_ * std::max({distance(unit(a), direction), distance(unit(b), direction),
                                             distance(unit(c), direction)});
    const Vec3 position = center_ + radius_ * direction;
    const double deep = -reach - tolerance_;
    // Where thousands of balls nearly agree, no list gets shorter: the tree of all balls is then faster.
    const bool large = weight > 0.5 / 64;
    double depth = infinity;
    if (large || last - first <= 256) {
      look_(last - first);
      for (std::size_t k = first; k < last; ++k) {
        const Near other = near_[k];
        const double d = distance(position, other.center) - other.radius;
        depth = std::min(depth, d);
        if (depth < deep) break;  // so the whole part is inside that ball
        if (d < reach + tolerance_) near_.push_back(other);
      }
      first = last;
    } else {
      depth = all_.depth(position, infinity, deep, ball_);
    }
    const std::size_t end = near_.size();
    if (depth >= deep && reach <= spacing_) {
      const double norm = length(centroid);
      add(position, radius_ * radius_ * weight / (norm * norm * norm), depth);
    } else if (depth >= deep) {
      const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      split(a, ab, ca, weight / 4, first, end);
      split(ab, b, bc, weight / 4, first, end);
      split(ca, bc, c, weight / 4, first, end);
      split(ab, bc, ca, weight / 4, first, end);
    }
    near_.resize(last);
  }

  void add(Vec3 position, double area, double depth) {
    samples_.positions.push_back(position);
    samples_.areas.push_back(area);
    samples_.on_boundary.push_back(depth >= -tolerance_ ? 1 : 0);
  }

  static Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

  struct Near {
    Vec3 center;
    double radius;
  };

  const Union& all_;
  double spacing_, tolerance_;
  Budget& budget_;
  Lookout look_;
  std::size_t ball_;
  std::vector<Near> near_;  // a stack: the lists of all parts from the sphere to the one that is split
  Vec3 center_;
  double radius_;
  BoundarySamples& samples_;
  std::int64_t patches_ = 0;
};

/// Runs body(i, result of the block) for i in [0, count), blocks in parallel; returns the results in order.
template <class Result, class Body>
std::vector<Result> by_blocks(std::size_t count, Monitor& monitor, double begin, double end, Body body) {
  constexpr std::size_t block = 64;
  const std::size_t blocks = (count + block - 1) / block;
  std::vector<Result> results(blocks);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(count, (b + 1) * block); ++i) body(i, results[b]);
    monitor.step(begin + (end - begin) * static_cast<double>(++done) / static_cast<double>(blocks));
  });
  return results;
}

BoundarySamples sample_boundary(const Balls& balls, const Union& all, double spacing, double tolerance,
                                Monitor& monitor) {
  Budget budget(monitor, "samples of the boundary of the union");
  BoundarySamples samples;
  const auto parts =
      by_blocks<BoundarySamples>(balls.size(), monitor, 0, 0.3, [&](std::size_t i, BoundarySamples& part) {
        const SphereSampler sampler(balls, all, spacing, tolerance, budget, monitor, i, part);
      });
  for (const BoundarySamples& part : parts) samples.append(part);
  return samples;
}

/// Largest and weighted mean values, summed in a fixed order.
struct Tally {
  std::int64_t count = 0;
  double largest = 0, least_largest = 0, outside = 0, weight = 0, sum = 0, covered = 0;

  void merge(const Tally& more) {
    count += more.count;
    largest = std::max(largest, more.largest);
    least_largest = std::max(least_largest, more.least_largest);
    outside = std::max(outside, more.outside);
    weight += more.weight;
    sum += more.sum;
    covered += more.covered;
  }
};

Tally merged(const std::vector<Tally>& parts) {
  Tally all;
  for (const Tally& part : parts) all.merge(part);
  return all;
}

struct Volume {
  double least = 0, value = 0, most = 0;
};

/// The volume of the union in a cube.
Volume volume_in(const Union& all, Vec3 center, double edge, double spacing, Budget& budget) {
  budget.spend(1);
  const double half_diagonal = edge / 2 * std::sqrt(3.0), volume = edge * edge * edge;
  const double depth = all.depth(center, half_diagonal, -half_diagonal);
  if (depth >= half_diagonal) return {};
  if (depth <= -half_diagonal) return {volume, volume, volume};
  if (edge <= spacing) return {0, volume * std::clamp(0.5 - depth / edge, 0.0, 1.0), volume};
  Volume sum;
  const double quarter = edge / 4;
  for (const double x : {-quarter, quarter}) {
    for (const double y : {-quarter, quarter}) {
      for (const double z : {-quarter, quarter}) {
        const Volume part = volume_in(all, center + Vec3{x, y, z}, edge / 2, spacing, budget);
        sum = {sum.least + part.least, sum.value + part.value, sum.most + part.most};
      }
    }
  }
  return sum;
}

Volume union_volume(const Balls& balls, const Union& all, double spacing, Monitor& monitor) {
  const Box box = bounding_box(balls);
  const double edge = box.longest_edge();
  if (!(edge > 0)) return {};
  Budget budget(monitor, "cubes for the volume");
  constexpr std::size_t split = 8;
  const double part = edge / static_cast<double>(split);
  const auto parts =
      by_blocks<Volume>(split * split * split, monitor, 0.7, 1, [&](std::size_t k, Volume& sum) {
        const Vec3 at{static_cast<double>(k % split) + 0.5, static_cast<double>(k / split % split) + 0.5,
                      static_cast<double>(k / split / split) + 0.5};
        const Volume more = volume_in(all, box.lower + part * at, part, spacing, budget);
        sum = {sum.least + more.least, sum.value + more.value, sum.most + more.most};
      });
  Volume sum;
  for (const Volume& p : parts) sum = {sum.least + p.least, sum.value + p.value, sum.most + p.most};
  return sum;
}

double enclosed_volume(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.vertices[0];
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])] - origin; };
    sum += dot(corner(0), cross(corner(1), corner(2)));
  }
  return std::abs(sum) / 6;
}

ComparedWith kind_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return ComparedWith::cloud;
  return surface_chain(mesh).closed() ? ComparedWith::closed_mesh : ComparedWith::open_mesh;
}

void require_comparable(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                        const CompareOptions& options) {
  if (!(options.spacing > 0 && std::isfinite(options.spacing))) {
    throw InputError("spacing is " + std::to_string(options.spacing), "it is a finite number above 0");
  }
  for (const std::string& broken :
       {broken_invariant(balls), broken_invariant(mesh), broken_invariant(points)}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  if (balls.size() == 0) throw InputError("there are no balls to compare", "connect the balls of a model");
  if (mesh.triangles.empty() && points.points.empty()) {
    throw InputError("there is no surface: neither triangles nor points", "connect a mesh or its samples");
  }
}

}  // namespace

Comparison compare(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                   const CompareOptions& options, Monitor& monitor) {
  require_comparable(balls, points, mesh, options);
  monitor.step(0);
  const Surface surface(points, mesh);
  const Union all(balls);
  const double longest = std::max(surface.box().longest_edge(), bounding_box(balls).longest_edge());
  const double edge = surface.box().longest_edge() > 0 ? surface.box().longest_edge() : longest;
  Comparison result;
  result.spacing = edge > 0 ? options.spacing / 100 * edge : 1;
  const double tolerance = 0x1p-30 * longest;  // of positions on spheres, far above rounding

  if (surface.samples(result.spacing) > static_cast<double>(most_samples))
    refuse_spacing("samples of the surface");

  const BoundarySamples boundary = sample_boundary(balls, all, result.spacing, tolerance, monitor);
  std::vector<Vec3> on_boundary;
  for (std::size_t k = 0; k < boundary.positions.size(); ++k) {
    if (boundary.on_boundary[k] != 0) on_boundary.push_back(boundary.positions[k]);
  }
  if (on_boundary.empty()) {
    throw InputError(
        "no sample lies on the boundary of the union: every ball shows less than the spacing of it",
        "set a smaller spacing");
  }
  const BoxTree boundary_tree(on_boundary);

  const Tally from_surface =
      merged(by_blocks<Tally>(surface.parts(), monitor, 0.3, 0.5, [&](std::size_t t, Tally& tally) {
        surface.sample(t, result.spacing, [&](Vec3 p, double area) {
          if (tally.count % 64 == 63 && monitor.cancelled()) throw Cancelled();
          const double depth = all.depth(p);
          // Inside, the ball in which p is deepest has no boundary of the union in it. Near the centre of a
          // ball all its boundary is about as near: the search may end close above that bound.
          const double enough = -depth + result.spacing / 16;
          const double to_boundary =
              depth >= 0 ? depth : boundary_tree.smallest(p, infinity, enough, [&](std::size_t k) {
                return distance(p, on_boundary[k]);
              });
          tally.merge({1, std::max(to_boundary, std::abs(depth)), std::abs(depth), std::max(depth, 0.0), area,
                       area * to_boundary, depth <= tolerance ? area : 0});
        });
      }));
  const bool has_area =
      std::any_of(balls.radii.begin(), balls.radii.end(), [](double radius) { return radius > 0; });
  const Tally from_union =
      merged(by_blocks<Tally>(boundary.positions.size(), monitor, 0.5, 0.7, [&](std::size_t k, Tally& tally) {
        const double d = surface.distance_to(boundary.positions[k]);
        const bool on = boundary.on_boundary[k] != 0;
        const double area = !on ? 0 : has_area ? boundary.areas[k] : 1;
        tally.merge({1, d, on ? d : 0, 0, area, area * d, 0});
      }));
  const Tally centers =
      merged(by_blocks<Tally>(balls.size(), monitor, 0.7, 0.7, [&](std::size_t i, Tally& tally) {
        tally.largest = std::max(tally.largest, balls.radii[i] - surface.distance_to(balls.centers[i]));
      }));

  const auto mean = [](const Tally& tally) {
    return tally.weight > 0 ? tally.sum / tally.weight : tally.largest;
  };
  result.surface_samples = from_surface.count;
  result.union_samples = from_union.count;
  result.surface_to_union = {from_surface.least_largest, from_surface.largest,
                             from_surface.largest + (surface.is_cloud() ? 0 : result.spacing),
                             mean(from_surface)};
  result.union_to_surface = {from_union.least_largest, from_union.least_largest,
                             from_union.largest + result.spacing, mean(from_union)};
  result.coverage = from_surface.weight > 0 ? std::min(1.0, from_surface.covered / from_surface.weight)
                                            : (from_surface.outside > tolerance ? 0.0 : 1.0);
  result.uncovered = from_surface.outside > tolerance ? from_surface.outside : 0;
  result.protrusion = centers.largest;
  const Volume volume = union_volume(balls, all, result.spacing, monitor);
  result.union_volume = volume.value;
  result.union_volume_at_least = volume.least;
  result.union_volume_at_most = volume.most;
  result.compared_with = static_cast<std::uint8_t>(kind_of(mesh));
  if (!surface.is_cloud()) {
    const MeshTopology topology = mesh_topology(mesh);
    result.surface_encloses = topology.closed && topology.oriented ? 1 : 0;
    if (result.surface_encloses != 0) result.surface_volume = enclosed_volume(mesh);
  }
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry

#include "poles/voronoi_poles.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "poles/voronoi_diagram.hpp"
#include "search/surface_chain.hpp"

namespace ballflow::geometry {
namespace {

using SamplePoles = std::vector<std::array<std::int32_t, 3>>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Calls body(i) for i in [0, count) in blocks on all cores.
template <class Body>
void for_all(std::size_t count, Monitor& monitor, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

// Flags that several threads raise and none lowers.
bool raised(std::uint8_t& flag) { return std::atomic_ref(flag).load(std::memory_order_relaxed) != 0; }
void raise(std::uint8_t& flag) { std::atomic_ref(flag).store(1, std::memory_order_relaxed); }

/// Chooses poles among the Voronoi vertices of every sample.
class Choice {
 public:
  Choice(const VoronoiDiagram& diagram, Monitor& monitor)
      : diagram_(diagram), monitor_(monitor), farthest_(diagram.samples.size(), {-1, -1, -1}) {
    keep_farthest(0, [](std::size_t, std::size_t) { return true; });
    monitor_.step(0.92);
    keep_farthest(1, [this](std::size_t s, std::size_t cell) { return bounded(cell) && is_behind(s, cell); });
    // Only where nothing else is on the other side an unbounded vertex is the second pole: samples of thin
    // sheets.
    std::vector<std::uint8_t> alone(farthest_.size());
    for (std::size_t s = 0; s < alone.size(); ++s) alone[s] = farthest_[s][1] < 0 ? 1 : 0;
    if (std::find(alone.begin(), alone.end(), 1) != alone.end()) {
      keep_farthest(1, [&](std::size_t s, std::size_t cell) { return alone[s] == 1 && is_behind(s, cell); });
    }
    monitor_.step(0.94);
  }

  /// For each sample the cells that stand for its first two poles.
  const SamplePoles& farthest() const { return farthest_; }
  /// Per cell that stands for a Voronoi vertex, 1 for poles and for candidates.
  std::vector<std::uint8_t> poles_and_candidates() const;
  /// Per cell that stands for a Voronoi vertex, 1 for poles and for all that are bounded.
  std::vector<std::uint8_t> poles_and_bounded() const;

 private:
  bool bounded(std::size_t cell) const { return diagram_.unbounded[at(diagram_.vertex[cell])] == 0; }
  /// Whether the vertex of a cell lies behind the first pole of sample s: at an obtuse angle to it.
  bool is_behind(std::size_t s, std::size_t cell) const {
    const Vec3 p = diagram_.samples[s];
    return dot(diagram_.centers[cell] - p, diagram_.centers[at(farthest_[s][0])] - p) < 0;
  }

  /// Whether a sample takes the vertex of cell a before that of cell b, both its own: a total order of the
  /// vertices of one Voronoi cell.
  bool before(std::size_t s, std::int32_t a, std::int32_t b) const {
    const Vec3 p = diagram_.samples[s], u = diagram_.centers[at(a)], v = diagram_.centers[at(b)];
    const double da = squared_distance(u, p), db = squared_distance(v, p);
    if (da != db) return da > db;
    return u != v ? u < v : diagram_.cell_before(a, b);
  }

  /// For each sample the first of the vertices of its cell that accept(sample, cell) takes. Threads race for
  /// it, but the order is total, so that the first one wins whoever comes first.
  template <class Accept>
  void keep_farthest(std::size_t side, const Accept& accept) {
    for_all(diagram_.size(), monitor_, [&](std::size_t cell) {
      const std::int32_t candidate = diagram_.vertex[cell];
      for (const std::int32_t site : diagram_.sites[cell]) {
        if (!diagram_.is_sample(site) || !accept(at(site), cell)) continue;
        const std::atomic_ref best(farthest_[at(site)][side]);
        std::int32_t known = best.load(std::memory_order_relaxed);
        while (known != candidate && (known < 0 || before(at(site), candidate, known))) {
          if (best.compare_exchange_weak(known, candidate, std::memory_order_relaxed)) break;
        }
      }
    });
  }

  const VoronoiDiagram& diagram_;
  Monitor& monitor_;
  SamplePoles farthest_;
};

// The cosine of the angle from which on two poles are opposite. On a smooth surface each pole of an r-sample
// is within 2 arcsin(r / (1 - r)) of a normal [Kornberger 2010, proof of Lemma 4.8], so two poles of a sample
// are more than 139 degrees apart for r <= 0.15; this is the cosine of 138.6.
constexpr double opposite = -0.75;

// Where the poles of a sample are not opposite they may be on one side of the surface, so all bounded
// vertices behind the first are kept.
std::vector<std::uint8_t> Choice::poles_and_candidates() const {
  std::vector<std::uint8_t> kept(diagram_.size(), 0), blunt(farthest_.size(), 0);
  for_all(farthest_.size(), monitor_, [&](std::size_t s) {
    const std::int32_t first = farthest_[s][0], second = farthest_[s][1];
    blunt[s] = 1;
    raise(kept[at(first)]);
    if (second < 0) return;
    raise(kept[at(second)]);
    const Vec3 u = diagram_.centers[at(first)] - diagram_.samples[s];
    const Vec3 v = diagram_.centers[at(second)] - diagram_.samples[s];
    const double product = dot(u, v);  // negative: the second pole is behind the first
    if (product * product >= opposite * opposite * squared_length(u) * squared_length(v)) blunt[s] = 0;
  });
  for_all(diagram_.size(), monitor_, [&](std::size_t cell) {
    std::uint8_t& flag = kept[at(diagram_.vertex[cell])];
    if (!bounded(cell) || raised(flag)) return;
    for (const std::int32_t s : diagram_.sites[cell]) {
      if (diagram_.is_sample(s) && blunt[at(s)] == 1 && is_behind(at(s), cell)) raise(flag);
    }
  });
  return kept;
}

std::vector<std::uint8_t> Choice::poles_and_bounded() const {
  std::vector<std::uint8_t> kept(diagram_.size(), 0);
  for (std::size_t cell = 0; cell < kept.size(); ++cell) {
    if (bounded(cell)) kept[at(diagram_.vertex[cell])] = 1;
  }
  for (const auto& poles : farthest_) {
    for (const std::int32_t pole : poles) {
      if (pole >= 0) kept[at(pole)] = 1;
    }
  }
  return kept;
}

/// The Voronoi vertices that are kept, as a set of poles.
class Collection {
 public:
  Collection(const VoronoiDiagram& diagram, const std::vector<std::uint8_t>& kept, Monitor& monitor)
      : diagram_(diagram), monitor_(monitor), number_(diagram.size(), -1) {
    for (std::size_t cell = 0; cell < kept.size(); ++cell) {
      if (kept[cell] == 0) continue;
      number_[cell] = static_cast<std::int32_t>(cell_of_.size());
      cell_of_.push_back(static_cast<std::int32_t>(cell));
    }
    monitor_.step(0.95);
    collect_sites();
    monitor_.step(0.96);
    sort_by_samples();
    monitor_.step(0.98);
  }

  PoleSet poles(SamplePoles sample_poles) const;

 private:
  /// The samples on the sphere of vertex i, ascending.
  std::span<const std::int32_t> samples_of(std::size_t i) const { return sites_[i].first(samples_[i]); }

  /// The sites of all cells around each vertex, ascending and each once: samples, then far-away points.
  void collect_sites() {
    const std::size_t count = cell_of_.size();
    sites_ = Lists<std::int32_t>(count);
    for (const std::int32_t cell : diagram_.vertex) {
      if (number_[at(cell)] >= 0) sites_.count(at(number_[at(cell)]), 4);
    }
    sites_.allocate();
    for_all(diagram_.size(), monitor_, [&](std::size_t cell) {
      const std::int32_t i = number_[at(diagram_.vertex[cell])];
      if (i < 0) return;
      for (const std::int32_t site : diagram_.sites[cell]) sites_.put_concurrently(at(i), site);
    });
    samples_.resize(count);
    unbounded_.resize(count);
    for_all(count, monitor_, [&](std::size_t i) {
      const std::span<std::int32_t> sites = sites_[i];
      std::sort(sites.begin(), sites.end());
      const auto last = std::unique(sites.begin(), sites.end());
      const auto far = std::find_if(sites.begin(), last, [&](auto s) { return !diagram_.is_sample(s); });
      samples_[i] = static_cast<std::size_t>(far - sites.begin());
      unbounded_[i] = far != last ? 1 : 0;
    });
  }

  /// Orders the vertices by their samples: in buckets of the smallest one, which every vertex has, then
  /// within each bucket.
  void sort_by_samples() {
    Lists<std::int32_t> buckets = lists_of<std::int32_t>(diagram_.samples.size(), [&](auto&& put) {
      for (std::size_t i = 0; i < cell_of_.size(); ++i) put(at(sites_[i][0]), static_cast<std::int32_t>(i));
    });
    for_all(buckets.size(), monitor_, [&](std::size_t s) {
      const std::span<std::int32_t> bucket = buckets[s];
      std::sort(bucket.begin(), bucket.end(), [&](auto a, auto b) { return before(at(a), at(b)); });
    });
    order_.reserve(cell_of_.size());
    for (std::size_t s = 0; s < buckets.size(); ++s) {
      const std::span<const std::int32_t> bucket = buckets[s];
      order_.insert(order_.end(), bucket.begin(), bucket.end());
    }
  }
  bool before(std::size_t a, std::size_t b) const {
    const auto u = samples_of(a), v = samples_of(b);
    const auto [ka, kb] = std::mismatch(u.begin(), u.end(), v.begin(), v.end());
    if (ka != u.end() && kb != v.end()) return *ka < *kb;
    if ((ka == u.end()) != (kb == v.end())) return ka == u.end();
    // Both ends of a Voronoi edge that leads to far-away points on both sides.
    const Vec3 p = diagram_.centers[at(cell_of_[a])], q = diagram_.centers[at(cell_of_[b])];
    return p != q ? p < q : diagram_.cell_before(cell_of_[a], cell_of_[b]);
  }

  const VoronoiDiagram& diagram_;
  Monitor& monitor_;
  std::vector<std::int32_t> number_;   // per cell that stands for a vertex that is kept; else -1
  std::vector<std::int32_t> cell_of_;  // the inverse
  Lists<std::int32_t> sites_;
  std::vector<std::size_t> samples_;  // how many of its sites are samples
  std::vector<std::uint8_t> unbounded_;
  std::vector<std::int32_t> order_;
};

PoleSet Collection::poles(SamplePoles sample_poles) const {
  const std::size_t count = order_.size();
  std::vector<std::int32_t> rank(count);
  std::vector<std::int64_t> offsets(count + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    rank[at(order_[i])] = static_cast<std::int32_t>(i);
    offsets[i + 1] = offsets[i] + static_cast<std::int64_t>(samples_[at(order_[i])]);
  }
  std::vector<Vec3> centers(count);
  std::vector<double> radii(count);
  std::vector<std::uint8_t> unbounded(count);
  std::vector<std::int32_t> defining(static_cast<std::size_t>(offsets[count]));
  for_all(count, monitor_, [&](std::size_t i) {
    const std::size_t pole = at(order_[i]);
    centers[i] = diagram_.centers[at(cell_of_[pole])];
    unbounded[i] = unbounded_[pole];
    double greatest = 0;
    for (const std::int32_t s : samples_of(pole)) {
      greatest = std::max(greatest, squared_distance(centers[i], diagram_.samples[at(s)]));
    }
    radii[i] = std::sqrt(greatest);
    const auto own = samples_of(pole);
    std::copy(own.begin(), own.end(), defining.begin() + offsets[i]);
  });
  for_all(sample_poles.size(), monitor_, [&](std::size_t s) {
    for (std::int32_t& cell : sample_poles[s]) cell = cell < 0 ? -1 : rank[at(number_[at(cell)])];
  });

  PoleSet result;
  result.centers = std::move(centers);
  result.radii = std::move(radii);
  result.labels = std::vector<std::uint8_t>(count, static_cast<std::uint8_t>(PoleLabel::unlabelled));
  result.defining_offsets = std::move(offsets);
  result.defining_samples = std::move(defining);
  result.unbounded = std::move(unbounded);
  result.sample_poles = std::move(sample_poles);
  return result;
}

}  // namespace

PoleSet voronoi_poles(const PointSet& sample, const VoronoiPolesOptions& options, Monitor& monitor) {
  if (!(options.bounding_distance >= 4 && options.bounding_distance <= 1e6)) {
    throw InputError("bounding_distance is " + std::to_string(options.bounding_distance),
                     "use a distance from 4 to 1e6 bounding-box edges; the default is 10");
  }
  const VoronoiDiagram diagram = voronoi_diagram(sample, options.bounding_distance, monitor);
  const Choice choice(diagram, monitor);
  const auto kept =
      options.vertices == Vertices::all ? choice.poles_and_bounded() : choice.poles_and_candidates();
  return Collection(diagram, kept, monitor).poles(choice.farthest());
}

Vertices decide(Vertices vertices, const TriangleMesh& mesh) {
  if (vertices != Vertices::automatic) return vertices;
  return surface_chain(mesh).closed() ? Vertices::all : Vertices::poles;
}

}  // namespace ballflow::geometry

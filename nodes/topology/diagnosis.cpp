#include "topology/diagnosis.hpp"

#include <algorithm>
#include <array>

#include "base/disjoint_sets.hpp"
#include "homology/binary_system.hpp"

namespace ballflow::geometry {
namespace {

using Ids = Diagnosis::Ids;
using Class = std::vector<std::int32_t>;  // an element of a vector space over Z/2: ascending basis numbers

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// A subspace of a vector space over Z/2.
class Span {
 public:
  /// What is left of `c` modulo the space; empty when it belongs to it.
  Class reduced(Class c) const {
    Class rest;
    while (!c.empty()) {
      const auto pivot = by_pivot_.find(c.back());
      if (pivot != by_pivot_.end()) {
        c = binary_sum(c, pivot->second);
      } else {
        rest.push_back(c.back());
        c.pop_back();
      }
    }
    std::reverse(rest.begin(), rest.end());
    return rest;
  }
  bool add(const Class& c) {
    Class rest = reduced(c);
    if (rest.empty()) return false;
    const std::int32_t pivot = rest.back();
    by_pivot_.emplace(pivot, std::move(rest));
    return true;
  }

 private:
  std::map<std::int32_t, Class> by_pivot_;
};

/// Where to begin when balls are to be returned.
struct Seeds {
  Diagnosis::Place place;
  Ids balls;  // vertices of K+, most promising first
};

}  // namespace

class Diagnosis::Search {
 public:
  Search(const UnionOfBalls& whole, std::span<const std::int32_t> kept, const Inclusion& inclusion,
         Monitor& monitor)
      : whole_(whole), inclusion_(inclusion), monitor_(monitor), kept_(whole.balls().size()) {
    for (const std::int32_t id : kept) kept_[at(id)] = true;
  }

  Ids for_components() {
    Ids result;
    const auto& image = inclusion_.component_image();
    std::vector<std::int32_t> parts(at(whole_.loops().components()));
    for (const std::int32_t c : image) ++parts[at(c)];
    std::vector<std::int32_t> largest(parts.size(), -1);
    for (const std::int32_t v : whole_.complex().vertices) {
      std::int32_t& best = largest[at(whole_.loops().component(v))];
      if (best < 0 || whole_.complex().weights[at(v)] > whole_.complex().weights[at(best)]) best = v;
    }
    for (std::size_t c = 0; c < parts.size(); ++c) {
      if (parts[c] == 0) result.push_back(largest[c]);
    }
    if (std::all_of(parts.begin(), parts.end(), [](std::int32_t n) { return n <= 1; })) return result;
    reach();
    DisjointSets matched(image.size());
    for (const Bridge& bridge :
         bridges([&](std::int32_t u, std::int32_t v) { return part_[at(u)] != part_[at(v)]; })) {
      if (matched.join(part_[at(bridge.u)], part_[at(bridge.v)])) take_path(bridge, result);
    }
    return result;
  }

  Ids for_lost_loops() {
    Ids result;
    const InclusionHomology& h = inclusion_.homology();
    if (h.rank[1] == h.whole[1]) return result;
    reach();
    Span image;
    for (const Class& c : inclusion_.loop_image()) image.add(c);
    // The class of the loop: from the root of the component through U* to the ball nearest to u, on to u, to
    // v, and back.
    const std::vector<Class> in_part = potentials_in_part();
    std::vector<Class> potential(kept_.size());
    for (const std::int32_t v : order_) {
      potential[at(v)] = before_[at(v)] < 0 ? in_part[at(source_[at(v)])]
                                            : binary_sum(potential[at(before_[at(v)])],
                                                         whole_.loops().on_edge(before_[at(v)], v));
      potential[at(v)] = image.reduced(std::move(potential[at(v)]));
    }
    const auto loop = [&](std::int32_t u, std::int32_t v) {
      return image.reduced(
          binary_sum(binary_sum(potential[at(u)], potential[at(v)]), whole_.loops().on_edge(u, v)));
    };
    for (const Bridge& bridge :
         bridges([&](std::int32_t u, std::int32_t v) { return !loop(u, v).empty(); })) {
      if (!image.add(loop(bridge.u, bridge.v))) continue;
      take_path(bridge, result);
    }
    return result;
  }

  Ids for_filled(std::map<Place, std::size_t>& efforts, std::size_t effort) {
    Ids result;
    std::vector<Seeds> all = seeds_of_loops();
    const std::vector<Seeds> voids = seeds_of_voids();
    all.insert(all.end(), voids.begin(), voids.end());
    std::map<Place, std::size_t> now;
    for (const Seeds& seeds : all) {
      const auto before = efforts.find(seeds.place);
      std::size_t& count = now[seeds.place];
      count = std::max({count, effort, before == efforts.end() ? 1 : 2 * before->second});
      take_around(seeds.balls, count, result);
    }
    efforts = std::move(now);
    return result;
  }

 private:
  struct Bridge {
    std::int32_t cost, u, v;
  };

  /// Breadth first from the kept balls through K+: how many balls are missing on the way to a vertex.
  void reach() {
    if (!order_.empty()) return;
    const std::size_t n = kept_.size();
    cost_.assign(n, -1);
    before_.assign(n, -1);
    part_.assign(n, -1);
    source_.assign(n, -1);
    const UnionOfBalls& part = inclusion_.part();
    Ids queue, next;
    const auto enter = [&](std::int32_t v, std::int32_t cost, Ids& where) {
      cost_[at(v)] = cost;
      where.push_back(v);
    };
    for (const bool itself : {true, false}) {  // kept balls before those that only lie around a kept centre
      for (const std::int32_t i : part.complex().vertices) {
        const std::int32_t v = whole_.vertex_at(inclusion_.id(i));
        if (kept_[at(v)] != itself || cost_[at(v)] >= 0) continue;
        part_[at(v)] = part.loops().component(i);
        source_[at(v)] = i;
        enter(v, itself ? 0 : 1, itself ? queue : next);
      }
    }
    for (std::int32_t cost = 0; !queue.empty() || !next.empty(); ++cost) {
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::int32_t u = queue[i];
        order_.push_back(u);
        for (const std::int32_t v : whole_.loops().around(u)) {
          if (cost_[at(v)] >= 0) continue;
          before_[at(v)] = u;
          part_[at(v)] = part_[at(u)];
          source_[at(v)] = source_[at(u)];
          const bool free = kept_[at(v)];
          enter(v, cost + (free ? 0 : 1), free ? queue : next);
        }
      }
      queue = std::exchange(next, {});
    }
  }

  /// Edges of K+ that a condition selects, fewest missing balls first.
  template <class Condition>
  std::vector<Bridge> bridges(const Condition& condition) {
    std::vector<Bridge> list;
    Lookout look(monitor_);
    for (const auto& [u, v] : whole_.complex().edges) {
      look(16);
      if (cost_[at(u)] < 0 || cost_[at(v)] < 0 || !condition(u, v)) continue;
      list.push_back({cost_[at(u)] + cost_[at(v)], u, v});
    }
    std::sort(list.begin(), list.end(), [](const Bridge& a, const Bridge& b) {
      return std::array{a.cost, a.u, a.v} < std::array{b.cost, b.u, b.v};
    });
    return list;
  }

  void take_path(const Bridge& bridge, Ids& result) const {
    for (std::int32_t v : {bridge.u, bridge.v}) {
      for (; v >= 0; v = before_[at(v)]) {
        if (!kept_[at(v)]) result.push_back(v);
      }
    }
  }

  /// Per vertex of K*: the class of the path from the root of its component to it, along its forest.
  std::vector<Class> potentials_in_part() const {
    const FirstHomology& loops = inclusion_.part().loops();
    std::vector<Class> potential(inclusion_.part().balls().size());
    for (const std::int32_t v : loops.outwards()) {
      monitor_.step(0.5);
      const std::int32_t u = loops.parent(v);
      if (u >= 0) potential[at(v)] = binary_sum(potential[at(u)], inclusion_.along_edge(u, v));
    }
    return potential;
  }

  /// Short loops of K* that generate what U+ has filled, each as a place to begin at: the ball around its
  /// middle, then the balls that it passes.
  std::vector<Seeds> seeds_of_loops() const {
    const InclusionHomology& h = inclusion_.homology();
    const std::int64_t wanted = h.part[1] - h.rank[1];
    if (wanted == 0) return {};
    const FirstHomology& loops = inclusion_.part().loops();
    const auto image_of = [&](const Class& c) {
      Class sum;
      for (const std::int32_t k : c) sum = binary_sum(sum, inclusion_.loop_image()[at(k)]);
      return sum;
    };
    // Vertices on loops that are filled: eliminate images, keeping track of the loops.
    std::map<std::int32_t, std::pair<Class, Class>> by_pivot;
    Ids roots;
    std::vector<Class> kernel;
    for (std::int32_t k = 0; at(k) < loops.dimension(); ++k) {
      Class image = inclusion_.loop_image()[at(k)], sum{k};
      while (!image.empty()) {
        const auto pivot = by_pivot.find(image.back());
        if (pivot == by_pivot.end()) break;
        sum = binary_sum(sum, pivot->second.second);
        image = binary_sum(image, pivot->second.first);
      }
      if (!image.empty()) {
        const std::int32_t pivot = image.back();
        by_pivot.emplace(pivot, std::pair(image, sum));
        continue;
      }
      for (const std::int32_t i : sum) {
        const Ids loop = loops.loop(at(i));
        roots.insert(roots.end(), loop.begin(), loop.end());
      }
      kernel.push_back(std::move(sum));
    }
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());

    // Shortest loops through some of these vertices.
    std::vector<std::pair<Ids, Class>> found;
    constexpr std::size_t most_roots = 256;
    const std::size_t stride = roots.size() / most_roots + 1;
    for (std::size_t i = 0; i < roots.size(); i += stride) {
      monitor_.step(0.5);
      shortest_loops(roots[i], image_of, found);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.first.size() != b.first.size() ? a.first.size() < b.first.size() : a.first < b.first;
    });
    for (const Class& c : kernel) {  // in case that the short ones do not generate all
      Ids all;
      for (const std::int32_t i : c) {
        const Ids loop = loops.loop(at(i));
        all.insert(all.end(), loop.begin(), loop.end());
      }
      found.emplace_back(all, c);
    }
    Span filled;
    std::vector<Seeds> result;
    for (const auto& [loop, c] : found) {
      if (!filled.add(c)) continue;
      Vec3 sum;
      for (const std::int32_t v : loop) sum = sum + inclusion_.part().balls().centers[at(v)];
      const Vec3 middle = 1 / static_cast<double>(loop.size()) * sum;
      const std::int32_t start = whole_.vertex_at(inclusion_.id(loop[0]));
      const std::int32_t nearest = whole_.walk().cell_of(middle, start);
      Ids seeds;
      if (!whole_.walk().outside(middle, nearest)) seeds.push_back(nearest);
      for (const std::int32_t v : loop) seeds.push_back(whole_.vertex_at(inclusion_.id(v)));
      const std::int32_t first = *std::min_element(loop.begin(), loop.end());
      result.push_back({{0, inclusion_.id(first)}, std::move(seeds)});
    }
    return result;
  }

  /// The shortest loop of K* through a root that is no boundary in U* but one in U+, if there is one.
  template <class Image>
  void shortest_loops(std::int32_t root, const Image& image_of,
                      std::vector<std::pair<Ids, Class>>& found) const {
    const FirstHomology& loops = inclusion_.part().loops();
    struct Reached {
      std::int32_t from, depth;
      Class potential;
    };
    std::map<std::int32_t, Reached> reached{{root, {-1, 0, {}}}};
    Ids queue{root};
    std::int32_t shortest = -1;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::int32_t u = queue[i];
      const Reached& here = reached.at(u);
      if (shortest >= 0 && 2 * here.depth + 1 > shortest) break;
      for (const std::int32_t v : loops.around(u)) {
        if (v == here.from) continue;
        Class potential = binary_sum(here.potential, loops.on_edge(u, v));
        const auto other = reached.find(v);
        if (other == reached.end()) {
          reached.emplace(v, Reached{u, here.depth + 1, std::move(potential)});
          queue.push_back(v);
          continue;
        }
        const Class c = binary_sum(potential, other->second.potential);
        if (c.empty() || !image_of(c).empty()) continue;
        const std::int32_t length = here.depth + other->second.depth + 1;
        if (shortest >= 0 && length >= shortest) continue;
        shortest = length;
        Ids loop;
        for (std::int32_t w = u; w >= 0; w = reached.at(w).from) loop.push_back(w);
        std::reverse(loop.begin(), loop.end());
        for (std::int32_t w = v; w != root; w = reached.at(w).from) loop.push_back(w);
        found.emplace_back(std::move(loop), c);
      }
    }
  }

  /// Voids of U* that hold no void of U+, or several.
  std::vector<Seeds> seeds_of_voids() const {
    const InclusionHomology& h = inclusion_.homology();
    if (h.rank[2] == h.part[2] && h.rank[2] == h.whole[2]) return {};
    const Voids& voids = inclusion_.part().voids();
    std::vector<std::vector<Voids::Place>> held(at(voids.count()));
    for (const Voids::Place& place : inclusion_.void_image()) held[at(place.number)].push_back(place);
    std::vector<Seeds> result;
    const auto add = [&](int kind, const std::vector<Voids::Cell>& cells) {
      const std::int32_t ball = cells.empty() ? 0 : inclusion_.id(cells.back()[0]);
      result.push_back({{kind, ball}, covered_corners(cells)});
    };
    for (std::int32_t v = 0; v < voids.count(); ++v) {
      const std::vector<Voids::Place>& places = held[at(v)];
      if (places.empty()) add(1, voids.cells_of(v));
      // Whatever separates two voids of U+ crosses the way between them.
      for (std::size_t i = 1; i < places.size(); ++i) {
        add(2, voids.between(places[i], places[0]));
      }
    }
    return result;
  }

  /// Balls of U+ that cover corners of U* in some of its cells, deepest first, then those around the cells.
  Ids covered_corners(const std::vector<Voids::Cell>& cells) const {
    std::vector<std::pair<double, std::int32_t>> covered;
    Ids seeds;
    for (const Voids::Cell& cell : cells) {
      monitor_.step(0.5);
      const PowerVertex corner = power_vertex(inclusion_.part().complex(), cell);
      if (!is_finite(corner.point)) continue;
      const std::int32_t ball = whole_.walk().cell_of(corner.point, whole_.vertex_at(inclusion_.id(cell[0])));
      if (!kept_[at(ball)] && !whole_.walk().outside(corner.point, ball)) {
        covered.emplace_back(-corner.power, ball);
      }
    }
    std::sort(covered.begin(), covered.end());
    for (const auto& [depth, ball] : covered) seeds.push_back(ball);
    for (const Voids::Cell& cell : cells) {
      for (const std::int32_t i : cell) seeds.push_back(whole_.vertex_at(inclusion_.id(i)));
    }
    return seeds;
  }

  /// The first `count` balls that are not kept, breadth first through K+ from the seeds.
  void take_around(const Ids& seeds, std::size_t count, Ids& result) const {
    std::vector<bool> seen(kept_.size());
    Ids queue;
    for (const std::int32_t v : seeds) {
      if (!seen[at(v)]) queue.push_back(v);
      seen[at(v)] = true;
    }
    for (std::size_t i = 0; i < queue.size() && count > 0; ++i) {
      const std::int32_t u = queue[i];
      if (!kept_[at(u)]) {
        result.push_back(u);
        --count;
      }
      for (const std::int32_t v : whole_.loops().around(u)) {
        if (!seen[at(v)]) queue.push_back(v);
        seen[at(v)] = true;
      }
    }
  }

  const UnionOfBalls& whole_;
  const Inclusion& inclusion_;
  Monitor& monitor_;
  std::vector<bool> kept_;
  Ids order_;   // vertices as reach() met them
  Ids cost_;    // per vertex: balls to be returned on the path to it, -1 where none leads
  Ids before_;  // the vertex before it on the path, -1 at kept balls
  Ids part_;    // component of U* where the path begins
  Ids source_;  // ball of the part where the path begins
};

Diagnosis::Diagnosis(const UnionOfBalls& whole, std::span<const std::int32_t> kept,
                     const Inclusion& inclusion, Monitor& monitor)
    : search_(std::make_unique<Search>(whole, kept, inclusion, monitor)) {}
Diagnosis::~Diagnosis() = default;

Ids Diagnosis::for_components() { return search_->for_components(); }
Ids Diagnosis::for_lost_loops() { return search_->for_lost_loops(); }
Ids Diagnosis::for_filled(std::map<Place, std::size_t>& efforts, std::size_t effort) {
  return search_->for_filled(efforts, effort);
}

}  // namespace ballflow::geometry

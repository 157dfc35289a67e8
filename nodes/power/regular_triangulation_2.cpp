#include "power/regular_triangulation_2.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Weighted_point_2 weighted(const PlaneSite& s) {
  return {Kernel::Point_2(s.center.x, s.center.y), s.weight};
}

bool is_ordinary(const PlaneSite& s) {
  return std::abs(s.center.x) <= 1e60 && std::abs(s.center.y) <= 1e60 && s.weight <= 1e120;
}

/// Whether t has a negative power to the circle orthogonal to a, b and c, which are counter-clockwise.
bool inside_power_circle(const PlaneSite& a, const PlaneSite& b, const PlaneSite& c, const PlaneSite& t,
                         bool ordinary) {
  if (ordinary) {
    struct Row {
      double x, y, z, size;
    };
    const auto row = [&t](const PlaneSite& p) {
      const double x = p.center.x - t.center.x, y = p.center.y - t.center.y, d = x * x + y * y;
      return Row{x, y, d + (t.weight - p.weight), d + t.weight + p.weight};
    };
    const Row p = row(a), q = row(b), r = row(c);
    const double qr1 = q.x * r.y, qr2 = q.y * r.x, rp1 = r.x * p.y, rp2 = r.y * p.x, pq1 = p.x * q.y,
                 pq2 = p.y * q.x;
    const double value = p.z * (qr1 - qr2) + q.z * (rp1 - rp2) + r.z * (pq1 - pq2);
    const double size = p.size * (std::abs(qr1) + std::abs(qr2)) + q.size * (std::abs(rp1) + std::abs(rp2)) +
                        r.size * (std::abs(pq1) + std::abs(pq2));
    // Of each product of three at most 15 roundings, of the size at most as many: below 2^-48 together. What
    // underflows is less than 1e-200 with the magnitudes of ordinary sites.
    const double error = 0x1p-48 * size;
    if (size > 1e-180 && std::abs(value) > error) return value > 0;
  }
  return CGAL::power_side_of_oriented_power_circle(weighted(a), weighted(b), weighted(c), weighted(t)) ==
         CGAL::ON_POSITIVE_SIDE;
}

}  // namespace

int orientation(Vec2 a, Vec2 b, Vec2 c) {
  // Six roundings, and as many in the size; what underflows is below 1e-290. The walks live on this filter.
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x), value = left - right;
  const double size = std::abs(left) + std::abs(right);
  if (size > 1e-280 && std::abs(value) > 0x1p-49 * size) return value > 0 ? 1 : -1;
  return CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y));
}

RegularTriangulation2::RegularTriangulation2(const PlaneSite& a, const PlaneSite& b, const PlaneSite& c)
    : sites_{a, b, c}, first_(4), seen_(4) {
  ordinary_ = is_ordinary(a) && is_ordinary(b) && is_ordinary(c);
  const bool left = orientation(a.center, b.center, c.center) > 0;
  const std::int32_t second = left ? 1 : 2, third = left ? 2 : 1;
  triangles_ = {{{0, second, third}, {1, 2, 3}},
                {{infinite, third, second}, {0, 3, 2}},
                {{infinite, 0, third}, {0, 1, 3}},
                {{infinite, second, 0}, {0, 2, 1}}};
}

bool RegularTriangulation2::conflicts(std::int32_t triangle, const PlaneSite& site) const {
  const Triangle& t = at(triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    if (t.vertices[i] != infinite) continue;
    const int side =
        orientation(sites_[static_cast<std::size_t>(t.vertices[(i + 1) % 3])].center,
                    sites_[static_cast<std::size_t>(t.vertices[(i + 2) % 3])].center, site.center);
    // On the line of the edge both triangles at it have the same circle.
    return side != 0 ? side > 0 : conflicts(t.neighbours[i], site);
  }
  return inside_power_circle(this->site(t.vertices[0]), this->site(t.vertices[1]), this->site(t.vertices[2]),
                             site, ordinary_);
}

std::int32_t RegularTriangulation2::walk(Vec2 p) {
  std::int32_t here = hint_, from = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (at(here).vertices[i] == infinite) {
      here = at(here).neighbours[i];
      break;
    }
  }
  for (;;) {
    const Triangle& t = at(here);
    std::int32_t next = -1;
    for (std::size_t i = 0; i < 3 && next < 0; ++i) {
      if (t.neighbours[i] == from) continue;
      if (orientation(site(t.vertices[(i + 1) % 3]).center, site(t.vertices[(i + 2) % 3]).center, p) < 0)
        next = t.neighbours[i];
    }
    if (next < 0) break;
    from = here;
    here = next;
    const auto& v = at(here).vertices;
    if (v[0] == infinite || v[1] == infinite || v[2] == infinite) break;
  }
  return hint_ = here;
}

const RegularTriangulation2::Triangle& RegularTriangulation2::locate(Vec2 p) { return at(walk(p)); }

bool RegularTriangulation2::find_cavity(const PlaneSite& site) {
  cavity_.clear();
  sides_.clear();
  const std::int32_t begin = walk(site.center);
  if (!conflicts(begin, site)) return false;
  ++round_;
  if (round_ == 0x7fffffffu) {  // marks begin anew
    std::fill(seen_.begin(), seen_.end(), 0);
    round_ = 1;
  }
  const std::uint32_t outside = 2 * round_, inside = outside + 1;
  cavity_.push_back(begin);
  seen_[static_cast<std::size_t>(begin)] = inside;
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Triangle t = at(cavity_[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t other = t.neighbours[i];
      std::uint32_t& seen = seen_[static_cast<std::size_t>(other)];
      if (seen != outside && seen != inside) {
        seen = conflicts(other, site) ? inside : outside;
        if (seen == inside) cavity_.push_back(other);
      }
      if (seen == outside) sides_.push_back({other, t.vertices[(i + 1) % 3], t.vertices[(i + 2) % 3]});
    }
  }
  return true;
}

bool RegularTriangulation2::neighbours(const PlaneSite& site, std::vector<std::int32_t>& found) {
  found.clear();
  const bool ordinary = ordinary_;
  ordinary_ = ordinary_ && is_ordinary(site);
  const bool has_cell = find_cavity(site);
  ordinary_ = ordinary;
  for (const Side& side : sides_) {
    if (side.a != infinite) found.push_back(side.a);
  }
  return has_cell;
}

std::int32_t RegularTriangulation2::new_triangle() {
  if (!free_.empty()) {
    const std::int32_t i = free_.back();
    free_.pop_back();
    return i;
  }
  const std::int32_t i = index_of(triangles_.size(), "triangles of sums of discs");
  triangles_.emplace_back();
  seen_.push_back(0);
  return i;
}

std::int32_t RegularTriangulation2::insert(const PlaneSite& site) {
  ordinary_ = ordinary_ && is_ordinary(site);
  if (!find_cavity(site)) return hidden;
  const std::int32_t vertex = index_of(sites_.size(), "sums of discs");
  sites_.push_back(site);
  first_.push_back(0);
  free_.insert(free_.end(), cavity_.begin(), cavity_.end());
  for (const Side& side : sides_) {
    const std::int32_t fresh = new_triangle();
    at(fresh) = {{vertex, side.a, side.b}, {side.outer, -1, -1}};
    Triangle& outer = at(side.outer);
    for (std::size_t i = 0; i < 3; ++i) {
      if (outer.vertices[(i + 1) % 3] == side.b && outer.vertices[(i + 2) % 3] == side.a)
        outer.neighbours[i] = fresh;
    }
    first_at(side.a) = fresh;
    hint_ = fresh;
  }
  for (const Side& side : sides_) {
    const std::int32_t here = first_at(side.a), next = first_at(side.b);
    at(here).neighbours[1] = next;
    at(next).neighbours[2] = here;
  }
  return vertex;
}

std::vector<RegularTriangulation2::Triangle> RegularTriangulation2::take_triangles() {
  std::vector<std::int32_t> number(triangles_.size(), 0);
  for (const std::int32_t i : free_) number[static_cast<std::size_t>(i)] = -1;
  std::int32_t count = 0;
  for (std::int32_t& i : number) {
    if (i >= 0) i = count++;
  }
  std::vector<Triangle> result;
  result.reserve(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (number[i] < 0) continue;
    result.push_back(triangles_[i]);
    for (std::int32_t& other : result.back().neighbours) other = number[static_cast<std::size_t>(other)];
  }
  triangles_.clear();
  free_.clear();
  return result;
}

PlaneLinks::PlaneLinks(std::span<const RegularTriangulation2::Triangle> triangles, std::size_t vertices)
    : begins_(vertices + 1) {
  // Around a vertex every neighbour is the next corner of one triangle.
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  for (const auto& t : triangles) {
    for (const std::int32_t v : t.vertices) {
      if (v >= 0) ++begins_[at(v) + 1];
    }
  }
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  neighbours_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (t.vertices[i] >= 0) neighbours_[next[at(t.vertices[i])]++] = t.vertices[(i + 1) % 3];
    }
  }
}

}  // namespace ballflow::geometry

#include "show/picture/ray_caster.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "show/picture/embree.hpp"

namespace ballflow::show {
namespace {

using geometry::Vec3;

// What Embree computes in single precision may be off by less than this.
constexpr double slack = 2e-5;

enum Kind : std::uint32_t { clusters, capsules, triangles };

enum class Question { nearest, blocked, all };

/// What one call asks, and what it has found so far. Embree hands it on to the functions below.
struct Query {
  RTCIntersectContext context;  // first: Embree knows only this part
  Question question = Question::nearest;
  Ray ray;
  Interval interval;
  bool found = false;
  Hit best;
  std::vector<Hit>* hits = nullptr;
};

void add_to(Query& query, const Hit& hit) {
  if (query.question == Question::all) {
    query.hits->push_back(hit);
  } else if (!query.found || hit < query.best) {
    query.found = true;
    query.best = hit;
  }
}

void look_at(Query& query, std::uint32_t number, const Ball& ball) {
  const auto part = inside(query.ray, ball);
  const Interval& interval = query.interval;
  if (!part || part->lower > interval.upper || part->upper < interval.lower) return;
  if (part->lower >= interval.lower) {
    add_to(query, {part->lower, 0, number, false});
  } else if (query.question != Question::blocked) {
    const Vec3 from_center = query.ray.at(interval.lower) - ball.center;
    const double power = geometry::squared_length(from_center) - ball.radius * ball.radius;
    add_to(query, {interval.lower, std::min(power, 0.0), number, false});
  }
  if (query.question == Question::all && part->upper <= interval.upper) {
    add_to(query, {part->upper, 0, number, true});
  }
}

void look_at(Query& query, std::uint32_t number, const Capsule& capsule) {
  const auto t = entry(query.ray, capsule);
  if (t && *t >= query.interval.lower && *t <= query.interval.upper) add_to(query, {*t, 0, number, false});
}

void look_at(Query& query, std::uint32_t number, const Triangle3& triangle) {
  const auto hit = meeting(query.ray, triangle);
  if (hit && hit->t >= query.interval.lower && hit->t <= query.interval.upper) {
    add_to(query, {hit->t, 0, number, false});
  }
}

RTCBounds padded(Vec3 lower, Vec3 upper) {
  const auto down = [](double v) { return static_cast<float>(v - slack); };
  const auto up = [](double v) { return static_cast<float>(v + slack); };
  return {down(lower.x), down(lower.y), down(lower.z), 0, up(upper.x), up(upper.y), up(upper.z), 0};
}

RTCBounds bounds(const Capsule& capsule) {
  const Vec3 r{capsule.radius, capsule.radius, capsule.radius};
  geometry::Box box;
  box.add(capsule.a);
  box.add(capsule.b);
  return padded(box.lower - r, box.upper + r);
}

RTCBounds bounds(const Triangle3& triangle) {
  geometry::Box box;
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) box.add(corner);
  return padded(box.lower, box.upper);
}

/// Eight balls like each other, which are looked at together: inner polar balls overlap so much that a ray
/// meets the boxes of hundreds. Places that are left over hold balls far away.
struct Cluster {
  static constexpr std::size_t size = 8;
  std::array<float, size> x, y, z, radius;
  std::array<std::uint32_t, size> balls;
};

/// Marks the balls that the query may meet, in single precision and so with slack: those of which neither the
/// line misses the ball, nor the ray begins behind it, nor ends before it.
std::array<std::uint32_t, Cluster::size> candidates(const Cluster& cluster, Vec3 begin, Vec3 direction,
                                                    double length) {
  constexpr auto pad = static_cast<float>(slack);
  const auto bx = static_cast<float>(begin.x), by = static_cast<float>(begin.y),
             bz = static_cast<float>(begin.z);
  const auto dx = static_cast<float>(direction.x), dy = static_cast<float>(direction.y),
             dz = static_cast<float>(direction.z);
  const float end = static_cast<float>(length) + pad;
  std::array<std::uint32_t, Cluster::size> marks;
  for (std::size_t i = 0; i < Cluster::size; ++i) {
    const float cx = cluster.x[i] - bx, cy = cluster.y[i] - by, cz = cluster.z[i] - bz;
    const float middle = cx * dx + cy * dy + cz * dz;
    const float ox = cx - middle * dx, oy = cy - middle * dy, oz = cz - middle * dz;
    const float r = cluster.radius[i] + pad;
    const std::uint32_t near = ox * ox + oy * oy + oz * oz <= r * r;
    const std::uint32_t ahead = middle >= 0;
    const std::uint32_t around = cx * cx + cy * cy + cz * cz <= r * r + pad;
    const std::uint32_t before_end = middle - r <= end;
    marks[i] = near & (ahead | around) & before_end;
  }
  return marks;
}

/// Splits balls [begin, end) of `order` where positions or radii differ most, until clusters are full.
void cluster(const std::vector<Ball>& balls, std::uint32_t* begin, std::uint32_t* end,
             std::vector<Cluster>& clusters) {
  const auto count = static_cast<std::size_t>(end - begin);
  if (count <= Cluster::size) {
    Cluster full;
    full.x.fill(1e6F);
    full.y.fill(1e6F);
    full.z.fill(1e6F);
    full.radius.fill(0);
    full.balls.fill(begin[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const Ball& ball = balls[begin[i]];
      full.x[i] = static_cast<float>(ball.center.x);
      full.y[i] = static_cast<float>(ball.center.y);
      full.z[i] = static_cast<float>(ball.center.z);
      full.radius[i] = static_cast<float>(ball.radius);
      full.balls[i] = begin[i];
    }
    clusters.push_back(full);
    return;
  }
  const auto value = [&balls](std::uint32_t ball, int key) {
    const auto& [center, radius] = balls[ball];
    return key == 0 ? center.x : key == 1 ? center.y : key == 2 ? center.z : radius;
  };
  int widest = 0;
  double width = -1;
  for (int key = 0; key < 4; ++key) {
    const auto [least, most] = std::minmax_element(
        begin, end, [&](std::uint32_t a, std::uint32_t b) { return value(a, key) < value(b, key); });
    if (value(*most, key) - value(*least, key) > width) {
      width = value(*most, key) - value(*least, key);
      widest = key;
    }
  }
  std::uint32_t* const middle = begin + (count / 2 + Cluster::size - 1) / Cluster::size * Cluster::size;
  std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
    return value(a, widest) < value(b, widest) || (value(a, widest) == value(b, widest) && a < b);
  });
  cluster(balls, begin, middle, clusters);
  cluster(balls, middle, end, clusters);
}

bool go_on(void* monitor, double) { return !static_cast<geometry::Monitor*>(monitor)->cancelled(); }

}  // namespace

struct RayCaster::Impl {
  /// All bodies of one kind, as Embree knows them.
  struct Group {
    const Impl* impl = nullptr;
    Kind kind = clusters;
    std::uint32_t first = 0;  // number of the first body; in clusters every ball has its number
  };

  Bodies bodies;
  std::vector<Cluster> ball_clusters;
  std::array<Group, 3> groups;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Impl() {
    if (scene != nullptr) embree().release_scene(scene);
    if (device != nullptr) embree().release_device(device);
  }

  RTCBounds bounds_of(Kind kind, std::size_t i) const;
  void look_at(Query& query, const Group& group, std::uint32_t i) const;
  void add_group(Kind kind, std::size_t count, std::uint32_t first);
  void ask(Query& query) const;
};

namespace {

// Embree's float of a distance must not cut off a body at just that distance.
float rounded_up(double t) { return static_cast<float>(t + slack * (1 + std::abs(t))); }

}  // namespace

RTCBounds RayCaster::Impl::bounds_of(Kind kind, std::size_t i) const {
  if (kind == capsules) return bounds(bodies.capsules[i]);
  if (kind == triangles) return bounds(bodies.triangles[i]);
  geometry::Box box;
  for (const std::uint32_t number : ball_clusters[i].balls) {
    const Ball& ball = bodies.balls[number];
    const Vec3 r{ball.radius, ball.radius, ball.radius};
    box.add(ball.center - r);
    box.add(ball.center + r);
  }
  return padded(box.lower, box.upper);
}

void RayCaster::Impl::look_at(Query& query, const Group& group, std::uint32_t i) const {
  if (group.kind == capsules) return show::look_at(query, group.first + i, bodies.capsules[i]);
  if (group.kind == triangles) return show::look_at(query, group.first + i, bodies.triangles[i]);
  const Cluster& all = ball_clusters[i];
  const double lower = query.interval.lower;
  const double upper =
      query.question == Question::nearest && query.found ? query.best.t : query.interval.upper;
  const auto marks = candidates(all, query.ray.at(lower), query.ray.direction, upper - lower);
  for (std::size_t k = 0; k < Cluster::size; ++k) {
    if (marks[k] != 0) show::look_at(query, all.balls[k], bodies.balls[all.balls[k]]);
  }
}

void RayCaster::Impl::add_group(Kind kind, std::size_t count, std::uint32_t first) {
  if (count == 0) return;
  groups[kind] = {this, kind, first};
  RTCGeometry geometry = embree().new_geometry(device, RTC_GEOMETRY_TYPE_USER);
  embree().set_geometry_user_primitive_count(geometry, static_cast<unsigned>(count));
  embree().set_geometry_user_data(geometry, &groups[kind]);
  embree().set_geometry_bounds_function(
      geometry,
      [](const RTCBoundsFunctionArguments* arguments) {
        const Group& group = *static_cast<const Group*>(arguments->geometryUserPtr);
        *arguments->bounds_o = group.impl->bounds_of(group.kind, arguments->primID);
      },
      nullptr);
  embree().set_geometry_intersect_function(geometry, [](const RTCIntersectFunctionNArguments* arguments) {
    const Group& group = *static_cast<const Group*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    group.impl->look_at(query, group, arguments->primID);
    if (query.question == Question::nearest && query.found) {
      reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar = rounded_up(query.best.t);
    }
  });
  embree().set_geometry_occluded_function(geometry, [](const RTCOccludedFunctionNArguments* arguments) {
    const Group& group = *static_cast<const Group*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    group.impl->look_at(query, group, arguments->primID);
    if (query.found) {
      reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
    }
  });
  embree().commit_geometry(geometry);
  embree().attach_geometry(scene, geometry);
  embree().release_geometry(geometry);
}

void RayCaster::Impl::ask(Query& query) const {
  if (bodies.size() == 0 || !(query.interval.lower <= query.interval.upper)) return;
  rtcInitIntersectContext(&query.context);
  RTCRay ray{};
  ray.org_x = static_cast<float>(query.ray.origin.x);
  ray.org_y = static_cast<float>(query.ray.origin.y);
  ray.org_z = static_cast<float>(query.ray.origin.z);
  ray.dir_x = static_cast<float>(query.ray.direction.x);
  ray.dir_y = static_cast<float>(query.ray.direction.y);
  ray.dir_z = static_cast<float>(query.ray.direction.z);
  ray.tnear = std::max(0.0F, -rounded_up(-query.interval.lower));
  ray.tfar = rounded_up(query.interval.upper);
  ray.mask = ~0U;
  if (query.question == Question::blocked) {
    embree().occluded_1(scene, &query.context, &ray);
  } else {
    RTCRayHit ray_hit{};
    ray_hit.ray = ray;
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree().intersect_1(scene, &query.context, &ray_hit);
  }
}

RayCaster::RayCaster(Bodies bodies, geometry::Monitor& monitor) : impl_(std::make_unique<Impl>()) {
  impl_->bodies = std::move(bodies);
  const Bodies& all = impl_->bodies;
  if (all.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("more than four billion bodies in a picture");
  }
  impl_->device = embree().new_device(
      // Embree limits the threads of the whole process to those it is told.
      ("threads=" + std::to_string(tbb::this_task_arena::max_concurrency())).c_str());
  if (impl_->device == nullptr) {
    throw std::runtime_error("Embree cannot be used on this machine (error " +
                             std::to_string(embree().get_device_error(nullptr)) + ")");
  }
  impl_->scene = embree().new_scene(impl_->device);
  embree().set_scene_flags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  const auto first_capsule = static_cast<std::uint32_t>(all.balls.size());
  const auto first_triangle = static_cast<std::uint32_t>(first_capsule + all.capsules.size());
  std::vector<std::uint32_t> order(all.balls.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!order.empty()) cluster(all.balls, order.data(), order.data() + order.size(), impl_->ball_clusters);
  impl_->add_group(clusters, impl_->ball_clusters.size(), 0);
  impl_->add_group(capsules, all.capsules.size(), first_capsule);
  impl_->add_group(triangles, all.triangles.size(), first_triangle);
  embree().set_scene_progress_monitor_function(impl_->scene, go_on, &monitor);
  embree().join_commit_scene(impl_->scene);  // in the threads of the caller
  switch (const RTCError error = embree().get_device_error(impl_->device)) {
    case RTC_ERROR_NONE:
      break;
    case RTC_ERROR_CANCELLED:
      throw geometry::Cancelled();
    case RTC_ERROR_OUT_OF_MEMORY:
      throw std::bad_alloc();
    default:
      throw std::runtime_error("Embree fails with error " + std::to_string(error));
  }
}

RayCaster::~RayCaster() = default;

const Bodies& RayCaster::bodies() const { return impl_->bodies; }

std::optional<Hit> RayCaster::nearest(const Ray& ray, Interval interval) const {
  Query query{{}, Question::nearest, ray, interval, false, {}, nullptr};
  impl_->ask(query);
  if (!query.found) return std::nullopt;
  return query.best;
}

bool RayCaster::blocked(const Ray& ray, Interval interval) const {
  Query query{{}, Question::blocked, ray, interval, false, {}, nullptr};
  impl_->ask(query);
  return query.found;
}

void RayCaster::all(const Ray& ray, Interval interval, std::vector<Hit>& hits) const {
  hits.clear();
  Query query{{}, Question::all, ray, interval, false, {}, &hits};
  impl_->ask(query);
  std::sort(hits.begin(), hits.end());
}

}  // namespace ballflow::show

#include "show/picture/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballflow::show {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::Vec3;

constexpr int pattern_side = 4, patterns = pattern_side * pattern_side;
constexpr int sky_rays = 6, lamp_rays = 3;                           // per pixel
constexpr double sky_distance = 0.3;                                 // what is farther away hides nothing
constexpr double lamp_radius = 0.16;                                 // tangent of the angle
constexpr double surface_offset = 1e-4;                              // rays begin above the surface
constexpr double sky_light = 0.54, lamp_light = 0.4, bounce = 0.16;  // at most about 1 in all

// The first sample of a pixel, which also finds how open the surface is, and those that are added where it
// differs from a neighbour: no two in a row or column.
constexpr std::array<std::array<double, 2>, 5> places = {
    {{0.5, 0.5}, {0.375, 0.125}, {0.875, 0.375}, {0.625, 0.875}, {0.125, 0.625}}};

Vec3 normalised(Vec3 v) { return 1 / geometry::length(v) * v; }

/// Two vectors that make an orthonormal basis with the unit vector n (Duff et al., JCGT 6(1), 2017).
std::array<Vec3, 2> tangents(Vec3 n) {
  const double sign = n.z < 0 ? -1 : 1;
  const double a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {Vec3{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, Vec3{b, sign + n.y * n.y * a, -n.y}};
}

/// `count` points that cover the unit disc evenly: each turned by the golden angle against the one before.
template <std::size_t count>
std::array<std::array<double, 2>, count> sunflower() {
  constexpr double cosine = -0.7373688780783197, sine = 0.6754902942615238;
  std::array<std::array<double, 2>, count> points;
  double x = 1, y = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = std::sqrt((static_cast<double>(i) + 0.5) / count);
    points[i] = {r * x, r * y};
    const double turned = cosine * x - sine * y;
    y = sine * x + cosine * y;
    x = turned;
  }
  return points;
}

/// The patterns of a 4 x 4 block, ordered so that neighbours have patterns that are far apart.
int pattern_of(int x, int y) {
  constexpr std::array<int, patterns> order = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  return order[static_cast<std::size_t>((y & 3) * pattern_side + (x & 3))];
}

}  // namespace

Renderer::Renderer(const std::vector<Layer>& scene, const Ranges& ranges, const Camera& camera,
                   std::vector<CutPlane> planes, Strokes strokes, geometry::Monitor& monitor)
    : camera_(camera),
      planes_(std::move(planes)),
      surfaces_(scene, ranges, camera, strokes),
      opaque_(surfaces_.bodies(true), monitor),
      sheets_(surfaces_.bodies(false), monitor),
      lamp_(normalised(-0.5 * camera.right() + 0.75 * camera.up() + 0.9 * camera.backward())) {
  lamp_x_ = tangents(lamp_)[0];
  lamp_y_ = tangents(lamp_)[1];
}

Renderer::Kept Renderer::kept(const Ray& ray) const {
  Kept part{{0, 100}, -ray.direction};
  for (const CutPlane& plane : planes_) {
    const double height = plane.offset - dot(plane.normal, ray.origin);  // below the plane
    const double climb = dot(plane.normal, ray.direction);
    if (climb > 0) {
      part.interval.upper = std::min(part.interval.upper, height / climb);
    } else if (climb < 0) {
      if (height / climb > part.interval.lower) {
        part.interval.lower = height / climb;
        part.cut = plane.normal;
      }
    } else if (height < 0) {
      part.interval.upper = -1;
    }
  }
  return part;
}

Renderer::Sample Renderer::sample(double x, double y, std::vector<Hit>& hits) const {
  Sample sample;
  const Ray ray = camera_.ray(x, y);
  Kept part = kept(ray);
  if (!(part.interval.lower <= part.interval.upper)) return sample;
  if (const auto hit = opaque_.nearest(ray, part.interval)) {
    sample.solid = true;
    sample.point = surfaces_.point(opaque_.bodies(), ray, *hit, part.cut);
    sample.pixel = camera_.pixel_at(hit->t);
    part.interval.upper = hit->t;
  }
  if (sheets_.bodies().size() > 0) add_sheets(ray, part, hits, sample);
  return sample;
}

void Renderer::add_sheets(const Ray& ray, const Kept& part, std::vector<Hit>& hits, Sample& sample) const {
  const Bodies& bodies = sheets_.bodies();
  sheets_.all(ray, part.interval, hits);
  // How many balls of a layer the ray is in. Layers are few.
  std::vector<std::pair<std::uint32_t, int>> depths;
  std::pair<std::uint32_t, double> last{~0U, 0};
  for (const Hit& hit : hits) {
    const Origin origin = bodies.origins[hit.body];
    if (hit.body >= bodies.balls.size()) {
      // Triangles meet in edges and segments in vertices: there they are one sheet.
      const bool again = last.first == origin.layer && hit.t - last.second < 1e-7;
      last = {origin.layer, hit.t};
      if (again) continue;
    } else {
      auto depth = std::find_if(depths.begin(), depths.end(),
                                [&](const auto& entry) { return entry.first == origin.layer; });
      if (depth == depths.end()) depth = depths.insert(depths.end(), {origin.layer, 0});
      if (hit.leaves ? --depth->second > 0 : depth->second++ > 0) continue;  // inside the union
    }
    const SurfacePoint point = surfaces_.point(bodies, ray, hit, part.cut);
    const double opacity = surfaces_.layer(origin).opacity;
    const double cosine = std::max(0.1, -dot(point.normal, ray.direction));
    const double alpha = opacity / (opacity + (1 - opacity) * cosine);
    sample.front = sample.front + sample.through * alpha * shaded(point, {});
    sample.through *= 1 - alpha;
  }
}

bool Renderer::free(const Vec3& from, const Vec3& towards, double distance) const {
  const Ray ray{from, towards};
  Interval interval = kept(ray).interval;
  interval.upper = std::min(interval.upper, distance);
  return !opaque_.blocked(ray, interval);
}

Renderer::Open Renderer::open(const SurfacePoint& point, int pattern) const {
  static const auto sky = sunflower<patterns * sky_rays>();
  static const auto lamp = sunflower<patterns * lamp_rays>();
  const Vec3 from = point.position + surface_offset * point.facet;
  const auto [u, v] = tangents(point.normal);
  int seen = 0;
  for (std::size_t i = 0; i < sky_rays; ++i) {
    const auto [x, y] = sky[i * patterns + static_cast<std::size_t>(pattern)];
    const Vec3 towards = x * u + y * v + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * point.normal;
    if (free(from, towards, sky_distance)) ++seen;
  }
  int lit = 0;
  if (dot(point.normal, lamp_) > 0) {
    for (std::size_t i = 0; i < lamp_rays; ++i) {
      const auto [x, y] = lamp[i * patterns + static_cast<std::size_t>(pattern)];
      const Vec3 towards = normalised(lamp_ + lamp_radius * x * lamp_x_ + lamp_radius * y * lamp_y_);
      if (free(from, towards, 100)) ++lit;
    }
  }
  return {static_cast<double>(seen) / sky_rays, static_cast<double>(lit) / lamp_rays};
}

Light Renderer::shaded(const SurfacePoint& point, const Open& open) const {
  // The sky is brighter above; a little light comes back from the ground and from the side of the viewer.
  const double above = 0.5 + 0.5 * dot(point.normal, camera_.up());
  const double facing = std::max(0.0, dot(point.normal, camera_.backward()));
  const double sky = open.sky * (sky_light * (0.6 + 0.4 * above));
  const double lamp = open.lamp * lamp_light * std::max(0.0, dot(point.normal, lamp_));
  return (sky + lamp + bounce * facing * (0.4 + 0.6 * open.sky)) * point.colour;
}

bool Renderer::alike(const Sample& a, const Sample& b) {
  const auto differ = [](Light p, Light q) {
    return std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)}) > 0.03;
  };
  if (a.solid != b.solid || std::abs(a.through - b.through) > 0.03 || differ(a.front, b.front)) return false;
  if (!a.solid) return true;
  const double off = dot(a.point.facet, b.point.position - a.point.position);
  return dot(a.point.normal, b.point.normal) > 0.97 && std::abs(off) < a.pixel &&
         !differ(a.point.colour, b.point.colour);
}

std::vector<Pixel> Renderer::tile(int x, int y, int width, int height, geometry::Monitor& monitor) const {
  constexpr int border = pattern_side / 2;
  const int columns = width + 2 * border, rows = height + 2 * border;
  std::vector<Hit> hits;
  std::vector<Sample> first(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<Open> opens(first.size());
  const auto number = [columns](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  };
  for (int row = 0; row < rows; ++row) {
    if (monitor.cancelled()) throw geometry::Cancelled();
    for (int column = 0; column < columns; ++column) {
      const int px = x - border + column, py = y - border + row;
      Sample& sample = first[number(column, row)];
      sample = this->sample(px + places[0][0], py + places[0][1], hits);
      if (sample.solid) opens[number(column, row)] = open(sample.point, pattern_of(px, py));
    }
  }

  // The mean over the pixels around a sample, among which every pattern occurs once, of those on its surface.
  const auto mean_open = [&](const Sample& sample, int column, int row, std::array<double, 2> place) -> Open {
    const int left = column + (place[0] < places[0][0] ? -2 : -1);
    const int top = row + (place[1] < places[0][1] ? -2 : -1);
    double weights = 0;
    Open sum{0, 0};
    for (int j = top; j < top + pattern_side; ++j) {
      for (int i = left; i < left + pattern_side; ++i) {
        const Sample& other = first[number(i, j)];
        if (!other.solid) continue;
        const double turn = dot(sample.point.normal, other.point.normal);
        const double off =
            dot(sample.point.normal, other.point.position - sample.point.position) / sample.pixel;
        if (turn < 0.7 || std::abs(off) > 3) continue;
        const double weight = (turn - 0.7) * (9 - off * off);
        weights += weight;
        sum.sky += weight * opens[number(i, j)].sky;
        sum.lamp += weight * opens[number(i, j)].lamp;
      }
    }
    if (weights < 0.5) return open(sample.point, pattern_of(x - border + column, y - border + row));
    return {sum.sky / weights, sum.lamp / weights};
  };

  // One sample does where it and all neighbours lie on one surface of one colour.
  const auto uniform = [&](int column, int row) {
    const Sample& here = first[number(column, row)];
    for (int j = row - 1; j <= row + 1; ++j) {
      for (int i = column - 1; i <= column + 1; ++i) {
        if (!alike(here, first[number(i, j)])) return false;
      }
    }
    return true;
  };
  const auto seen = [&](const Sample& sample, int column, int row, std::array<double, 2> place) {
    if (!sample.solid) return Pixel{sample.front, 1 - sample.through};
    const Open around = mean_open(sample, column, row, place);
    return Pixel{sample.front + sample.through * shaded(sample.point, around), 1};
  };

  std::vector<Pixel> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = border; row < border + height; ++row) {
    if (monitor.cancelled()) throw geometry::Cancelled();
    for (int column = border; column < border + width; ++column) {
      Pixel pixel = seen(first[number(column, row)], column, row, places[0]);
      if (!uniform(column, row)) {
        for (std::size_t k = 1; k < places.size(); ++k) {
          const double px = x + column - border + places[k][0], py = y + row - border + places[k][1];
          const Pixel more = seen(sample(px, py, hits), column, row, places[k]);
          pixel.light = pixel.light + more.light;
          pixel.coverage += more.coverage;
        }
        pixel.light = 1.0 / places.size() * pixel.light;
        pixel.coverage /= places.size();
      }
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

}  // namespace ballflow::show

#include "enclose/enclose_balls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "enclose/ball_cover.hpp"
#include "enclose/enclosing_search.hpp"
#include "enclose/generic_frame.hpp"
#include "enclose/soft_descent.hpp"
#include "enclose/solid_lattice.hpp"
#include "enclose/start_balls.hpp"
#include "enclose/surface_patches.hpp"
#include "enclose/verify_enclosure.hpp"

namespace ballflow::geometry {
namespace {
double env(const char* n, double d) { const char* v = std::getenv(n); return v ? std::atof(v) : d; }
constexpr double pi = 3.14159265358979323846;

struct Work {
  SurfacePatches patches;
  OutsidePoints outside;
  float unit() const { return static_cast<float>(outside.unit); }
};

/// What each vertex of the cover stands for.
std::vector<float> vertex_areas(const SurfacePatches& patches, std::size_t vertices) {
  std::vector<float> areas(vertices, 0);
  double total = 0;
  for (const auto& [a, b, c] : patches.corners) {
    const auto at = [&](std::int32_t v) { return patches.vertices[static_cast<std::size_t>(v)]; };
    const double area = 0.5 * length(cross(at(b) - at(a), at(c) - at(a)));
    total += area;
    for (const std::int32_t v : {a, b, c}) areas[static_cast<std::size_t>(v)] += static_cast<float>(area / 3);
  }
  const auto mean = static_cast<float>(total / static_cast<double>(patches.vertices.size()));
  for (std::size_t v = patches.vertices.size(); v < vertices; ++v) areas[v] = mean;  // points inside
  return areas;
}

void soften(EnclosingSearch& search, BallCover& cover, const Work& work, const std::vector<float>& areas,
            Monitor& monitor) {
  const std::int64_t waste = cover.waste();
  const std::vector<FloatBall> before = search.balls();
  SoftDescentOptions options;
  options.steps = static_cast<int>(env("STEPS", 250));
  options.first_rate = static_cast<float>(env("RATE0", 0.03)); options.last_rate = static_cast<float>(env("RATE1", 0.003));
  options.width = static_cast<float>(env("WIDTH", 1.5));
  options.first_price = static_cast<float>(env("P0", 8)); options.last_price = static_cast<float>(env("P1", 60));
  const std::vector<FloatBall> after = soft_descent(cover, areas, work.unit(), before, options, monitor);
  std::vector<FloatBall> empty;
  for (std::size_t i = 0; i < cover.places(); ++i) if (cover.place(i).used) cover.remove(i);
  search.take(after);
  if (env("V", 0) > 0) std::fprintf(stderr, "soft+repair %ld\n", cover.waste());
  search.sweep(5);
  if (env("V", 0) > 0) std::fprintf(stderr, "soft+sweep %ld\n", cover.waste());
  if (cover.waste() < waste) return;
  for (std::size_t i = 0; i < cover.places(); ++i) if (cover.place(i).used) cover.remove(i);
  search.take(before);
}

}  // namespace

EnclosingBalls enclose_balls(const TriangleMesh& mesh, const EncloseBallsOptions& options, const Balls* start,
                             Monitor& monitor) {
  (void)start;
  const GenericFrame frame(mesh.vertices.span());
  std::vector<Vec3> vertices;
  for (const Vec3 p : mesh.vertices) vertices.push_back(frame.into(p));
  const TriangleMesh turned{vertices, mesh.triangles};
  const double area = surface_area(vertices, mesh.triangles.span());
  const auto count = static_cast<std::size_t>(options.balls);
  Work work;
  work.patches = surface_patches(vertices, mesh.triangles.span(), 1.9 * std::sqrt(area / env("PATCH", 6000)));
  const double rho = std::sqrt(area / (pi * static_cast<double>(options.balls)));
  work.outside = outside_points(turned, {.band = 1.2 * rho, .points = static_cast<long>(env("PTS", 40000))}, monitor);
  BallCover cover(work.patches, work.outside.inside, work.outside);
  cover.resize(count);
  Random random(static_cast<std::uint64_t>(options.seed));
  EnclosingSearch search(cover, random, monitor);
  const bool v = env("V", 0) > 0;
  const auto say = [&](const char* what) {
    if (v) std::fprintf(stderr, "%-10s used %zu waste %.4f uncovered %zu t %.2f\n", what, cover.used(),
                 static_cast<double>(cover.waste()) / static_cast<double>(work.outside.solid), cover.uncovered(), (double)clock()/CLOCKS_PER_SEC);
  };
  if (v) std::fprintf(stderr, "patches %zu vertices %zu outside %zu inside %zu solid %ld h %g t %.2f\n", work.patches.corners.size(), work.patches.vertices.size(),
               work.outside.points.size(), work.outside.inside.size(), work.outside.solid, work.outside.spacing, (double)clock()/CLOCKS_PER_SEC);
  search.take(start_balls(cover, work.unit(), count, monitor));
  say("start");
  search.sweep(static_cast<int>(env("SW0", 3)));
  say("sweep");
  const std::vector<float> areas = vertex_areas(work.patches, cover.vertices());
  if (env("SOFT", 1) > 0) soften(search, cover, work, areas, monitor);
  say("soft");
  search.fill();
  say("fill");
  const int rounds = static_cast<int>(env("ROUNDS", 1));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t n = 0; n < 4 * count; ++n) search.shift();
    say("shift");
    search.sweep(5);
    search.fill();
    say("sweepfill");
    for (int n = 0; n < 8 && search.swap(); ++n) say("  swap");
    say("swap");
  }
  search.sweep(5);
  say("sweep");

  // finer patches
  SurfacePatches fine = surface_patches(vertices, mesh.triangles.span(), 1.9 * std::sqrt(area / env("FINE", 16000)));
  OutsidePoints finer = work.outside;
  BallCover cover2(fine, work.outside.inside, finer);
  cover2.resize(count);
  EnclosingSearch search2(cover2, random, monitor);
  search2.take(search.balls());
  if (v) std::fprintf(stderr, "fine patches %zu waste %.4f t %.2f\n", fine.corners.size(), static_cast<double>(cover2.waste()) / static_cast<double>(work.outside.solid), (double)clock()/CLOCKS_PER_SEC);
  search2.sweep(5);
  for (std::size_t n = 0; n < 3 * count; ++n) search2.shift();
  search2.sweep(3);
  search2.fill();
  if (v) std::fprintf(stderr, "fine waste %.4f used %zu t %.2f\n", static_cast<double>(cover2.waste()) / static_cast<double>(work.outside.solid), cover2.used(), (double)clock()/CLOCKS_PER_SEC);

  EnclosingBalls result;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const FloatBall& b : search2.balls()) {
    centers.push_back(frame.out_of({b.x, b.y, b.z}));
    radii.push_back(b.r * frame.size() * (1 + 2e-6));
  }
  const double size = frame.size();
  result.balls = {centers, radii, {}, {}};
  result.solid = static_cast<double>(work.outside.solid) * work.outside.unit * size * size * size;
  result.outside = static_cast<double>(cover2.waste()) * work.outside.unit * size * size * size;
  return result;
}

}  // namespace ballflow::geometry

#include "enclose/enclose_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "enclose/ball_cover.hpp"
#include "enclose/enclosing_search.hpp"
#include "enclose/soft_descent.hpp"
#include "enclose/solid_lattice.hpp"
#include "enclose/start_balls.hpp"
#include "enclose/surface_patches.hpp"
#include "enclose/verify_enclosure.hpp"
#include "search/generic_frame.hpp"

namespace ballflow::geometry {
namespace {

constexpr double patches_wanted = 12000;  // two or three times as many are made
constexpr double pi = 3.14159265358979323846;

/// The corners of triangles, without other vertices.
TriangleMesh without_strays(const TriangleMesh& mesh) {
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  for (Triangle& triangle : triangles) {
    for (std::int32_t& corner : triangle) {
      std::int32_t& n = number[static_cast<std::size_t>(corner)];
      if (n < 0) {
        n = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
      }
      corner = n;
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Rounded so that a model that was moved or scaled, and so has other last digits, is searched in the same
/// way.
constexpr double grid = 0x1p-22;
Vec3 on_grid(Vec3 p) {
  const auto rounded = [](double c) { return grid * std::round(c / grid); };
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

/// The mesh in the frame, and what the search looks at.
class Problem {
 public:
  Problem(const TriangleMesh& mesh, std::size_t balls, Monitor& monitor)
      : frame_(mesh.vertices.span()), balls_(balls) {
    std::vector<Vec3> vertices;
    vertices.reserve(mesh.vertices.size());
    for (const Vec3 p : mesh.vertices) vertices.push_back(on_grid(frame_.into(p)));
    area_ = surface_area(vertices, mesh.triangles.span());
    longest_ = std::max(1.9 * std::sqrt(area_ / patches_wanted), 0.004);
    patches_ = surface_patches(vertices, mesh.triangles.span(), longest_);
    const double radius = std::max(std::sqrt(area_ / (pi * static_cast<double>(balls))), 0.01);
    outside_ = outside_points({std::move(vertices), mesh.triangles}, {.band = 1.2 * radius, .points = 20000},
                              monitor);
    demanded_ = outside_.inside;
  }

  const GenericFrame& frame() const { return frame_; }
  const OutsidePoints& outside() const { return outside_; }
  double longest_patch() const { return longest_; }

  BallCover cover() const {
    BallCover result(patches_, demanded_, outside_);
    result.resize(balls_);
    return result;
  }
  void demand(Vec3 point) { demanded_.push_back(frame_.into(point)); }

  /// What each vertex of a cover stands for: a third of the patches there.
  std::vector<float> vertex_areas() const {
    const std::vector<Vec3>& vertices = patches_.vertices;
    std::vector<float> areas(vertices.size(), 0);
    for (const auto& corners : patches_.corners) {
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = vertices[static_cast<std::size_t>(corners[k])];
      const double area = 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
      for (const std::int32_t v : corners) areas[static_cast<std::size_t>(v)] += static_cast<float>(area / 3);
    }
    const auto mean = static_cast<float>(area_ / static_cast<double>(vertices.size()));
    areas.resize(vertices.size() + demanded_.size(), mean);
    return areas;
  }

  /// Cuts patches that reach out of their only ball's neighbours into it: where a part could be left to a
  /// neighbour, and the ball be smaller.
  void cut_seams(const BallCover& cover) {
    std::vector<std::uint8_t> counts(cover.vertices(), 0), cut(patches_.corners.size(), 0);
    PointBlocks vertices;
    vertices.build({cover.vertex_points()});
    for (std::size_t i = 0; i < cover.places(); ++i) {
      if (!cover.place(i).used) continue;
      vertices.in_ball(cover.place(i).ball, [&](std::size_t v) {
        counts[v] = static_cast<std::uint8_t>(std::min(2, counts[v] + 1));
      });
    }
    const auto slack = static_cast<float>(0.2 * longest_);
    for (std::size_t p = 0; p < cut.size(); ++p) {
      if (cover.patch_counts()[p] != 1) continue;
      const FloatBall& ball = cover.place(cover.place_of(p)).ball;
      if (cover.farthest(p, ball) < ball.r - slack) continue;
      for (const std::int32_t v : cover.patch_corners(p)) {
        if (counts[static_cast<std::size_t>(v)] > 1) cut[p] = 1;
      }
    }
    patches_ = refined(patches_, cut, longest_ / 64);
  }

 private:
  GenericFrame frame_;
  std::size_t balls_;
  double area_ = 0, longest_ = 0;
  SurfacePatches patches_;
  OutsidePoints outside_;
  std::vector<Vec3> demanded_;  // points that have to be covered besides the surface
};

/// Many balls have fewer places left where a round gains.
int rounds_of(const EncloseBallsOptions& options) {
  constexpr std::int64_t many = 40;
  switch (options.effort) {
    case EncloseEffort::low:
      return 0;
    case EncloseEffort::normal:
      return options.balls > many ? 1 : 2;
    case EncloseEffort::high:
      return options.balls > many ? 5 : 8;
  }
  return 0;
}

/// All balls downhill at once; not kept when repairing what that leaves uncovered costs more than it gained.
void descend(const Problem& problem, BallCover& cover, EnclosingSearch& search, int steps, Monitor& monitor) {
  SoftDescentOptions options;
  options.steps = steps;
  const std::int64_t waste = cover.waste();
  const std::vector<FloatBall> before = search.balls();
  search.take(soft_descent(cover, problem.vertex_areas(), static_cast<float>(problem.outside().unit), before,
                           options, monitor));
  search.sweep(5);
  if (cover.waste() >= waste) search.take(before);
}

/// Where some balls have no use, since no single split gains: whether all balls together find one.
void use_all_balls(const Problem& problem, BallCover& cover, EnclosingSearch& search, Monitor& monitor) {
  if (cover.used() == cover.places()) return;
  const std::int64_t waste = cover.waste();
  const std::vector<FloatBall> before = search.balls();
  search.fill_anyway();
  descend(problem, cover, search, 250, monitor);
  search.fill();
  if (cover.waste() >= waste) search.take(before);
}

std::vector<FloatBall> search_coarsely(const Problem& problem, const std::vector<FloatBall>& start,
                                       const EncloseBallsOptions& options, Random& random, Monitor& monitor) {
  BallCover cover = problem.cover();
  EnclosingSearch search(cover, random, monitor);
  search.take(start.empty()
                  ? start_balls(cover, static_cast<float>(problem.outside().unit), cover.places(), monitor)
                  : start);
  search.sweep(3);
  PartMonitor first(monitor, 0.1, 0.25), second(monitor, 0.25, 0.4);
  descend(problem, cover, search, 250, first);
  search.fill();
  descend(problem, cover, search, 250, second);
  search.fill();
  const int rounds = rounds_of(options);
  for (int round = 0; round < rounds; ++round) {
    monitor.step(0.4 + 0.6 * round / rounds);
    for (std::size_t n = 0; n < 4 * cover.places(); ++n) search.shift();
    search.sweep(5);
    search.fill();
    constexpr int most_swaps = 8;
    for (int n = 0; n < most_swaps && search.swap(); ++n) {
    }
    PartMonitor part(monitor, 0.4 + 0.6 * (round + 0.7) / rounds, 0.4 + 0.6 * (round + 1) / rounds);
    descend(problem, cover, search, 120, part);
    search.fill();
  }
  use_all_balls(problem, cover, search, second);
  search.sweep(5);
  return search.balls();
}

/// With smaller and smaller patches at the seams.
std::vector<FloatBall> search_finely(Problem& problem, std::vector<FloatBall> balls, Random& random,
                                     Monitor& monitor, std::int64_t& waste) {
  constexpr int levels = 8;
  for (int level = 0; level <= levels; ++level) {
    monitor.step(static_cast<double>(level) / levels);
    BallCover cover = problem.cover();
    EnclosingSearch search(cover, random, monitor);
    search.take(balls);
    if (level % 2 == 0) search.sweep(3);
    if (level == levels) {
      for (std::size_t n = 0; n < 3 * cover.places(); ++n) search.shift();
      search.sweep(3);
      search.fill();
      PartMonitor part(monitor, static_cast<double>(level) / levels, 1);
      use_all_balls(problem, cover, search, part);
    } else {
      problem.cut_seams(cover);
    }
    balls = search.balls();
    waste = cover.waste();
  }
  return balls;
}

/// In model units. Radii a little larger, so that no point lies on several spheres and in no ball; a point
/// and where the grid moved it, half a diagonal of its cells away, are in the same balls.
Balls out_of_frame(const GenericFrame& frame, const std::vector<FloatBall>& balls) {
  constexpr double larger = 1 + 2e-6;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const FloatBall& ball : balls) {
    centers.push_back(frame.out_of({ball.x, ball.y, ball.z}));
    radii.push_back(larger * frame.size() * (ball.r + grid));
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

void grow(Balls& balls, double factor, double least) {
  std::vector<double> radii(balls.radii.begin(), balls.radii.end());
  for (double& r : radii) r = std::max(r * factor, least);
  balls.radii = std::move(radii);
}

/// What the proof finds open is mended until there is nothing.
void prove(const TriangleMesh& mesh, Problem& problem, std::vector<FloatBall> found, Random& random,
           EnclosingBalls& result, Monitor& monitor) {
  constexpr int most_repairs = 10;
  double factor = 1;
  for (int repair = 0;; ++repair) {
    const Enclosure proof = verify_enclosure(mesh, result.balls, {.on_open = OnOpen::report}, monitor);
    if (proof.encloses()) return;
    if (proof.voids_that_matter() > 0 && repair < most_repairs) {
      for (std::size_t v = 0; v < proof.void_points.size(); ++v) {
        if (proof.void_places[v] == static_cast<std::uint8_t>(VoidPlace::outside)) continue;
        problem.demand(proof.void_points[v]);
        ++result.fit.filled_voids;
      }
      BallCover cover = problem.cover();
      EnclosingSearch search(cover, random, monitor);
      search.take(found);
      search.sweep(3);
      found = search.balls();
      result.balls = out_of_frame(problem.frame(), found);
      result.fit.outside = static_cast<double>(cover.waste());
    }
    // Rounding left a gap; or, after all repairs, anything. One ball that has grown enough holds everything.
    if (!proof.covers() || repair >= most_repairs) factor *= repair < most_repairs ? 1 + 1e-5 : 1.02;
    if (factor > 1) grow(result.balls, factor, 1e-7 * problem.frame().size());
  }
}

void check(const TriangleMesh& mesh, const EncloseBallsOptions& options, const Balls* start) {
  if (const std::string broken = broken_invariant(mesh); !broken.empty())
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  if (mesh.triangles.empty())
    throw InputError("there are no triangles, so there is nothing to enclose",
                     "give a mesh; clouds of points become one by graphs/reconstruct.json");
  if (options.balls < 1)
    throw InputError("balls is " + std::to_string(options.balls), "ask for one ball at least");
  if (start == nullptr) return;
  if (const std::string broken = broken_invariant(*start); !broken.empty())
    throw InputError(broken, "repair or remove the ball");
  if (start->size() == 0 || start->size() > static_cast<std::size_t>(options.balls)) {
    throw InputError("the search cannot start with " + std::to_string(start->size()) +
                         " balls where at most " + std::to_string(options.balls) + " are wanted",
                     "raise balls, or leave start unconnected");
  }
}

}  // namespace

EnclosingBalls enclose_balls(const TriangleMesh& original, const EncloseBallsOptions& options,
                             Monitor& monitor, const Balls* start) {
  check(original, options, start);
  const TriangleMesh mesh = without_strays(original);
  EnclosingBalls result;
  result.fit.wanted = options.balls;
  const double size = bounding_box(mesh.vertices.span()).longest_edge();
  if (!(size > 0)) {  // a point, which is a ball of radius 0
    result.balls = {std::vector<Vec3>{mesh.vertices[0]}, std::vector<double>{0}, {}, {}};
    result.fit.balls = 1;
    return result;
  }
  Problem problem(mesh, static_cast<std::size_t>(options.balls), monitor);
  Random random(static_cast<std::uint64_t>(options.seed));
  std::vector<FloatBall> first;
  if (start != nullptr) {
    for (std::size_t i = 0; i < start->size(); ++i) {
      FloatBall ball;
      const Vec3 c = problem.frame().into(start->centers[i]);
      first.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z),
                       static_cast<float>(start->radii[i] / size)});
    }
  }
  PartMonitor coarse(monitor, 0.05, 0.7), fine(monitor, 0.7, 0.95), proving(monitor, 0.95, 1);
  std::int64_t waste = 0;
  const std::vector<FloatBall> balls =
      search_finely(problem, search_coarsely(problem, first, options, random, coarse), random, fine, waste);
  result.balls = out_of_frame(problem.frame(), balls);
  result.fit.outside = static_cast<double>(waste);
  prove(mesh, problem, balls, random, result, proving);
  const double unit = problem.outside().unit * size * size * size;
  result.fit.balls = static_cast<std::int64_t>(result.balls.size());
  result.fit.solid = static_cast<double>(problem.outside().solid) * unit;
  result.fit.outside *= unit;
  result.fit.loss = result.fit.outside;
  result.fit.area = surface_area(mesh.vertices.span(), mesh.triangles.span());
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry

// BallDistance: the nearest pair and those below the threshold, as a table and as segments between their
// points.
#include "types/ball_distance.hpp"

#include "export/format_table.hpp"
#include "types/motion_types.hpp"

namespace ballflow {
namespace {

using geometry::BallDistance;
using geometry::Vec3;

/// Calls row(ball of a, ball of b, separation, point of a, point of b), the nearest pair first.
template <class Row>
void for_each_pair(const BallDistance& d, const Row& row) {
  // Where pairs are listed the nearest one is the first of them.
  if (d.pairs.empty()) row(d.a, d.b, d.separation, d.point_a, d.point_b);
  for (std::size_t i = 0; i < d.pairs.size(); ++i)
    row(d.pairs[i][0], d.pairs[i][1], d.separations[i], d.pair_points_a[i], d.pair_points_b[i]);
}

PolyData poly_data(const BallDistance& distance) {
  PolyData data;
  std::vector<Vec3> points;
  std::vector<Edge> edges;
  for_each_pair(distance, [&](std::int32_t, std::int32_t, double, Vec3 a, Vec3 b) {
    const auto first = static_cast<std::int32_t>(points.size());
    edges.push_back({first, first + 1});
    points.push_back(a);
    points.push_back(b);
  });
  data.points = std::move(points);
  data.edges = std::move(edges);
  return data;
}

void write_pairs(const Artifact& artifact, OutputFile& out) {
  out << "ball_a,ball_b,separation,ax,ay,az,bx,by,bz\n";
  for_each_pair(typed<BallDistance>(artifact),
                [&](std::int32_t i, std::int32_t j, double separation, Vec3 a, Vec3 b) {
                  out << i << ',' << j << ',' << separation;
                  for (const double x : {a.x, a.y, a.z, b.x, b.y, b.z}) out << ',' << x;
                  out << '\n';
                });
}

}  // namespace

TypeFormats ball_distance_formats() {
  return {"BallDistance",
          {{"csv", write_pairs},
           format<BallDistance, poly_data, write_ply>("ply"),
           format<BallDistance, poly_data, write_obj>("obj"),
           format<BallDistance, poly_data, write_vtp>("vtp")}};
}

}  // namespace ballflow

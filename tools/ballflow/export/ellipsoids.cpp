// Ellipsoids: centers, three half-axes and the quaternion of their rotation; or surfaces of triangles.
#include "export/format_table.hpp"
#include "show/icosphere.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow {
namespace {

using geometry::Ellipsoids;
using geometry::Vec3;

PolyData poly_data(const Ellipsoids& all) {
  PolyData data;
  data.points = all.centers;
  data.point_columns = {{"radius_0", {}}, {"radius_1", {}}, {"radius_2", {}}, {"rot_0", {}},
                        {"rot_1", {}},    {"rot_2", {}},    {"rot_3", {}}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3 r = all.radii[i];
    const geometry::Quaternion q = all.rotations[i];
    std::size_t column = 0;
    for (const double x : {r.x, r.y, r.z, q.w, q.x, q.y, q.z})
      data.point_columns[column++].values.push_back(x);
  }
  data.dot_every_point();
  return data;
}

/// 320 triangles each, with corners on the ellipsoid.
PolyData surfaces(const Ellipsoids& all) {
  const show::Icosphere sphere = show::icosphere(2);
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const geometry::Frame frame = geometry::frame_of(all.rotations[i]);
    const Vec3 r = all.radii[i];
    const auto first = static_cast<std::int32_t>(points.size());
    for (const Vec3 u : sphere.vertices)
      points.push_back(all.centers[i] + frame.out_of({r.x * u.x, r.y * u.y, r.z * u.z}));
    for (const auto& [a, b, c] : sphere.triangles) {
      triangles.push_back({first + static_cast<std::int32_t>(a), first + static_cast<std::int32_t>(b),
                           first + static_cast<std::int32_t>(c)});
    }
  }
  PolyData data;
  data.points = std::move(points);
  data.set_triangles(triangles);
  return data;
}

}  // namespace

TypeFormats ellipsoids_formats() {
  return {"Ellipsoids",
          {format<Ellipsoids, poly_data, write_ply>("ply"),
           format<Ellipsoids, poly_data, write_csv>("csv"),
           format<Ellipsoids, surfaces, write_obj>("obj"),
           format<Ellipsoids, surfaces, write_stl>("stl"),
           format<Ellipsoids, poly_data, write_vtp>("vtp"),
           format<Ellipsoids, poly_data, write_npy>("npy"),
           {"glb", write_glb}}};
}

}  // namespace ballflow

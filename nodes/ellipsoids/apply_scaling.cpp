#include "ellipsoids/apply_scaling.hpp"

#include <string>
#include <utility>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

template <class Map>
Array<Vec3> mapped(const Array<Vec3>& points, const Map& map) {
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.push_back(map(points[i]));
    if (!is_finite(result.back())) {
      throw InputError("point " + std::to_string(i) + " leaves the range of numbers where it is scaled",
                       "scale the model to a size near 1");
    }
  }
  return result;
}

void require_fit(const std::string& broken, const Scaling& scaling) {
  for (const std::string& cause : {broken, broken_invariant(scaling)}) {
    if (!cause.empty()) throw InputError("the input is damaged: " + cause, "compute it again");
  }
}

}  // namespace

PointSet apply_scaling(const PointSet& points, const Scaling& scaling, ScalingDirection direction) {
  require_fit(broken_invariant(points), scaling);
  const ScalingMap map(scaling);
  const bool forth = direction == ScalingDirection::forth;
  PointSet result;
  result.points = mapped(points.points, [&](Vec3 p) { return forth ? map.forth(p) : map.back(p); });
  const Frame frame = scaling.frame();
  const Vec3 f = scaling.factors;
  result.normals = mapped(points.normals, [&](Vec3 n) {
    const Vec3 v = forth ? frame.into(n) : Vec3{n.x * f.x, n.y * f.y, n.z * f.z};
    const Vec3 turned = forth ? Vec3{v.x / f.x, v.y / f.y, v.z / f.z} : frame.out_of(v);
    return 1 / length(turned) * turned;
  });
  if (const std::string broken = broken_invariant(result); !broken.empty()) {
    throw InputError("scaled points cannot be told apart: " + broken,
                     "move the model to the origin, or scale it less");
  }
  return result;
}

TriangleMesh apply_scaling(const TriangleMesh& mesh, const Scaling& scaling, ScalingDirection direction) {
  require_fit(broken_invariant(mesh), scaling);
  const ScalingMap map(scaling);
  const bool forth = direction == ScalingDirection::forth;
  return {mapped(mesh.vertices, [&](Vec3 p) { return forth ? map.forth(p) : map.back(p); }), mesh.triangles};
}

}  // namespace ballflow::geometry

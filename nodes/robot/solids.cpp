#include "robot/solids.hpp"

#include <algorithm>
#include <map>

#include "base/circle.hpp"

namespace ballflow::geometry {
namespace {

constexpr double apart = 1 + 1e-12;  // rounding, here and in what moves the mesh to its place

}  // namespace

SolidMesh box_mesh(Vec3 edges) {
  SolidMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back({(corner & 1 ? 0.5 : -0.5) * edges.x, (corner & 2 ? 0.5 : -0.5) * edges.y,
                             (corner & 4 ? 0.5 : -0.5) * edges.z});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

SolidMesh cylinder_mesh(double radius, double length) {
  constexpr int sides = 48;
  SolidMesh mesh;
  const double corner = radius / on_circle(0.5 / sides)[0] * apart;
  for (const double z : {-0.5 * length * apart, 0.5 * length * apart}) {
    mesh.vertices.push_back({0, 0, z});
    for (int i = 0; i < sides; ++i) {
      const auto [c, s] = on_circle(static_cast<double>(i) / sides);
      mesh.vertices.push_back({corner * c, corner * s, z});
    }
  }
  for (int i = 0; i < sides; ++i) {
    const int a = 1 + i, b = 1 + (i + 1) % sides, up = sides + 1;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({up, up + a, up + b});
    mesh.triangles.push_back({a, b, up + b});
    mesh.triangles.push_back({a, up + b, up + a});
  }
  return mesh;
}

SolidMesh ball_mesh_around(double radius) {
  SolidMesh mesh;
  // An octahedron, whose triangles are cut into four: points of the sphere, moved out at the end.
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < 4; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [known, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (fresh) {
        const Vec3 sum =
            mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)];
        mesh.vertices.push_back((1 / length(sum)) * sum);
      }
      return known->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    mesh.triangles = std::move(finer);
  }
  double nearest = 1;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 normal = cross(mesh.vertices[static_cast<std::size_t>(t[1])] - a,
                              mesh.vertices[static_cast<std::size_t>(t[2])] - a);
    nearest = std::min(nearest, dot(normal, a) / length(normal));
  }
  for (Vec3& v : mesh.vertices) v = (radius / nearest * apart) * v;
  return mesh;
}

}  // namespace ballflow::geometry

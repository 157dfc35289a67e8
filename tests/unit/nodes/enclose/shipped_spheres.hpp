// Links of robots with the spheres that other programs ship for them, from the test data.
#pragma once

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/file_content.hpp"
#include "test_data.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct ShippedSpheres {
  std::string name;  // "curobo-panda_hand"
  TriangleMesh mesh;
  Balls balls;
  // What 100 000 samples of the surface said: the share of it that is in no ball, and how far a sample is
  // from the balls at most.
  double outside = 0, gap = 0;
};

/// All of them; none where the test data is absent.
inline std::vector<ShippedSpheres> shipped_spheres() {
  std::vector<ShippedSpheres> result;
  std::ifstream lines(test::data_file("spheres/measured.txt"));
  for (std::string line; std::getline(lines, line);) {
    char name[64];
    double outside = 0, gap = 0;
    const std::size_t share = line.find("surf-unc"), far = line.find("maxgap");
    if (share == std::string::npos || std::sscanf(line.c_str(), "%63s", name) != 1 ||
        std::sscanf(line.c_str() + share, "surf-unc %lf%%", &outside) != 1 ||
        std::sscanf(line.c_str() + far, "maxgap %lfmm", &gap) != 1)
      continue;
    const std::string file = test::data_file("spheres/" + std::string(name) + ".gz");
    std::istringstream in(std::string(read_file_content(file, 1 << 24).view()));
    std::size_t triangle_count = 0, ball_count = 0;
    in >> triangle_count >> ball_count;
    std::vector<Vec3> vertices(3 * triangle_count), centers(ball_count);
    std::vector<Triangle> triangles;
    std::vector<double> radii(ball_count);
    for (Vec3& v : vertices) in >> v.x >> v.y >> v.z;
    for (std::size_t i = 0; i < ball_count; ++i)
      in >> centers[i].x >> centers[i].y >> centers[i].z >> radii[i];
    for (std::size_t t = 0; t < triangle_count; ++t) {
      const auto k = static_cast<std::int32_t>(3 * t);
      triangles.push_back({k, k + 1, k + 2});
    }
    std::string stem(name);
    stem.resize(stem.find(".txt"));
    result.push_back({std::move(stem),
                      {std::move(vertices), std::move(triangles)},
                      {std::move(centers), std::move(radii), {}, {}},
                      outside / 100,
                      gap / 1000});
  }
  return result;
}

}  // namespace ballflow::geometry

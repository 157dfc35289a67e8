// Surfaces from clouds by CGAL, and what holds of any surface: the program behind tools/bench_reconstruction.
//
//   bench_reconstruction cloud MODEL OUT.xyz [noise=0.1] [density=10] [holes=5]
//       the vertices of the model with the normals of its faces: moved by Gaussian noise, % of the longest
//       edge of the box per coordinate; thinned out along that edge, to one in ten at its end; without what
//       is within 4 % of that edge of as many vertices
//   bench_reconstruction front|scale_space|poisson CLOUD.xyz OUT.off     prints CPU seconds; normals are
//   given to poisson bench_reconstruction measure MESH.off MODEL                          prints a line of
//   JSON
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "cgal_reconstructions.hpp"
#include "sample/sample.hpp"
#include "search/surface_tree.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

MeshFile model_of(const std::string& file) {
  SampleOptions options;
  options.file = file;
  return sample(options, 0);
}

std::vector<Vec3> normals_of(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = cross(mesh.vertices[at(t[1])] - mesh.vertices[at(t[0])],
                         mesh.vertices[at(t[2])] - mesh.vertices[at(t[0])]);
    for (const std::int32_t v : t) normals[at(v)] = normals[at(v)] + n;
  }
  for (Vec3& n : normals) {
    const double l = length(n);
    n = l > 0 ? 1 / l * n : Vec3{0, 0, 1};
  }
  return normals;
}

double gaussian(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

int make_cloud(const std::string& model, const std::string& out,
               const std::vector<std::string_view>& wishes) {
  const MeshFile file = model_of(model);
  double noise = 0, density = 1;
  int holes = 0;
  for (const std::string_view wish : wishes) {
    const std::size_t equals = wish.find('=');
    const double value = std::atof(std::string(wish.substr(equals + 1)).c_str());
    if (wish.starts_with("noise=")) noise = value;
    if (wish.starts_with("density=")) density = value;
    if (wish.starts_with("holes=")) holes = static_cast<int>(value);
  }
  const auto& vertices = file.mesh.vertices;
  const std::vector<Vec3> normals = normals_of(file.mesh);
  const Box box = bounding_box(vertices.span());
  const double longest = box.longest_edge();
  const Vec3 size = box.upper - box.lower;
  const auto along = [&](Vec3 p) {
    return size.x == longest ? p.x - box.lower.x : size.y == longest ? p.y - box.lower.y : p.z - box.lower.z;
  };
  Random random(1);
  std::vector<Vec3> middles;
  for (int i = 0; i < holes; ++i) middles.push_back(vertices[random.bits() % vertices.size()]);
  std::ofstream stream(out);
  stream.precision(17);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Vec3 p = vertices[i];
    const double kept = std::pow(density, -along(p) / longest), chance = random.unit();
    const Vec3 moved{gaussian(random), gaussian(random), gaussian(random)};
    bool hidden = chance >= kept;
    for (const Vec3& m : middles) hidden = hidden || distance(p, m) < 0.04 * longest;
    if (hidden) continue;
    p = p + noise / 100 * longest * moved;
    stream << p.x << ' ' << p.y << ' ' << p.z << ' ' << normals[i].x << ' ' << normals[i].y << ' '
           << normals[i].z << '\n';
  }
  return stream ? 0 : 1;
}

int reconstruct(const std::string& method, const std::string& cloud, const std::string& out) {
  std::ifstream in(cloud);
  std::vector<Vec3> points, normals;
  for (Vec3 p, n; in >> p.x >> p.y >> p.z >> n.x >> n.y >> n.z;) {
    points.push_back(p);
    normals.push_back(n);
  }
  const std::clock_t begin = std::clock();
  const TriangleMesh mesh = method == "front"         ? bench::advancing_front(points)
                            : method == "scale_space" ? bench::scale_space(points)
                                                      : bench::poisson(points, normals);
  std::printf("%.3f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  std::ofstream stream(out);
  stream.precision(17);
  stream << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Vec3& p : mesh.vertices) stream << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& [a, b, c] : mesh.triangles) stream << "3 " << a << ' ' << b << ' ' << c << '\n';
  return stream ? 0 : 1;
}

/// As it is: vertices at one place stay apart, those of no triangle are left out.
TriangleMesh read_off(const std::string& file) {
  std::ifstream in(file);
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  in >> word >> vertices >> faces >> edges;
  std::vector<Vec3> read(vertices);
  for (Vec3& p : read) in >> p.x >> p.y >> p.z;
  std::vector<Triangle> triangles(faces);
  std::vector<std::int32_t> place(vertices, -1);
  std::vector<Vec3> used;
  for (Triangle& t : triangles) {
    std::size_t corners = 0;
    in >> corners;
    for (std::int32_t& v : t) {
      in >> v;
      if (!in || corners != 3 || v < 0 || at(v) >= vertices)
        throw std::runtime_error("no triangles in " + file);
      if (place[at(v)] < 0) {
        place[at(v)] = static_cast<std::int32_t>(used.size());
        used.push_back(read[at(v)]);
      }
      v = place[at(v)];
    }
  }
  return {std::move(used), std::move(triangles)};
}

/// The largest distance and the mean one of the vertices of a mesh, and of 100 000 places spread by area,
/// from another.
std::array<double, 2> distances(const TriangleMesh& from, const SurfaceTree& to) {
  Random random(2);
  double most = 0, sum = 0;
  const auto look_at = [&](Vec3 p) {
    const double d = to.nearest(p, 1e300)->distance;
    most = std::max(most, d);
    return d;
  };
  for (const Vec3& p : from.vertices) look_at(p);
  std::vector<double> upto{0};
  for (const Triangle& t : from.triangles) {
    const Vec3 a = from.vertices[at(t[0])];
    upto.push_back(upto.back() + length(cross(from.vertices[at(t[1])] - a, from.vertices[at(t[2])] - a)));
  }
  constexpr int places = 100000;
  for (int i = 0; i < places; ++i) {
    const auto found = std::upper_bound(upto.begin(), upto.end() - 1, upto.back() * random.unit());
    const Triangle& t = from.triangles[static_cast<std::size_t>(found - upto.begin() - 1)];
    double u = random.unit(), v = random.unit();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 a = from.vertices[at(t[0])];
    sum += look_at(a + u * (from.vertices[at(t[1])] - a) + v * (from.vertices[at(t[2])] - a));
  }
  return {most, sum / places};
}

int measure(const std::string& file, const std::string& model) {
  const TriangleMesh mesh = read_off(file);
  const MeshFile truth = model_of(model);
  const MeshTopology topology = mesh_topology(mesh), right = mesh_topology(truth.mesh);
  std::array<double, 2> there{-1, -1}, back{-1, -1};
  if (!mesh.triangles.empty()) {
    const double percent = 100 / bounding_box(truth.mesh.vertices.span()).longest_edge();
    there = distances(mesh, SurfaceTree(truth.mesh));
    back = distances(truth.mesh, SurfaceTree(mesh));
    for (double* d : {&there[0], &there[1], &back[0], &back[1]}) *d *= percent;
  }
  std::printf(
      "{\"faces\": %lld, \"closed\": %d, \"manifold\": %d, \"genus\": %lld, \"components\": %lld, "
      "\"boundary_edges\": %lld, "
      "\"right_genus\": %lld, \"right_components\": %lld, \"there\": %.4f, \"back\": %.4f, \"mean\": %.4f}\n",
      static_cast<long long>(topology.faces), topology.closed ? 1 : 0, topology.manifold ? 1 : 0,
      static_cast<long long>(topology.genus), static_cast<long long>(topology.components),
      static_cast<long long>(topology.boundary_edges), static_cast<long long>(right.genus),
      static_cast<long long>(right.components), there[0], back[0], std::max(there[1], back[1]));
  return 0;
}

int run(const std::vector<std::string>& words) {
  if (words.size() >= 3 && words[0] == "cloud")
    return make_cloud(words[1], words[2], {words.begin() + 3, words.end()});
  if (words.size() == 3 && (words[0] == "front" || words[0] == "scale_space" || words[0] == "poisson"))
    return reconstruct(words[0], words[1], words[2]);
  if (words.size() == 3 && words[0] == "measure") return measure(words[1], words[2]);
  std::fprintf(stderr,
               "usage: bench_reconstruction cloud|front|scale_space|poisson|measure ... "
               "(tools/bench_reconstruction)\n");
  return 2;
}

}  // namespace
}  // namespace ballflow::geometry

int main(int count, char** words) {
  try {
    return ballflow::geometry::run({words + 1, words + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_reconstruction: %s\n", error.what());
    return 1;
  }
}

// ma and sph: balls and medial axes as the programs of the field exchange them.
#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {
namespace {

void ball(const PolyData& data, std::size_t i, OutputFile& out) {
  text(out, data.points[i]);
  out << ' ' << (data.radii ? (*data.radii)[i] : 0.0) << '\n';
}

}  // namespace

void write_ma(const PolyData& data, OutputFile& out) {
  const std::vector<Triangle> triangles = triangles_of(data);
  const std::vector<Edge> edges = edges_of(data, triangles);
  out << data.points.size() << ' ' << edges.size() << ' ' << triangles.size() << '\n';
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    out << "v ";
    ball(data, i, out);
  }
  for (const auto& [a, b] : edges) out << "e " << a << ' ' << b << '\n';
  for (const auto& [a, b, c] : triangles) out << "f " << a << ' ' << b << ' ' << c << '\n';
}

void write_sph(const PolyData& data, OutputFile& out) {
  out << data.points.size() << '\n';
  for (std::size_t i = 0; i < data.points.size(); ++i) ball(data, i, out);
}

}  // namespace ballflow

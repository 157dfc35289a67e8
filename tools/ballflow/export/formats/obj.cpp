#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {
namespace {

/// OBJ counts from 1.
template <class Indices>
void element(OutputFile& out, char kind, const Indices& indices) {
  out << kind;
  for (const std::int32_t i : indices) out << ' ' << std::int64_t{i} + 1;
  out << '\n';
}

}  // namespace

void write_obj(const PolyData& data, OutputFile& out) {
  if (data.radii) out << "# radii of the vertices are in ply, vtp and csv exports\n";
  for (const geometry::Vec3 p : data.points) {
    out << "v ";
    text(out, p);
    out << '\n';
  }
  for (std::size_t i = 0; i < data.polygons(); ++i) element(out, 'f', data.polygon(i));
  for (const Edge& edge : data.edges) element(out, 'l', edge);
}

}  // namespace ballflow

#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {

void write_off(const PolyData& data, OutputFile& out) {
  out << "OFF\n" << data.points.size() << ' ' << data.polygons() << " 0\n";
  for (const geometry::Vec3 p : data.points) {
    text(out, p);
    out << '\n';
  }
  for (std::size_t i = 0; i < data.polygons(); ++i) {
    const auto corners = data.polygon(i);
    out << corners.size();
    for (const std::int32_t v : corners) out << ' ' << v;
    out << '\n';
  }
}

}  // namespace ballflow

#include <string>

#include "export/formats.hpp"

namespace ballflow {

void write_npy(const PolyData& data, OutputFile& out) {
  const bool radii = data.radii.has_value();
  const std::size_t width = 3 + (radii ? 1 : 0) + data.point_columns.size();
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(data.points.size()) + ", " + std::to_string(width) + "), }";
  // Magic number, version, length and header together are a multiple of 64 bytes; a line end is the last.
  constexpr std::size_t before_header = 10;
  header.append(63 - (before_header + header.size()) % 64, ' ');
  header += '\n';
  out << std::string_view("\x93NUMPY\x01\x00", 8);
  out.raw(static_cast<std::uint16_t>(header.size()));
  out << std::string_view(header);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    for (const double value : {data.points[i].x, data.points[i].y, data.points[i].z}) out.raw(value);
    if (radii) out.raw((*data.radii)[i]);
    for (const Column& column : data.point_columns) out.raw(column.values[i]);
  }
}

}  // namespace ballflow

// Points as lines of text: csv and xyz.
#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {
namespace {

void point_and_normal(const PolyData& data, std::size_t i, OutputFile& out, char separator) {
  text(out, data.points[i], separator);
  if (data.normals.empty()) return;
  out << separator;
  text(out, data.normals[i], separator);
}

}  // namespace

void write_xyz(const PolyData& data, OutputFile& out) {
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    point_and_normal(data, i, out, ' ');
    out << '\n';
  }
}

void write_csv(const PolyData& data, OutputFile& out) {
  out << "x,y,z";
  if (!data.normals.empty()) out << ",nx,ny,nz";
  if (data.radii) out << ",r";
  for (const Column& column : data.point_columns) out << ',' << column.name;
  if (!data.point_codes.name.empty()) out << ',' << data.point_codes.name;
  if (!data.point_numbers.name.empty()) out << ',' << data.point_numbers.name;
  out << '\n';
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    point_and_normal(data, i, out, ',');
    if (data.radii) out << ',' << (*data.radii)[i];
    for (const Column& column : data.point_columns) out << ',' << column.values[i];
    if (!data.point_codes.name.empty()) out << ',' << int{data.point_codes.values[i]};
    if (!data.point_numbers.name.empty()) out << ',' << data.point_numbers.values[i];
    out << '\n';
  }
}

}  // namespace ballflow

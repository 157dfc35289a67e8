// The layout: an XML head names every array with the offset of its block, then "_" and the blocks follow,
// each the number of its bytes (UInt64) and these. Cells are in the order in which VTK counts them: vertices,
// lines, polygons.
#include <functional>
#include <string>
#include <utility>

#include "export/formats.hpp"

namespace ballflow {
namespace {

using Fill = std::function<void(OutputFile&)>;

class Head {
 public:
  void open(const std::string& tag) { text_ += "<" + tag + ">\n"; }
  void close(const std::string& tag) { text_ += "</" + tag + ">\n"; }
  /// Adds a DataArray of `bytes` bytes that `fill` writes.
  void array(const std::string& type, std::string_view name, int components, std::size_t bytes, Fill fill) {
    text_ += "<DataArray type=\"" + type + "\" Name=\"" + std::string(name) + "\" NumberOfComponents=\"" +
             std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(offset_) +
             "\"/>\n";
    offset_ += sizeof(std::uint64_t) + bytes;
    blocks_.emplace_back(bytes, std::move(fill));
  }
  void write(OutputFile& out) const {
    out << std::string_view(text_) << "<AppendedData encoding=\"raw\">\n_";
    for (const auto& [bytes, fill] : blocks_) {
      out.raw(std::uint64_t{bytes});
      fill(out);
    }
    out << "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string text_;
  std::size_t offset_ = 0;
  std::vector<std::pair<std::size_t, Fill>> blocks_;
};

template <class T>
Fill elements(const geometry::Array<T>& values) {
  return [values](OutputFile& out) { out.write(values.data(), values.size() * sizeof(T)); };
}

/// The cells of a section: corners of all of them, and where each one ends.
void cells(Head& head, const std::string& section, std::span<const std::int32_t> corners, std::size_t count,
           const std::function<std::int64_t(std::size_t)>& end) {
  constexpr std::size_t size = sizeof(std::int64_t);
  head.open(section);
  head.array("Int64", "connectivity", 1, corners.size() * size, [corners](OutputFile& out) {
    for (const std::int32_t v : corners) out.raw(std::int64_t{v});
  });
  head.array("Int64", "offsets", 1, count * size, [count, end](OutputFile& out) {
    for (std::size_t i = 0; i < count; ++i) out.raw(end(i));
  });
  head.close(section);
}

}  // namespace

void write_vtp(const PolyData& data, OutputFile& out) {
  const auto attribute = [](const char* name, std::size_t value) {
    return std::string(" ") + name + "=\"" + std::to_string(value) + "\"";
  };
  Head head;
  head.open("?xml version=\"1.0\"?");
  head.open("VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"");
  head.open("PolyData");
  head.open("Piece" + attribute("NumberOfPoints", data.points.size()) +
            attribute("NumberOfVerts", data.dots.size()) + attribute("NumberOfLines", data.edges.size()) +
            attribute("NumberOfStrips", 0) + attribute("NumberOfPolys", data.polygons()));
  head.open("Points");
  head.array("Float64", "Points", 3, data.points.size() * sizeof(geometry::Vec3), elements(data.points));
  head.close("Points");

  head.open("PointData");
  if (!data.normals.empty()) {
    head.array("Float64", "Normals", 3, data.normals.size() * sizeof(geometry::Vec3), elements(data.normals));
  }
  if (data.radii) {
    head.array("Float64", "radius", 1, data.radii->size() * sizeof(double), elements(*data.radii));
  }
  for (const Column& column : data.point_columns) {
    head.array("Float64", column.name, 1, column.values.size() * sizeof(double), [&column](OutputFile& to) {
      to.write(column.values.data(), column.values.size() * sizeof(double));
    });
  }
  if (const auto& codes = data.point_codes; !codes.name.empty()) {
    head.array("UInt8", codes.name, 1, codes.values.size(), elements(codes.values));
  }
  if (const auto& numbers = data.point_numbers; !numbers.name.empty()) {
    head.array("Int32", numbers.name, 1, numbers.values.size() * sizeof(std::int32_t),
               elements(numbers.values));
  }
  head.close("PointData");

  head.open("CellData");
  const std::size_t others = data.dots.size() + data.edges.size();
  if (const auto& codes = data.polygon_codes; !codes.name.empty()) {
    head.array("UInt8", codes.name, 1, others + codes.values.size(), [&data, others](OutputFile& to) {
      for (std::size_t i = 0; i < others; ++i) to.raw(data.dot_and_edge_code);
      elements(data.polygon_codes.values)(to);
    });
  }
  if (const auto& numbers = data.polygon_numbers; !numbers.name.empty()) {
    const std::size_t bytes = (others + numbers.values.size()) * sizeof(std::int32_t);
    head.array("Int32", numbers.name, 1, bytes, [&data, others](OutputFile& to) {
      for (std::size_t i = 0; i < others; ++i) to.raw(std::int32_t{-1});
      elements(data.polygon_numbers.values)(to);
    });
  }
  head.close("CellData");

  std::vector<std::int32_t> ends;
  ends.reserve(2 * data.edges.size());
  for (const Edge& edge : data.edges) ends.insert(ends.end(), edge.begin(), edge.end());
  cells(head, "Verts", data.dots, data.dots.size(),
        [](std::size_t i) { return static_cast<std::int64_t>(i) + 1; });
  cells(head, "Lines", ends, data.edges.size(),
        [](std::size_t i) { return 2 * (static_cast<std::int64_t>(i) + 1); });
  cells(head, "Polys", data.polygon_corners, data.polygons(),
        [&data](std::size_t i) { return data.polygon_offsets[i + 1]; });
  head.close("Piece");
  head.close("PolyData");
  head.write(out);
}

}  // namespace ballflow

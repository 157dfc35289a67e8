// Model files made by tests: one mesh in every format the readers know.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "io/read_mesh.hpp"

namespace ballflow::test {

/// Shortest text that reads back as the same double.
inline std::string text(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}
inline std::string text(const geometry::Vec3& p) { return text(p.x) + " " + text(p.y) + " " + text(p.z); }

template <class T>
void append(std::string& out, T value, bool big_endian = false) {
  std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian) std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

/// A closed mesh of 20 vertices, numbered by first appearance in the triangles, with coordinates that are
/// floats: what every format can hold, STL included.
inline geometry::TriangleMesh small_mesh() {
  // A tube of four pentagons between two fans; radii and heights break every symmetry.
  std::vector<geometry::Vec3> v;
  std::vector<geometry::Triangle> t;
  const std::array<std::array<double, 2>, 5> ring = {
      {{1, 0}, {0.3125, 0.953125}, {-0.8125, 0.5625}, {-0.8125, -0.59375}, {0.28125, -0.9375}}};
  for (int k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < 5; ++i)
      v.push_back({(1 + 0.125 * k) * ring[i][0], ring[i][1], k + 0.0625 * ring[(i + 1) % 5][0]});
  }
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 5; ++i) {
      const int a = 5 * k + i, b = 5 * k + (i + 1) % 5;
      t.push_back({a, b, b + 5});
      t.push_back({a, b + 5, a + 5});
    }
  }
  for (int i = 1; i < 4; ++i) {
    t.push_back({0, i + 1, i});
    t.push_back({15, 15 + i, 16 + i});
  }
  std::vector<int> id(v.size(), -1);
  std::vector<geometry::Vec3> ordered;
  for (auto& triangle : t) {
    for (auto& corner : triangle) {
      int& number = id[static_cast<std::size_t>(corner)];
      if (number < 0) {
        number = static_cast<int>(ordered.size());
        ordered.push_back(v[static_cast<std::size_t>(corner)]);
      }
      corner = number;
    }
  }
  return {ordered, t};
}

/// A unit normal for every vertex of any mesh, different for neighbours.
inline geometry::Vec3 made_up_normal(std::size_t vertex) {
  static constexpr std::array<geometry::Vec3, 5> normals = {
      {{1, 0, 0}, {0, -1, 0}, {0.6, 0, 0.8}, {0, 0.28, -0.96}, {0, 0, 1}}};
  return normals[vertex % 5];
}

inline std::string as_off(const geometry::TriangleMesh& m, bool normals = false, bool colours = false) {
  std::string out = std::string(colours ? "C" : "") + (normals ? "N" : "") + "OFF\n# made by a test\n" +
                    std::to_string(m.vertices.size()) + " " + std::to_string(m.triangles.size()) + " 0\n\n";
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    out += text(m.vertices[v]) + (normals ? " " + text(made_up_normal(v)) : "") +
           (colours ? " 255 0 0 255" : "") + "\n";
  }
  for (const auto& t : m.triangles) {
    out += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) +
           (colours ? " 0.5 0.5 0.5" : "") + "\n";
  }
  return out;
}

inline std::string as_obj(const geometry::TriangleMesh& m, bool normals = false, bool negative = false) {
  std::string out = "# made by a test\nmtllib none.mtl\no thing\n";
  for (const auto& p : m.vertices) out += "v " + text(p) + "\n";
  if (normals) {
    for (std::size_t v = 0; v < m.vertices.size(); ++v) out += "vn " + text(made_up_normal(v)) + "\n";
  }
  for (const auto& t : m.triangles) {
    out += "f";
    for (const int corner : t) {
      const std::string index =
          std::to_string(negative ? corner - static_cast<int>(m.vertices.size()) : corner + 1);
      out += " " + index + (normals ? "//" + index : "");
    }
    out += "\n";
  }
  return out;
}

enum class Ply { ascii, little, big };

/// With other elements and properties before, between and after those that matter when `extras`.
inline std::string as_ply(const geometry::TriangleMesh& m, Ply encoding, bool normals = false,
                          bool extras = false) {
  const bool ascii = encoding == Ply::ascii, big = encoding == Ply::big;
  std::string out = std::string("ply\nformat ") +
                    (ascii ? "ascii"
                     : big ? "binary_big_endian"
                           : "binary_little_endian") +
                    " 1.0\ncomment made by a test\n";
  if (extras) out += "element camera 1\nproperty double view\nproperty list uchar short dots\n";
  out += "element vertex " + std::to_string(m.vertices.size()) + "\n";
  if (extras) out += "property uchar red\n";
  out += "property double x\nproperty float y\n";
  if (extras) out += "property list uchar float weights\n";
  out += "property double z\n";
  if (normals) out += "property double nx\nproperty double ny\nproperty double nz\n";
  out += "element face " + std::to_string(m.triangles.size()) + "\n";
  if (extras) out += "property ushort flags\n";
  out += "property list uchar int vertex_indices\n";
  if (extras) out += "property list int int8 tags\nelement empty 7\nelement edge 1\nproperty int a\n";
  out += "end_header\n";
  const auto put = [&](auto value) {
    if (!ascii) {
      append(out, value, big);
    } else if constexpr (std::is_floating_point_v<decltype(value)>) {
      out += text(static_cast<double>(value)) + " ";
    } else {
      out += std::to_string(value) + " ";
    }
  };
  const auto end = [&] {
    if (ascii) out += "\n";
  };
  if (extras) {
    put(0.5);
    put(std::uint8_t{2});
    put(std::int16_t{-3});
    put(std::int16_t{4});
    end();
  }
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    const auto& p = m.vertices[v];
    if (extras) put(std::uint8_t{200});
    put(p.x);
    put(static_cast<float>(p.y));
    if (extras) {
      put(static_cast<std::uint8_t>(v % 3));
      for (std::size_t i = 0; i < v % 3; ++i) put(0.25f);
    }
    put(p.z);
    if (normals) {
      const auto n = made_up_normal(v);
      put(n.x);
      put(n.y);
      put(n.z);
    }
    end();
  }
  for (const auto& t : m.triangles) {
    if (extras) put(std::uint16_t{65535});
    put(std::uint8_t{3});
    for (const std::int32_t corner : t) put(corner);
    if (extras) {
      put(std::int32_t{1});
      put(std::int8_t{-1});
    }
    end();
  }
  if (extras) put(std::int32_t{1});
  return out;
}

inline std::string as_ascii_stl(const geometry::TriangleMesh& m) {
  std::string out = "solid made by a test\n";
  for (const auto& t : m.triangles) {
    out += "  facet normal 0 0 0\n    outer loop\n";
    for (const int corner : t)
      out += "      vertex " + text(m.vertices[static_cast<std::size_t>(corner)]) + "\n";
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid made by a test\n";
}

inline std::string as_binary_stl(const geometry::TriangleMesh& m, const std::string& header = "binary") {
  std::string out = header;
  out.resize(80, ' ');
  append(out, static_cast<std::uint32_t>(m.triangles.size()));
  for (const auto& t : m.triangles) {
    for (int i = 0; i < 3; ++i) append(out, 0.0f);
    for (const int corner : t) {
      const auto& p = m.vertices[static_cast<std::size_t>(corner)];
      append(out, static_cast<float>(p.x));
      append(out, static_cast<float>(p.y));
      append(out, static_cast<float>(p.z));
    }
    append(out, std::uint16_t{0});
  }
  return out;
}

inline std::string as_xyz(const geometry::TriangleMesh& m, bool normals = false, bool counted = false) {
  std::string out = counted ? std::to_string(m.vertices.size()) + "\n" : "# made by a test\n";
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    out += text(m.vertices[v]) + (normals ? " " + text(made_up_normal(v)) : "") + "\n";
  }
  return out;
}

inline std::string gzipped(std::string_view content) {
  z_stream z{};
  deflateInit2(&z, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, content.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  z.avail_in = static_cast<uInt>(content.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

}  // namespace ballflow::test

#include "volume/label_surface.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

template <class T>
std::string bytes_of(T value, bool swapped = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

template <class T>
std::string bytes_of_all(const std::vector<std::int32_t>& labels, bool swapped = false) {
  std::string bytes;
  for (const std::int32_t label : labels) bytes += bytes_of(static_cast<T>(label), swapped);
  return bytes;
}

std::string gzipped(const std::string& content) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(compressBound(content.size()) + 64, '\0');
  std::vector<unsigned char> in(content.begin(), content.end());
  stream.next_in = in.data();
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<unsigned char*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// Two boxes that touch, labels 1 and 7, in a 9 x 7 x 6 image.
LabelVolume two_boxes() {
  LabelVolume v;
  v.size = {9, 7, 6};
  v.steps = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) {
        const bool a = x >= 1 && x <= 4 && y >= 2 && y <= 5 && z <= 3,
                   b = x >= 5 && x <= 7 && y >= 2 && y <= 5 && z <= 3;
        v.labels.push_back(a ? 1 : b ? 7 : 0);
      }
  return v;
}

std::string nrrd(const LabelVolume& v, const std::string& type, const std::string& encoding,
                 const std::string& data,
                 const std::string& place =
                     "space directions: (0.5,0.1,0) (0,0.7,0.2) (-0.1,0,2)\nspace origin: (10,-20,30)\n") {
  return "NRRD0004\n# a comment\ntype: " + type +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes: " + std::to_string(v.size[0]) + " " +
         std::to_string(v.size[1]) + " " + std::to_string(v.size[2]) + "\n" + place +
         "kinds: domain domain domain\nendian: little\nencoding: " + encoding + "\nkey:=value\n\n" + data;
}

struct Header {
  bool swapped = false;
  std::string bytes = std::string(352, '\0');
  template <class T>
  void put(std::size_t at, T value) {
    bytes.replace(at, sizeof(T), bytes_of(value, swapped));
  }
};

Header nifti(const LabelVolume& v, std::int16_t type, bool swapped) {
  Header h;
  h.swapped = swapped;
  h.put<std::int32_t>(0, 348);
  h.put<std::int16_t>(40, 3);
  for (std::size_t a = 0; a < 3; ++a) h.put<std::int16_t>(42 + 2 * a, static_cast<std::int16_t>(v.size[a]));
  h.put<std::int16_t>(70, type);
  h.put<float>(76, 1);
  for (std::size_t a = 0; a < 3; ++a) h.put<float>(80 + 4 * a, 0.5F + static_cast<float>(a));
  h.put<float>(108, 352);
  h.bytes.replace(344, 3, "n+1");
  return h;
}

double signed_volume(const TriangleMesh& mesh) {
  double six = 0;
  const Vec3 o = mesh.vertices[0];
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])] - o; };
    six += dot(at(0), cross(at(1), at(2)));
  }
  return six / 6;
}

/// The volume in voxels: of a tetrahedron of volume 1/6 with so many corners inside 0, 1/8, 1/2, 7/8, 1.
double counted_volume(const LabelVolume& v, std::int32_t label) {
  const auto in = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z < 0 || x >= v.size[0] || y >= v.size[1] || z >= v.size[2]) return false;
    const std::int32_t l = v.labels[static_cast<std::size_t>((z * v.size[1] + y) * v.size[0] + x)];
    return label == 0 ? l != 0 : l == label;
  };
  constexpr std::array<double, 5> part{0, 1 / 8.0, 1 / 2.0, 7 / 8.0, 1};
  double volume = 0;
  for (int z = -1; z < v.size[2]; ++z)
    for (int y = -1; y < v.size[1]; ++y)
      for (int x = -1; x < v.size[0]; ++x) {
        std::array<int, 3> axes{0, 1, 2};
        do {
          std::array<int, 3> p{x, y, z};
          std::size_t inside = in(p[0], p[1], p[2]);
          for (const int axis : axes) {
            ++p[static_cast<std::size_t>(axis)];
            inside += in(p[0], p[1], p[2]);
          }
          volume += part[inside] / 6;
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
  return volume;
}

std::string refusal(const auto& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

void expect_closed(const TriangleMesh& mesh) {
  const MeshTopology topology = mesh_topology(mesh);
  EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
}

}  // namespace

TEST(LabelSurface, of_any_voxels_is_a_closed_manifold_with_the_volume_that_tetrahedra_say) {
  Random random(4);
  for (int k = 0; k < 12; ++k) {
    LabelVolume v;
    v.size = {5, 4, 6};
    for (int i = 0; i < 120; ++i) v.labels.push_back(random.unit() < 0.1 + 0.07 * k ? 1 + i % 2 : 0);
    // Oblique, unequal steps, also mirrored ones.
    v.steps = {Vec3{0.5, 0.1, 0}, {k % 2 == 0 ? 0.2 : -0.2, k % 2 == 0 ? 0.7 : -0.7, 0.1}, {-0.1, 0.3, 2}};
    v.origin = {10, 20, -30};
    const double voxel = std::abs(dot(cross(v.steps[0], v.steps[1]), v.steps[2]));
    for (const std::int32_t label : {0, 1, 2}) {
      const TriangleMesh mesh = label_surface(v, {label});
      expect_closed(mesh);
      const double expected = counted_volume(v, label) * voxel;
      EXPECT_NEAR(signed_volume(mesh), expected, 1e-9 * expected) << label;
    }
  }
}

TEST(LabelSurface, lies_halfway_between_voxels_in_the_place_that_the_file_says) {
  const LabelVolume v = two_boxes();
  const TriangleMesh one = label_surface(v, {7});
  const Box box = bounding_box(one.vertices.span());
  EXPECT_EQ(box.lower, (Vec3{4.5, 1.5, -0.5}));
  EXPECT_EQ(box.upper, (Vec3{7.5, 5.5, 3.5}));
  EXPECT_EQ(mesh_topology(label_surface(v)).components, 1);
  EXPECT_NE(refusal([&] { (void)label_surface(v, {3}); }).find("labels there are: 1, 7"), std::string::npos);
  LabelVolume empty = v;
  std::fill(empty.labels.begin(), empty.labels.end(), 0);
  EXPECT_NE(refusal([&] { (void)label_surface(empty); }).find("every voxel is 0"), std::string::npos);
}

TEST(LabelVolume, nrrd_is_read_in_all_its_encodings) {
  const LabelVolume v = two_boxes();
  std::string text;
  for (const std::int32_t label : v.labels) text += std::to_string(label) + "\n";
  const std::vector<std::string> files = {
      nrrd(v, "unsigned char", "raw", bytes_of_all<std::uint8_t>(v.labels)),
      nrrd(v, "short", "gzip", gzipped(bytes_of_all<std::int16_t>(v.labels))),
      nrrd(v, "float", "raw", bytes_of_all<float>(v.labels)), nrrd(v, "uint32", "ascii", text)};
  for (const std::string& file : files) {
    const LabelVolume read = parse_label_volume(file);
    EXPECT_EQ(read.size, v.size);
    EXPECT_TRUE(read.labels == v.labels);
    // Left and back are minus right and minus front.
    EXPECT_EQ(read.origin, (Vec3{-10, 20, 30}));
    EXPECT_EQ(read.steps[1], (Vec3{0, -0.7, 0.2}));
    EXPECT_EQ(read.frame, patient_frame);
  }
  const LabelVolume spaced = parse_label_volume(
      nrrd(v, "uchar", "raw", bytes_of_all<std::uint8_t>(v.labels), "spacings: 0.5 0.5 3\n"));
  EXPECT_EQ(spaced.steps[2], (Vec3{0, 0, 3}));
}

TEST(LabelVolume, nifti_is_read_in_both_byte_orders_with_either_orientation) {
  const LabelVolume v = two_boxes();
  for (const bool swapped : {false, true}) {
    Header plain = nifti(v, 4, swapped);
    const std::string data = bytes_of_all<std::int16_t>(v.labels, swapped);
    const LabelVolume read = parse_label_volume(plain.bytes + data);
    EXPECT_TRUE(read.labels == v.labels);
    EXPECT_EQ(read.steps[1], (Vec3{0, 1.5, 0}));

    Header quaternion = plain;  // half a turn about z with the third axis flipped
    quaternion.put<std::int16_t>(252, 1);
    quaternion.put<float>(76, -1);
    quaternion.put<float>(264, 1);
    quaternion.put<float>(268, 5);
    const LabelVolume turned = parse_label_volume(quaternion.bytes + data);
    EXPECT_EQ(turned.steps[0], (Vec3{-0.5, 0, 0}));
    EXPECT_EQ(turned.steps[1], (Vec3{0, -1.5, 0}));
    EXPECT_EQ(turned.steps[2], (Vec3{0, 0, -2.5}));
    EXPECT_EQ(turned.origin, (Vec3{5, 0, 0}));

    Header matrix = quaternion;  // the sform comes first
    matrix.put<std::int16_t>(254, 1);
    const std::array<float, 12> rows{1, 0.5F, 0, 7, 0, 2, 0, 8, 0, 0, 4, 9};
    for (std::size_t k = 0; k < 12; ++k) matrix.put<float>(280 + 4 * k, rows[k]);
    const LabelVolume oblique = parse_label_volume(matrix.bytes + data);
    EXPECT_EQ(oblique.steps[1], (Vec3{0.5, 2, 0}));
    EXPECT_EQ(oblique.origin, (Vec3{7, 8, 9}));
  }
  Header scaled = nifti(v, 2, false);
  scaled.put<float>(112, 2);
  scaled.put<float>(116, 1);
  EXPECT_EQ(parse_label_volume(scaled.bytes + bytes_of_all<std::uint8_t>(v.labels)).labels[0], 1);
}

TEST(LabelVolume, one_image_in_both_formats_lies_in_one_place) {
  const LabelVolume v = two_boxes();
  const std::string data = bytes_of_all<std::uint8_t>(v.labels);
  // Powers of two: the same numbers in text and in floats of 4 bytes.
  Header matrix = nifti(v, 2, false);
  matrix.put<std::int16_t>(254, 1);
  const std::array<float, 12> rows{-0.5F, 0.25F, 0, -16, 0.125F, 2, 0, 32, 0, -0.5F, 4, 64};
  for (std::size_t k = 0; k < 12; ++k) matrix.put<float>(280 + 4 * k, rows[k]);
  const LabelVolume right = parse_label_volume(matrix.bytes + data);
  EXPECT_EQ(right.frame, patient_frame);
  const TriangleMesh truth = label_surface(right, {7});
  struct Space {
    const char* name;
    double x, y;
  };
  for (const Space& space : {Space{"left-posterior-superior", -1, -1},
                             {"LPS", -1, -1},
                             {"left-anterior-superior", -1, 1},
                             {"right-anterior-superior", 1, 1},
                             {"RAS", 1, 1}}) {
    std::string place = "space directions:";
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 step = right.steps[a];
      place += " (" + std::to_string(space.x * step.x) + "," + std::to_string(space.y * step.y) + "," +
               std::to_string(step.z) + ")";
    }
    place += "\nspace origin: (" + std::to_string(space.x * right.origin.x) + "," +
             std::to_string(space.y * right.origin.y) + "," + std::to_string(right.origin.z) + ")\n";
    std::string file = nrrd(v, "uchar", "raw", data, place);
    const std::string usual = "left-posterior-superior";
    file.replace(file.find(usual), usual.size(), space.name);
    const LabelVolume read = parse_label_volume(file);
    EXPECT_EQ(read.frame, patient_frame) << space.name;
    EXPECT_EQ(read.origin, right.origin) << space.name;
    EXPECT_EQ(read.steps, right.steps) << space.name;
    const TriangleMesh mesh = label_surface(read, {7});
    EXPECT_TRUE(mesh.vertices == truth.vertices && mesh.triangles == truth.triangles) << space.name;
  }
}

TEST(LabelVolume, units_become_millimetres_and_unknown_frames_are_told) {
  const LabelVolume v = two_boxes();
  const std::string data = bytes_of_all<std::uint8_t>(v.labels);
  Header metres = nifti(v, 2, false);
  metres.bytes[123] = 1;
  EXPECT_EQ(parse_label_volume(metres.bytes + data).steps[0], (Vec3{500, 0, 0}));
  metres.bytes[123] = 3 | 16;  // micrometres and milliseconds
  EXPECT_EQ(parse_label_volume(metres.bytes + data).steps[0], (Vec3{0.5e-3, 0, 0}));
  EXPECT_NE(parse_label_volume(metres.bytes + data).frame, patient_frame);  // neither sform nor qform
  const std::string place = "space directions: (2,0,0) (0,2,0) (0,0,2)\n";
  for (const auto& [units, factor] :
       {std::pair{"\"m\" \"m\" \"m\"", 1e3}, {"\"um\" \"um\" \"um\"", 1e-3}, {"\"voxels\"", 1.0}}) {
    const LabelVolume read = parse_label_volume(
        nrrd(v, "uchar", "raw", data, place + "space units: " + std::string(units) + "\n"));
    EXPECT_EQ(read.steps[2], (Vec3{0, 0, factor * 2})) << units;
  }
  std::string other = nrrd(v, "uchar", "raw", data, place);
  const std::string usual = "left-posterior-superior";
  other.replace(other.find(usual), usual.size(), "scanner-xyz");
  EXPECT_EQ(parse_label_volume(other).frame, "the axes of space scanner-xyz");
  EXPECT_EQ(parse_label_volume(other).steps[0], (Vec3{2, 0, 0}));
  EXPECT_EQ(parse_label_volume(nrrd(v, "uchar", "raw", data, "spacings: 1 1 1\n")).frame,
            "the axes of the grid");
}

TEST(LabelVolume, what_is_damaged_or_of_another_kind_is_refused_by_name) {
  const LabelVolume v = two_boxes();
  const std::string data = bytes_of_all<std::uint8_t>(v.labels);
  const auto says = [](const std::string& file) { return refusal([&] { (void)parse_label_volume(file); }); };
  const std::string good = nrrd(v, "uchar", "raw", data);
  EXPECT_EQ(says(good), "nothing was refused");
  EXPECT_NE(says(good.substr(0, good.size() - 1)).find("data for 377"), std::string::npos);
  EXPECT_NE(says(good.substr(0, 60)).find("NRRD"), std::string::npos);
  EXPECT_NE(says(nrrd(v, "block", "raw", data)).find("block"), std::string::npos);
  EXPECT_NE(says(nrrd(v, "uchar", "bzip2", data)).find("bzip2"), std::string::npos);
  EXPECT_NE(says(nrrd(v, "uchar", "gzip", data)).find("not packed"), std::string::npos);
  EXPECT_NE(says(nrrd(v, "uchar", "raw", data, "data file: x.raw\n")).find("another file"),
            std::string::npos);
  EXPECT_NE(says(nrrd(v, "uchar", "raw", data, "spacings: 1 0 1\n")).find("span no space"),
            std::string::npos);
  EXPECT_NE(says(nrrd(v, "uchar", "raw", data, "spacings: 1 nan 1\n")).find("spac"), std::string::npos);
  LabelVolume huge = v;
  huge.size = {2000000000, 2000000000, 2000000000};
  EXPECT_NE(says(nrrd(huge, "uchar", "raw", data)).find("2^31"), std::string::npos);
  std::vector<std::int32_t> none(v.labels.size(), 0);
  std::string half = bytes_of_all<float>(none);
  half.replace(0, 4, bytes_of(0.5F));
  EXPECT_NE(says(nrrd(v, "float", "raw", half)).find("no label"), std::string::npos);

  Header h = nifti(v, 2, false);
  EXPECT_NE(says(h.bytes + data.substr(1)).find("data for 377"), std::string::npos);
  h.put<float>(108, 1e9F);
  EXPECT_NE(says(h.bytes + data).find("outside"), std::string::npos);
  h = nifti(v, 128, false);
  EXPECT_NE(says(h.bytes + data).find("datatype 128"), std::string::npos);
  h = nifti(v, 2, false);
  h.put<std::int16_t>(40, 4);
  h.put<std::int16_t>(48, 20);
  EXPECT_NE(says(h.bytes + data).find("20 volumes"), std::string::npos);
  h.bytes.replace(344, 3, "ni1");
  EXPECT_NE(says(h.bytes + data).find("two files"), std::string::npos);
  EXPECT_NE(says(bytes_of<std::int32_t>(540) + std::string(600, '\0')).find("NIfTI-2"), std::string::npos);
  EXPECT_NE(says(std::string(128, '\0') + "DICM" + std::string(40, '\0')).find("DICOM"), std::string::npos);
  EXPECT_NE(says("ObjectType = Image\n").find("MetaImage"), std::string::npos);
  EXPECT_NE(says("").find("no NRRD"), std::string::npos);

  // Any byte may be wrong, and the file may end anywhere: read or refused, never more.
  Random random(9);
  const std::vector<std::string> seeds = {
      good, nrrd(v, "short", "gzip", gzipped(bytes_of_all<std::int16_t>(v.labels))),
      nifti(v, 2, false).bytes + data};
  for (int k = 0; k < 3000; ++k) {
    std::string file = seeds[static_cast<std::size_t>(k) % seeds.size()];
    for (int changes = 0; changes < 1 + k % 4; ++changes)
      file[static_cast<std::size_t>(random.unit() *
                                    static_cast<double>(std::min<std::size_t>(file.size(), 400)))] =
          static_cast<char>(random.bits());
    if (k % 5 == 0) file.resize(static_cast<std::size_t>(random.unit() * static_cast<double>(file.size())));
    try {
      const LabelVolume read = parse_label_volume(file);
      EXPECT_EQ(static_cast<std::int64_t>(read.labels.size()), read.size[0] * read.size[1] * read.size[2]);
    } catch (const InputError&) {
    }
  }
}

}  // namespace ballflow::geometry

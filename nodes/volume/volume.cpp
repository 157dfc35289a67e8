#include "volume/volume.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "io/text_cursor.hpp"
#include "io/unpack.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t most_unpacked = std::int64_t{4} << 30;
const char* const next_step =
    "convert it to NRRD or NIfTI-1 in one file (3D Slicer, ITK-SNAP, dcm2niix), or give its surface as STL "
    "or PLY";

[[noreturn]] void damaged(const std::string& cause) {
  throw InputError(cause, "the file is damaged or cut off: write it again");
}

enum class Number { u8, i8, u16, i16, u32, i32, f32, f64 };
std::size_t bytes_of(Number number) {
  static constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(number)];
}

template <class T>
T load(const char* at, bool swapped) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

double number_at(const char* at, Number number, bool swapped) {
  switch (number) {
    case Number::u8:
      return load<std::uint8_t>(at, swapped);
    case Number::i8:
      return load<std::int8_t>(at, swapped);
    case Number::u16:
      return load<std::uint16_t>(at, swapped);
    case Number::i16:
      return load<std::int16_t>(at, swapped);
    case Number::u32:
      return load<std::uint32_t>(at, swapped);
    case Number::i32:
      return load<std::int32_t>(at, swapped);
    case Number::f32:
      return static_cast<double>(load<float>(at, swapped));
    case Number::f64:
      break;
  }
  return load<double>(at, swapped);
}

std::int32_t label_of(double value, std::size_t voxel) {
  if (!(std::abs(value) <= 2147483647.0) || std::nearbyint(value) != value) {
    throw InputError(
        "voxel " + std::to_string(voxel) + " has the value " + std::to_string(value) + ", which is no label",
        "labels are whole numbers: threshold the image first");
  }
  return static_cast<std::int32_t>(value);
}

std::size_t voxels_of(const LabelVolume& volume) {
  std::int64_t count = 1;
  for (const std::int64_t n : volume.size) {
    if (n < 1) damaged("the image has " + std::to_string(n) + " voxels along an axis");
    if (n > std::numeric_limits<std::int32_t>::max() / count) {
      throw InputError("the image has more than 2^31 - 1 voxels", "crop it, or sample it down");
    }
    count *= n;
  }
  return static_cast<std::size_t>(count);
}

void require_space(const LabelVolume& volume) {
  const auto& [a, b, c] = volume.steps;
  const double spanned = std::abs(dot(cross(a, b), c)), all = length(a) * length(b) * length(c);
  if (!is_finite(volume.origin) || !(spanned > 1e-9 * all) || !std::isfinite(all)) {
    throw InputError("the axes of the image span no space: steps of " + std::to_string(length(a)) + ", " +
                         std::to_string(length(b)) + " and " + std::to_string(length(c)),
                     "mend the spacing or orientation in the header");
  }
}

void fill(LabelVolume& volume, std::string_view data, Number number, bool swapped, double slope,
          double intercept, Monitor& monitor) {
  const std::size_t count = voxels_of(volume), bytes = bytes_of(number);
  if (data.size() / bytes < count) {
    damaged("the image has " + std::to_string(count) + " voxels, and data for " +
            std::to_string(data.size() / bytes));
  }
  volume.labels.resize(count);
  Lookout look(monitor);
  for (std::size_t i = 0; i < count; ++i) {
    look(1);
    volume.labels[i] = label_of(slope * number_at(data.data() + i * bytes, number, swapped) + intercept, i);
  }
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r") + 1 - first));
}

/// The numbers of a field, brackets and commas apart.
std::vector<double> numbers_in(std::string text, const std::string& field) {
  for (char& c : text)
    if (c == '(' || c == ')' || c == ',') c = ' ';
  std::vector<double> numbers;
  TextCursor cursor(text);
  for (std::string_view token = cursor.token(); !token.empty(); token = cursor.token()) {
    const auto value = parse_real(token);
    if (!value)
      damaged("the field \"" + field + "\" has \"" + std::string(token) + "\" where a number should be");
    numbers.push_back(*value);
  }
  return numbers;
}

std::optional<Number> nrrd_number(const std::string& type) {
  static const std::vector<std::pair<Number, std::vector<const char*>>> names = {
      {Number::u8, {"unsigned char", "uchar", "uint8", "uint8_t"}},
      {Number::i8, {"signed char", "int8", "int8_t"}},
      {Number::u16, {"unsigned short", "ushort", "uint16", "uint16_t", "unsigned short int"}},
      {Number::i16, {"short", "signed short", "int16", "int16_t", "short int"}},
      {Number::u32, {"unsigned int", "uint", "uint32", "uint32_t"}},
      {Number::i32, {"int", "signed int", "int32", "int32_t"}},
      {Number::f32, {"float"}},
      {Number::f64, {"double"}}};
  for (const auto& [number, list] : names)
    for (const char* name : list)
      if (type == name) return number;
  return std::nullopt;
}

void scale_by(LabelVolume& volume, double factor) {
  volume.origin = factor * volume.origin;
  for (Vec3& step : volume.steps) step = factor * step;
}

/// From a space of NRRD to patient_frame; a space that says nothing of a patient stays.
void turn_from(LabelVolume& volume, std::string space) {
  for (char& c : space)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  Vec3 signs;
  if (space == "right-anterior-superior" || space == "ras") {
    signs = {1, 1, 1};
  } else if (space == "left-anterior-superior" || space == "las") {
    signs = {-1, 1, 1};
  } else if (space == "left-posterior-superior" || space == "lps") {
    signs = {-1, -1, 1};
  } else {
    volume.frame = space.empty() ? "the axes of a file without space" : "the axes of space " + space;
    return;
  }
  const auto turned = [&](Vec3 p) {
    return Vec3{signs.x * p.x, signs.y * p.y, signs.z * p.z} + Vec3{0, 0, 0};  // no -0
  };
  volume.origin = turned(volume.origin);
  for (Vec3& step : volume.steps) step = turned(step);
  volume.frame = patient_frame;
}

/// Millimetres of a unit of NRRD, which stands in quotes, once for each axis; 1 where it is not known.
double millimetres_of(const std::string& units) {
  const std::size_t open = units.find('"');
  if (open == std::string::npos) return 1;
  const std::string unit = units.substr(open + 1, units.find('"', open + 1) - open - 1);
  static const std::vector<std::pair<const char*, double>> known = {
      {"m", 1e3}, {"cm", 10}, {"mm", 1}, {"um", 1e-3}, {"\u00b5m", 1e-3}, {"micron", 1e-3}, {"nm", 1e-6}};
  for (const auto& [name, factor] : known)
    if (unit == name) return factor;
  return 1;
}

LabelVolume parse_nrrd(std::string_view content, Monitor& monitor) {
  std::vector<std::pair<std::string, std::string>> fields;
  std::size_t at = content.find('\n');
  for (bool open = true; open;) {
    if (at == std::string_view::npos) damaged("the header of the NRRD file has no end");
    const std::size_t end = content.find('\n', at + 1);
    const std::string line =
        trimmed(content.substr(at + 1, end == std::string_view::npos ? end : end - at - 1));
    at = end;
    if (line.empty()) break;
    if (line[0] == '#' || line.find(":=") != std::string::npos) continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos)
      damaged("the line \"" + line.substr(0, 60) + "\" of the NRRD header has no colon");
    fields.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }
  const std::string_view data = at == std::string_view::npos ? std::string_view() : content.substr(at + 1);
  const auto field = [&](const char* name) -> std::string {
    for (const auto& [key, value] : fields)
      if (key == name) return value;
    return {};
  };
  if (!field("data file").empty() || !field("datafile").empty()) {
    throw InputError("the NRRD header has its data in another file",
                     "write header and data into one file (.nrrd)");
  }
  for (const char* skip : {"line skip", "lineskip", "byte skip", "byteskip"}) {
    if (const std::string value = field(skip); !value.empty() && value != "0")
      throw InputError(std::string("the NRRD field \"") + skip + "\" is " + value,
                       "write the file without it");
  }
  LabelVolume volume;
  const std::vector<double> sizes = numbers_in(field("sizes"), "sizes");
  if (sizes.size() != 3) {
    throw InputError("the NRRD image has " + std::to_string(sizes.size()) + " dimensions, not 3",
                     "take one volume out of it");
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(sizes[a] >= 1 && sizes[a] <= 2147483647.0)) damaged("the image has no size along an axis");
    volume.size[a] = static_cast<std::int64_t>(sizes[a]);
  }
  const std::string type = field("type");
  const auto number = nrrd_number(type);
  if (!number)
    throw InputError("the NRRD type \"" + type + "\" is not read",
                     "write labels as integers of 8, 16 or 32 bits");
  volume.steps = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<double> directions = numbers_in(field("space directions"), "space directions"),
                            spacings = numbers_in(field("spacings"), "spacings"),
                            origin = numbers_in(field("space origin"), "space origin");
  if (directions.size() == 9) {
    for (std::size_t a = 0; a < 3; ++a)
      volume.steps[a] = {directions[3 * a], directions[3 * a + 1], directions[3 * a + 2]};
  } else if (spacings.size() == 3) {
    for (std::size_t a = 0; a < 3; ++a) volume.steps[a] = spacings[a] * volume.steps[a];
  } else if (!directions.empty() || !spacings.empty()) {
    damaged("the NRRD header has neither three space directions nor three spacings");
  }
  if (origin.size() == 3) volume.origin = {origin[0], origin[1], origin[2]};
  if (directions.size() == 9) {
    scale_by(volume, millimetres_of(field("space units")));
    turn_from(volume, field("space"));
  }
  require_space(volume);
  const std::string encoding = field("encoding");
  if (encoding == "raw" || encoding == "gzip" || encoding == "gz") {
    if (bytes_of(*number) > 1 && field("endian").empty()) damaged("the NRRD header does not say the endian");
    const bool swapped =
        (field("endian") == "big") != (std::endian::native == std::endian::big) && bytes_of(*number) > 1;
    if (encoding == "raw") {
      fill(volume, data, *number, swapped, 1, 0, monitor);
      return volume;
    }
    // So that sizes below are those of memory.
    if (data.size() > static_cast<std::size_t>(most_unpacked)) damaged("the NRRD file is too large");
    auto copy = std::make_unique<char[]>(data.size());
    std::copy(data.begin(), data.end(), copy.get());
    if (!data.starts_with("\x1f\x8b"))
      damaged("the data of the NRRD file is not packed with gzip, as its header says");
    const FileContent whole = unpacked(
        "the data of the NRRD file", FileContent(std::move(copy), data.size()),
        std::min(most_unpacked, static_cast<std::int64_t>(voxels_of(volume) * bytes_of(*number)) + 4096));
    fill(volume, whole.view(), *number, swapped, 1, 0, monitor);
    return volume;
  }
  if (encoding != "ascii" && encoding != "text" && encoding != "txt") {
    throw InputError("the NRRD encoding \"" + encoding + "\" is not read",
                     "write it raw, or packed with gzip");
  }
  const std::size_t count = voxels_of(volume);
  if (data.size() < count)
    damaged("the image has " + std::to_string(count) + " voxels, and less text than that");
  volume.labels.reserve(count);
  TextCursor cursor(data);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = parse_real(cursor.token());
    if (!value) damaged("voxel " + std::to_string(i) + " of " + std::to_string(count) + " is no number");
    volume.labels.push_back(label_of(*value, i));
  }
  return volume;
}

LabelVolume parse_nifti(std::string_view content, bool swapped, Monitor& monitor) {
  const char* const head = content.data();
  const auto whole = [&](std::size_t at) { return load<std::int16_t>(head + at, swapped); };
  const auto real = [&](std::size_t at) { return static_cast<double>(load<float>(head + at, swapped)); };
  if (std::string_view(head + 344, 3) == "ni1") {
    throw InputError("the file is the header of a NIfTI image of two files (.hdr, .img)", next_step);
  }
  if (std::string_view(head + 344, 3) != "n+1")
    throw InputError("the file is an Analyze 7.5 header, which is not read here", next_step);
  LabelVolume volume;
  const std::int16_t dimensions = whole(40);
  if (dimensions < 3 || dimensions > 7)
    damaged("the NIfTI image has " + std::to_string(dimensions) + " dimensions");
  for (std::size_t a = 0; a < 3; ++a) volume.size[a] = whole(42 + 2 * a);
  for (std::size_t a = 3; a < static_cast<std::size_t>(dimensions); ++a) {
    if (whole(42 + 2 * a) > 1) {
      throw InputError("the NIfTI image has " + std::to_string(whole(42 + 2 * a)) + " volumes",
                       "take one volume out of it");
    }
  }
  static const std::vector<std::pair<int, Number>> types = {
      {2, Number::u8},   {4, Number::i16},  {8, Number::i32},   {16, Number::f32},
      {64, Number::f64}, {256, Number::i8}, {512, Number::u16}, {768, Number::u32}};
  const auto type =
      std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.first == whole(70); });
  if (type == types.end()) {
    throw InputError("the NIfTI datatype " + std::to_string(whole(70)) + " is not read",
                     "write labels as integers of 8, 16 or 32 bits");
  }
  if (whole(254) > 0) {
    for (std::size_t a = 0; a < 3; ++a)
      volume.steps[a] = {real(280 + 4 * a), real(296 + 4 * a), real(312 + 4 * a)};
    volume.origin = {real(292), real(308), real(324)};
  } else if (whole(252) > 0) {
    const double b = real(256), c = real(260), d = real(264);
    const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
    const double last = real(76) < 0 ? -1 : 1;
    volume.steps = {
        real(80) * Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
        real(84) * Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
        last * real(88) * Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}};
    volume.origin = {real(268), real(272), real(276)};
  } else {
    volume.steps = {Vec3{real(80), 0, 0}, {0, real(84), 0}, {0, 0, real(88)}};
  }
  if (whole(254) > 0 || whole(252) > 0) volume.frame = patient_frame;
  const int unit = static_cast<unsigned char>(head[123]) & 7;
  scale_by(volume, unit == 1 ? 1e3 : unit == 3 ? 1e-3 : 1);
  require_space(volume);
  const double offset = real(108);
  if (!(offset >= 348 && offset <= static_cast<double>(content.size())))
    damaged("the data of the NIfTI file begins outside of it");
  const double slope = real(112);
  const bool scaled = std::isfinite(slope) && slope != 0;
  fill(volume, content.substr(static_cast<std::size_t>(offset)), type->second, swapped, scaled ? slope : 1,
       scaled ? real(116) : 0, monitor);
  return volume;
}

}  // namespace

LabelVolume parse_label_volume(std::string_view content, Monitor& monitor) {
  if (content.starts_with("NRRD0")) return parse_nrrd(content, monitor);
  if (content.size() >= 352) {
    for (const bool swapped : {false, true}) {
      const auto size = load<std::int32_t>(content.data(), swapped);
      if (size == 348) return parse_nifti(content, swapped, monitor);
      if (size == 540) throw InputError("the file is a NIfTI-2 image, which is not read here", next_step);
    }
  }
  const auto refuse = [](const char* what) {
    throw InputError(std::string("the file is ") + what + ", which is not read here", next_step);
  };
  if (content.size() > 132 && content.substr(128, 4) == "DICM") refuse("a DICOM file");
  if (content.starts_with("ObjectType") || content.starts_with("NDims")) refuse("a MetaImage header");
  if (content.starts_with("\x89HDF")) refuse("an HDF5 or MINC file");
  if (content.starts_with("CDF")) refuse("a MINC or NetCDF file");
  throw InputError("the file is no NRRD and no NIfTI image", next_step);
}

LabelVolume read_label_volume(const std::string& path, Monitor& monitor) {
  return parse_label_volume(read_file_content(path, most_unpacked).view(), monitor);
}

std::vector<std::int32_t> labels_in(const LabelVolume& volume, std::size_t most) {
  std::set<std::int32_t> found;
  for (const std::int32_t label : volume.labels) {
    if (label != 0) found.insert(label);
    if (found.size() > most) found.erase(std::prev(found.end()));
  }
  return {found.begin(), found.end()};
}

}  // namespace ballflow::geometry

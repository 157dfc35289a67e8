#include "plugin/artifact_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "ballflow/error.hpp"
#include "base/canonical_json.hpp"

namespace ballflow {
namespace {

using SortedJson = nlohmann::json;  // objects are std::map: keys in byte order

constexpr std::uint64_t header_limit = 16u << 20;
constexpr std::size_t data_alignment = 64;
constexpr std::size_t name_limit = 255;
constexpr char format_version[] = "1";

struct DType {
  std::uint32_t id;
  std::size_t size;
  std::string_view name, file_name;
};
constexpr std::array<DType, 7> dtypes{{{BF_F64, 8, "f64", "F64"},
                                       {BF_F32, 4, "f32", "F32"},
                                       {BF_I64, 8, "i64", "I64"},
                                       {BF_I32, 4, "i32", "I32"},
                                       {BF_U32, 4, "u32", "U32"},
                                       {BF_U16, 2, "u16", "U16"},
                                       {BF_U8, 1, "u8", "U8"}}};

const DType* find_dtype(std::uint32_t id) {
  const auto* found = std::find_if(dtypes.begin(), dtypes.end(), [id](const DType& d) { return d.id == id; });
  return found == dtypes.end() ? nullptr : found;
}

SortedJson parse(std::string_view text, int max_depth, ExitCode code) {
  // The parser itself needs no stack, but what walks the result does: refuse deep nesting before it is built.
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, SortedJson::parse_event_t event, SortedJson& parsed) {
    switch (event) {
      case SortedJson::parse_event_t::object_start:
      case SortedJson::parse_event_t::array_start:
        if (depth >= max_depth) throw Error(code, "JSON nests deeper than " + std::to_string(max_depth));
        if (event == SortedJson::parse_event_t::object_start) keys.emplace_back();
        break;
      case SortedJson::parse_event_t::object_end:
        keys.pop_back();
        break;
      case SortedJson::parse_event_t::key:
        if (!keys.back().insert(parsed.get<std::string>()).second) {
          throw Error(code, "JSON names the key " + shown_text(parsed.get<std::string>()) + " twice");
        }
        break;
      default:
        break;
    }
    return true;
  };
  try {
    return SortedJson::parse(text.begin(), text.end(), watch);
  } catch (const SortedJson::exception&) {
    throw Error(code, "not valid JSON: " + shown_text(text));
  }
}

/// Elements times element size, or nothing when it does not fit.
std::optional<std::uint64_t> byte_count(const std::vector<std::uint64_t>& shape, std::size_t element) {
  if (std::find(shape.begin(), shape.end(), 0u) != shape.end()) return 0;
  std::uint64_t bytes = element;
  for (const std::uint64_t extent : shape) {
    if (__builtin_mul_overflow(bytes, extent, &bytes)) return std::nullopt;
  }
  return bytes;
}

void check_name(std::string_view what, std::string_view name, ExitCode code) {
  const auto plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
  if (name.empty() || name.size() > name_limit || !std::all_of(name.begin(), name.end(), plain)) {
    throw Error(code, std::string(what) + " name " + shown_text(name) +
                          " is not 1 to 255 printable ASCII characters without quote and backslash");
  }
}

[[noreturn]] void refuse_layout(const std::string& why) { throw BadArtifact("bad artifact: " + why); }

std::uint64_t as_size(const SortedJson& value, const std::string& where) {
  if (!value.is_number_unsigned()) refuse_layout(where + " is not an unsigned integer");
  return value.get<std::uint64_t>();
}

const SortedJson& member(const SortedJson& object, const char* key, const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end()) refuse_layout(where + " has no " + key);
  return *found;
}

const std::string& text_member(const SortedJson& object, const char* key) {
  const SortedJson& value = member(object, key, "__metadata__");
  if (!value.is_string()) refuse_layout(std::string("__metadata__.") + key + " is not a string");
  return value.get_ref<const std::string&>();
}

struct ArrayPlace {
  std::uint64_t begin = 0, end = 0;
  NamedArray array;
};

ArrayPlace read_array(const std::string& name, const SortedJson& entry) {
  const std::string where = "array " + shown_text(name);
  if (!entry.is_object() || entry.size() != 3) refuse_layout(where + " is not {dtype, shape, data_offsets}");
  ArrayPlace place;
  place.array.name = name;
  const SortedJson& dtype = member(entry, "dtype", where);
  const auto* known = std::find_if(dtypes.begin(), dtypes.end(), [&](const DType& d) {
    return dtype.is_string() && dtype.get_ref<const std::string&>() == d.file_name;
  });
  if (known == dtypes.end()) {
    refuse_layout(where + ": unknown dtype" +
                  (dtype.is_string() ? ' ' + shown_text(dtype.get<std::string>()) : ""));
  }
  place.array.dtype = known->id;

  const SortedJson& shape = member(entry, "shape", where);
  if (!shape.is_array()) refuse_layout(where + ": shape is not a list");
  if (shape.size() > BALLFLOW_MAX_RANK)
    refuse_layout(where + ": rank " + std::to_string(shape.size()) + " is too high");
  for (const SortedJson& extent : shape) place.array.shape.push_back(as_size(extent, where + ": shape"));
  const auto bytes = byte_count(place.array.shape, known->size);
  if (!bytes) refuse_layout(where + ": the size of its shape overflows");

  const SortedJson& offsets = member(entry, "data_offsets", where);
  if (!offsets.is_array() || offsets.size() != 2) refuse_layout(where + ": data_offsets is not [begin, end]");
  place.begin = as_size(offsets[0], where + ": data_offsets");
  place.end = as_size(offsets[1], where + ": data_offsets");
  if (place.end < place.begin) refuse_layout(where + ": data_offsets run backwards");
  if (place.end - place.begin != *bytes) {
    refuse_layout(where + ": data_offsets span " + std::to_string(place.end - place.begin) +
                  " bytes, its shape needs " + std::to_string(*bytes));
  }
  if (place.begin % known->size != 0)
    refuse_layout(where + " is misaligned at offset " + std::to_string(place.begin));
  return place;
}

}  // namespace

std::size_t dtype_size(std::uint32_t dtype) {
  const DType* found = find_dtype(dtype);
  return found == nullptr ? 0 : found->size;
}

std::string_view dtype_name(std::uint32_t dtype) {
  const DType* found = find_dtype(dtype);
  return found == nullptr ? std::string_view() : found->name;
}

std::uint32_t dtype_from_name(std::string_view name) {
  const auto* found =
      std::find_if(dtypes.begin(), dtypes.end(), [&](const DType& d) { return d.name == name; });
  return found == dtypes.end() ? 0 : found->id;
}

std::uint64_t NamedArray::elements() const { return byte_count(shape, 1).value_or(0); }
std::uint64_t NamedArray::bytes() const { return byte_count(shape, dtype_size(dtype)).value_or(0); }

std::string make_header(const std::string& type, int version, const std::string& summary,
                        std::vector<NamedArray>& arrays, ExitCode code) {
  check_name("type", type, code);
  if (version < 0) throw Error(code, "version of type " + type + " is negative: " + std::to_string(version));
  for (const NamedArray& array : arrays) {
    check_name("array", array.name, code);
    if (array.name == "__metadata__") throw Error(code, "the array name __metadata__ is reserved");
    const DType* dtype = find_dtype(array.dtype);
    if (dtype == nullptr) {
      throw Error(code, "array " + array.name + ": unknown element type " + std::to_string(array.dtype));
    }
    if (array.shape.size() > BALLFLOW_MAX_RANK) {
      throw Error(code, "array " + array.name + ": rank " + std::to_string(array.shape.size()) + " exceeds " +
                            std::to_string(BALLFLOW_MAX_RANK));
    }
    if (!byte_count(array.shape, dtype->size))
      throw Error(code, "array " + array.name + ": its size overflows");
  }
  std::sort(arrays.begin(), arrays.end(), [](const NamedArray& a, const NamedArray& b) {
    const std::size_t size_a = dtype_size(a.dtype), size_b = dtype_size(b.dtype);
    return size_a != size_b ? size_a > size_b : a.name < b.name;
  });

  struct Placed {
    const NamedArray* array;
    std::uint64_t begin, end;
  };
  std::vector<Placed> by_name;
  std::uint64_t offset = 0;
  for (const NamedArray& array : arrays) {
    std::uint64_t end = 0;
    if (__builtin_add_overflow(offset, array.bytes(), &end) ||
        end > std::numeric_limits<std::int64_t>::max()) {
      throw Error(code, "array " + array.name + ": the size of the artifact overflows");
    }
    by_name.push_back({&array, offset, end});
    offset = end;
  }
  std::sort(by_name.begin(), by_name.end(),
            [](const Placed& a, const Placed& b) { return a.array->name < b.array->name; });
  const auto twice = std::adjacent_find(by_name.begin(), by_name.end(), [](const Placed& a, const Placed& b) {
    return a.array->name == b.array->name;
  });
  if (twice != by_name.end()) throw Error(code, "array " + twice->array->name + " occurs twice");

  std::string json(sizeof(std::uint64_t), '\0');
  json += "{\"__metadata__\":{\"ballflow\":\"";
  json += format_version;
  json += "\",\"summary\":";
  write_string(summary, json);
  json += ",\"type\":";
  write_string(type, json);
  json += ",\"version\":\"";
  write_number(version, json);
  json += "\"}";
  for (const Placed& placed : by_name) {
    json += ',';
    write_string(placed.array->name, json);
    json += ":{\"dtype\":\"";
    json += find_dtype(placed.array->dtype)->file_name;
    json += "\",\"shape\":[";
    for (std::size_t i = 0; i < placed.array->shape.size(); ++i) {
      if (i != 0) json += ',';
      write_number(placed.array->shape[i], json);
    }
    json += "],\"data_offsets\":[";
    write_number(placed.begin, json);
    json += ',';
    write_number(placed.end, json);
    json += "]}";
  }
  json += '}';
  json.resize((json.size() + data_alignment - 1) / data_alignment * data_alignment, ' ');
  const std::uint64_t length = json.size() - sizeof length;
  if (length > header_limit) {
    throw Error(code, "the header of the artifact has " + std::to_string(length) +
                          " bytes, more than 16 MB: put long lists into arrays, not into the summary");
  }
  for (std::size_t i = 0; i < sizeof length; ++i) json[i] = static_cast<char>(length >> (8 * i) & 0xff);
  return json;
}

ArtifactLayout read_layout(std::span<const std::byte> file) {
  constexpr std::size_t prefix = sizeof(std::uint64_t);
  if (file.size() < prefix)
    refuse_layout("it has " + std::to_string(file.size()) + " bytes, too few for a header");
  if (reinterpret_cast<std::uintptr_t>(file.data()) % prefix != 0) refuse_layout("its memory is misaligned");
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < prefix; ++i) length |= std::to_integer<std::uint64_t>(file[i]) << (8 * i);
  if (length > header_limit)
    refuse_layout("its header claims " + std::to_string(length) + " bytes, more than 16 MB");
  if (length > file.size() - prefix) {
    refuse_layout("its header claims " + std::to_string(length) + " bytes, the file has " +
                  std::to_string(file.size()));
  }
  const std::string_view text(reinterpret_cast<const char*>(file.data()), prefix + length);
  const std::span<const std::byte> data = file.subspan(text.size());

  constexpr int header_depth = 3;
  SortedJson header;
  try {
    header = parse(text.substr(prefix), header_depth, ExitCode::store);
  } catch (const Error& error) {
    refuse_layout(std::string("header: ") + error.what());
  }
  if (!header.is_object()) refuse_layout("its header is not a JSON object");
  const SortedJson& metadata = member(header, "__metadata__", "the header");
  if (!metadata.is_object() || metadata.size() != 4) {
    refuse_layout("__metadata__ is not {ballflow, summary, type, version}");
  }
  if (text_member(metadata, "ballflow") != format_version) {
    refuse_layout("format version " + shown_text(text_member(metadata, "ballflow")) + " is not " +
                  format_version);
  }
  ArtifactLayout layout;
  layout.type = text_member(metadata, "type");
  layout.summary = text_member(metadata, "summary");
  const std::string& version = text_member(metadata, "version");
  const auto parsed = std::from_chars(version.data(), version.data() + version.size(), layout.version);
  if (parsed.ec != std::errc() || parsed.ptr != version.data() + version.size()) {
    refuse_layout("version " + shown_text(version) + " is not a number");
  }
  try {
    if (canonical_json(layout.summary, ExitCode::store) != layout.summary) {
      refuse_layout("its summary is not in canonical form");
    }
  } catch (const Error& error) {
    refuse_layout(std::string("summary: ") + error.what());
  }
  if (layout.summary.front() != '{') refuse_layout("its summary is not a JSON object");

  std::vector<ArrayPlace> places;
  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__") continue;
    places.push_back(read_array(name, entry));
    if (places.back().end > data.size()) {
      refuse_layout("array " + shown_text(name) + " ends at " + std::to_string(places.back().end) +
                    ", the data at " + std::to_string(data.size()));
    }
    places.back().array.data = data.data() + places.back().begin;
  }
  std::sort(places.begin(), places.end(), [](const ArrayPlace& a, const ArrayPlace& b) {
    return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
  });
  std::uint64_t end = 0;
  for (ArrayPlace& place : places) {
    const std::string where = "array " + shown_text(place.array.name);
    if (place.begin < end) refuse_layout(where + " overlaps another array");
    if (place.begin > end) refuse_layout("there is a hole in the data before " + where);
    end = place.end;
    layout.arrays.push_back(std::move(place.array));
  }
  if (end != data.size())
    refuse_layout(std::to_string(data.size() - end) + " bytes of data belong to no array");

  // Whatever else may be odd about the header (order, spaces, escapes, padding) shows here.
  try {
    layout.header = make_header(layout.type, layout.version, layout.summary, layout.arrays, ExitCode::store);
  } catch (const Error& error) {
    refuse_layout(error.what());
  }
  if (layout.header != text) refuse_layout("its header is not in canonical form");
  return layout;
}

}  // namespace ballflow

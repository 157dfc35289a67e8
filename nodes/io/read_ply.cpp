// PLY (Stanford): ASCII and both binary encodings, elements and properties in any order. Used are x, y, z,
// nx, ny, nz, radius of "vertex", vertex_indices (or vertex_index) of "face" and of "tristrips"; the
// rest is passed over.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

enum class Encoding { ascii, little_endian, big_endian };
enum class Scalar { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
enum class Role { none, x, y, z, nx, ny, nz, radius, indices };

std::size_t bytes(Scalar type) {
  switch (type) {
    case Scalar::i8:
    case Scalar::u8:
      return 1;
    case Scalar::i16:
    case Scalar::u16:
      return 2;
    case Scalar::i32:
    case Scalar::u32:
    case Scalar::f32:
      return 4;
    default:
      return 8;
  }
}

bool is_float(Scalar type) { return type == Scalar::f32 || type == Scalar::f64; }

std::optional<Scalar> scalar_named(std::string_view name) {
  struct Name {
    std::string_view name;
    Scalar type;
  };
  static constexpr std::array names = {
      Name{"char", Scalar::i8},     Name{"int8", Scalar::i8},    Name{"uchar", Scalar::u8},
      Name{"uint8", Scalar::u8},    Name{"short", Scalar::i16},  Name{"int16", Scalar::i16},
      Name{"ushort", Scalar::u16},  Name{"uint16", Scalar::u16}, Name{"int", Scalar::i32},
      Name{"int32", Scalar::i32},   Name{"uint", Scalar::u32},   Name{"uint32", Scalar::u32},
      Name{"int64", Scalar::i64},   Name{"uint64", Scalar::u64}, Name{"float", Scalar::f32},
      Name{"float32", Scalar::f32}, Name{"double", Scalar::f64}, Name{"float64", Scalar::f64}};
  for (const Name& entry : names) {
    if (entry.name == name) return entry.type;
  }
  return std::nullopt;
}

struct Property {
  std::string name;
  bool list = false;
  Scalar count_type = Scalar::u8;  // lists only
  Scalar type = Scalar::f32;
  Role role = Role::none;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

class HeaderParser {
 public:
  explicit HeaderParser(TextCursor& text) : text_(text) {}

  Header parse() {
    if (text_.rest_of_line() != "ply") {
      throw InputError("the PLY file does not begin with \"ply\"", "is it a PLY file? Its extension says so");
    }
    bool has_format = false;
    for (;;) {
      text_.next_line();
      if (text_.at_end()) {
        throw InputError("the PLY header has no \"end_header\"",
                         "the file is cut off; fetch or write it again");
      }
      const std::string_view keyword = text_.token_on_line();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        has_format = true;
        encoding();
      } else if (keyword == "element") {
        element();
      } else if (keyword == "property") {
        property(keyword);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        refuse(keyword, "unknown keyword " + excerpt(keyword));
      }
    }
    text_.next_line();
    if (!has_format)
      throw InputError("the PLY header has no \"format\" line", "the file is damaged; write it again");
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(std::string_view token, const std::string& what) const {
    throw InputError("PLY header: " + what + text_.place_of(token), "the file is damaged; write it again");
  }

  void encoding() {
    const std::string_view name = text_.token_on_line();
    if (name == "ascii") {
      header_.encoding = Encoding::ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = Encoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = Encoding::big_endian;
    } else {
      refuse(name, "unknown format " + excerpt(name));
    }
  }

  void element() {
    Element element;
    const std::string_view name = text_.token_on_line();
    // Names appear in messages.
    const bool printable = std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
    if (name.empty() || !printable) refuse(name, excerpt(name) + " is no name of an element");
    element.name = name;
    const std::string_view token = text_.token_on_line();
    const auto count = parse_integer(token);
    if (!count || *count < 0)
      refuse(token, excerpt(token) + " is no number of elements " + excerpt(element.name));
    element.count = *count;
    for (const Element& other : header_.elements) {
      if (other.name == element.name)
        refuse(token, "the element " + excerpt(element.name) + " is declared twice");
    }
    header_.elements.push_back(std::move(element));
  }

  void property(std::string_view keyword) {
    if (header_.elements.empty()) refuse(keyword, "a property before the first element");
    Element& element = header_.elements.back();
    Property property;
    std::string_view type = text_.token_on_line();
    if (type == "list") {
      property.list = true;
      property.count_type = scalar(text_.token_on_line());
      if (is_float(property.count_type)) refuse(type, "a list counted in floating point");
      type = text_.token_on_line();
    }
    property.type = scalar(type);
    property.name = text_.token_on_line();
    property.role = role(element.name, property);
    for (const Property& other : element.properties) {
      if (property.role != Role::none && other.role == property.role) {
        refuse(keyword, "the property " + excerpt(property.name) + " is declared twice");
      }
    }
    element.properties.push_back(std::move(property));
  }

  Scalar scalar(std::string_view name) const {
    const auto type = scalar_named(name);
    if (!type) refuse(name, "unknown type " + excerpt(name));
    return *type;
  }

  Role role(std::string_view element, const Property& property) const {
    if (element == "vertex" && !property.list) {
      static constexpr std::array<std::string_view, 7> names = {"x", "y", "z", "nx", "ny", "nz", "radius"};
      static constexpr std::array roles = {Role::x,  Role::y,  Role::z,     Role::nx,
                                           Role::ny, Role::nz, Role::radius};
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (property.name == names[i]) return roles[i];
      }
    }
    if ((element == "face" || element == "tristrips") && property.list && !is_float(property.type) &&
        (property.name == "vertex_indices" || property.name == "vertex_index")) {
      return Role::indices;
    }
    return Role::none;
  }

  TextCursor& text_;
  Header header_;
};

/// Where the file broke off or is not readable, without the name of the element.
struct Unreadable {
  std::string what;
};

class AsciiValues {
 public:
  AsciiValues(const TextCursor& text) : text_(text) {}
  static constexpr std::size_t shortest_scalar(Scalar) { return 2; }  // a digit and a blank
  std::size_t remaining() const { return text_.remaining() + 1; }     // the last blank may be missing

  double real(Scalar) {
    token_ = text_.token();
    if (const auto value = parse_real(token_)) return *value;
    unreadable("a number");
  }
  std::int64_t integer(Scalar) {
    token_ = text_.token();
    if (const auto value = parse_integer(token_)) return *value;
    unreadable("a whole number");
  }
  void skip(Scalar type) { real(type); }
  /// The place of the last value.
  std::string place() const { return text_.place_of(token_); }

 private:
  [[noreturn]] void unreadable(const char* expected) const {
    if (token_.empty()) throw Unreadable{"the file ends here" + place()};
    throw Unreadable{std::string(expected) + " expected, found " + excerpt(token_) + place()};
  }
  TextCursor text_;
  std::string_view token_;
};

class BinaryValues {
 public:
  BinaryValues(std::string_view data, bool big_endian)
      : at_(data.data()),
        end_(data.data() + data.size()),
        swap_(big_endian == (std::endian::native == std::endian::little)) {}
  static std::size_t shortest_scalar(Scalar type) { return bytes(type); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

  double real(Scalar type) {
    if (type == Scalar::f32) return static_cast<double>(take<float>());
    if (type == Scalar::f64) return take<double>();
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(Scalar type) {
    switch (type) {
      case Scalar::i8:
        return take<std::int8_t>();
      case Scalar::u8:
        return take<std::uint8_t>();
      case Scalar::i16:
        return take<std::int16_t>();
      case Scalar::u16:
        return take<std::uint16_t>();
      case Scalar::i32:
        return take<std::int32_t>();
      case Scalar::u32:
        return take<std::uint32_t>();
      default:
        return take<std::int64_t>();  // beyond 2^63 an unsigned index is out of range either way
    }
  }
  void skip(Scalar type) {
    require(bytes(type));
    at_ += bytes(type);
  }
  static std::string place() { return {}; }

 private:
  void require(std::size_t size) const {
    if (remaining() < size) throw Unreadable{"the file ends here"};
  }
  template <class T>
  T take() {
    require(sizeof(T));
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), at_, sizeof(T));
    at_ += sizeof(T);
    if (swap_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  const char* at_;
  const char* end_;
  bool swap_;
};

template <class Values>
class BodyParser {
 public:
  BodyParser(Values values, const Header& header, Monitor& monitor)
      : values_(values), header_(header), monitor_(monitor) {
    for (const Element& element : header.elements) {
      if (element.name == "vertex") vertex_count_ = element.count;
    }
  }

  RawModel parse() {
    const std::size_t size = values_.remaining();
    for (const Element& element : header_.elements) {
      std::size_t shortest = 0;
      for (const Property& property : element.properties) {
        shortest += values_.shortest_scalar(property.list ? property.count_type : property.type);
      }
      if (shortest == 0) continue;
      require_room(element.count, shortest, values_.remaining(), (element.name + " elements").c_str());
      const bool vertex = element.name == "vertex";
      if (vertex) prepare_vertices(element);
      const bool face = element.name == "face", strip = element.name == "tristrips";
      if (face) model_.triangles.reserve(model_.triangles.size() + static_cast<std::size_t>(element.count));
      for (std::int64_t i = 0; i < element.count; ++i) {
        if (i % elements_per_step == 0) {
          monitor_.step(1 - static_cast<double>(values_.remaining()) / static_cast<double>(size));
        }
        try {
          read(element, i);
        } catch (const Unreadable& unreadable) {
          throw InputError(element.name + " " + std::to_string(i) + " of " + std::to_string(element.count) +
                               ": " + unreadable.what,
                           "the file is cut off or damaged; fetch or write it again");
        }
        if (vertex) finish_vertex(i);
        if (face) add_polygon(model_, indices_);
        if (strip) add_strip();
      }
    }
    return std::move(model_);
  }

 private:
  void prepare_vertices(const Element& element) {
    std::array<bool, 9> has{};
    for (const Property& property : element.properties) has[static_cast<std::size_t>(property.role)] = true;
    const auto missing = [&has](Role role) { return !has[static_cast<std::size_t>(role)]; };
    if (missing(Role::x) || missing(Role::y) || missing(Role::z)) {
      const char* name = missing(Role::x) ? "x" : missing(Role::y) ? "y" : "z";
      throw InputError(std::string("the PLY header gives vertices no property ") + name,
                       "write the file again with x, y and z");
    }
    has_radii_ = !missing(Role::radius);
    has_normals_ = !missing(Role::nx) && !missing(Role::ny) && !missing(Role::nz);
    model_.vertices.reserve(static_cast<std::size_t>(element.count));
    if (has_normals_) model_.normals.reserve(static_cast<std::size_t>(element.count));
    if (has_radii_) model_.radii.reserve(static_cast<std::size_t>(element.count));
  }

  void read(const Element& element, std::int64_t number) {
    indices_.clear();
    for (const Property& property : element.properties) {
      if (property.list) {
        read_list(element, property, number);
        continue;
      }
      double* target = nullptr;
      switch (property.role) {
        case Role::x:
          target = &point_.x;
          break;
        case Role::y:
          target = &point_.y;
          break;
        case Role::z:
          target = &point_.z;
          break;
        case Role::nx:
          target = &normal_.x;
          break;
        case Role::ny:
          target = &normal_.y;
          break;
        case Role::nz:
          target = &normal_.z;
          break;
        case Role::radius:
          target = &radius_;
          break;
        default:
          values_.skip(property.type);
          continue;
      }
      *target = values_.real(property.type);
    }
  }

  void read_list(const Element& element, const Property& property, std::int64_t number) {
    const std::int64_t count = values_.integer(property.count_type);
    const std::size_t room = values_.remaining() / values_.shortest_scalar(property.type);
    if (count < 0 || static_cast<std::size_t>(count) > room) {
      throw Unreadable{"the list " + excerpt(property.name) + " has " + std::to_string(count) +
                       " entries, but the file ends after at most " + std::to_string(room) + values_.place()};
    }
    for (std::int64_t k = 0; k < count; ++k) {
      if (property.role != Role::indices) {
        values_.skip(property.type);
        continue;
      }
      const std::int64_t index = values_.integer(property.type);
      const bool restarts_strip = index == -1 && element.name == "tristrips";
      if (!restarts_strip && (index < 0 || index >= vertex_count_)) {
        refuse_index(element.name.c_str(), number, "vertex", std::to_string(index),
                     static_cast<std::size_t>(vertex_count_), values_.place());
      }
      indices_.push_back(static_cast<std::int32_t>(index));
    }
  }

  void finish_vertex(std::int64_t number) {
    require_finite(point_, "vertex", number);
    add_vertex(model_, point_);
    if (has_normals_) model_.normals.push_back(normal_);
    if (has_radii_) model_.radii.push_back(radius_);
  }

  /// Every three successive vertices are a triangle, every other one turned round; -1 begins a new strip.
  void add_strip() {
    std::size_t first = 0;
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      if (indices_[i] < 0) {
        first = i + 1;
      } else if (i >= first + 2) {
        const bool turned = (i - first) % 2 != 0;
        add_polygon(model_, std::array{indices_[turned ? i - 1 : i - 2], indices_[turned ? i - 2 : i - 1],
                                       indices_[i]});
      }
    }
  }

  Values values_;
  const Header& header_;
  Monitor& monitor_;
  RawModel model_;
  std::int64_t vertex_count_ = 0;
  bool has_normals_ = false, has_radii_ = false;
  Vec3 point_, normal_;
  double radius_ = 0;
  std::vector<std::int32_t> indices_;
};

}  // namespace

RawModel parse_ply(std::string_view content, Monitor& monitor) {
  TextCursor text(content);
  const Header header = HeaderParser(text).parse();
  if (header.encoding == Encoding::ascii) return BodyParser(AsciiValues(text), header, monitor).parse();
  const bool big_endian = header.encoding == Encoding::big_endian;
  return BodyParser(BinaryValues(content.substr(text.offset()), big_endian), header, monitor).parse();
}

}  // namespace ballflow::geometry

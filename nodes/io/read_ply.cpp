// PLY (Stanford): ASCII and both binary encodings, elements and properties in any order. Used are x, y, z,
// nx, ny, nz, radius (or diameter) of "vertex", vertex_indices (or vertex_index) of "face" and of
// "tristrips"; the rest is passed over.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "io/ply_header.hpp"
#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

using namespace ply;

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
  /// Ends when nothing follows but zeros, with which some programs pad.
  bool at_end() {
    token_ = text_.token();
    return token_.find_first_not_of('\0') == std::string_view::npos;
  }
  std::string rest() const { return excerpt(token_); }
  /// An element may go on in the next line, but what follows on its last line would be taken for the next
  /// one: where a number is missing, all later ones would be read out of step, perhaps to the end.
  void end_element() {
    token_ = text_.token_on_line();
    if (!token_.empty()) throw Unreadable{excerpt(token_) + " follows on its line" + place()};
  }
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
  bool at_end() {
    // A line end, perhaps of an editor.
    return remaining() <= 2 && std::all_of(at_, end_, [](char c) { return c == '\n' || c == '\r'; });
  }
  std::string rest() const { return std::to_string(remaining()) + " bytes"; }
  void end_element() {}
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

/// Where an ASCII file is out of step, the first line with too few values, or too many, is the cause, though
/// the error comes later: elements may go on in the next line. Empty when no line is wrong.
std::string first_short_line(TextCursor text, const Header& header) {
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::int64_t i = 0; i < element.count; ++i, text.next_line()) {
      const std::string_view first = text.token();
      if (first.empty()) return {};
      std::string_view token = first;
      const auto take = [&](std::int64_t values) {
        for (; values > 0 && !token.empty(); --values) token = text.token_on_line();
        return values == 0;
      };
      bool whole = true;
      for (const Property& property : element.properties) {
        std::int64_t values = 1;
        if (property.list) values += std::max<std::int64_t>(parse_integer(token).value_or(0), 0);
        if (!(whole = take(values))) break;
      }
      if (whole && token.empty()) continue;
      return "; the line of " + element.name + " " + std::to_string(i) + " has too " +
             (whole ? "many" : "few") + " values" + text.place_of(first);
    }
  }
  return {};
}

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
          values_.end_element();
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
    require_end();
    return std::move(model_);
  }

 private:
  /// Text after the last element means that a number in the header is wrong; bytes may be anything.
  void require_end() {
    if (values_.at_end()) return;
    const std::string rest = values_.rest();
    if constexpr (std::is_same_v<Values, AsciiValues>) {
      throw InputError(rest + " follows after the last element that the header promises" + values_.place(),
                       "correct the numbers of elements in the header, or remove what follows");
    }
    model_.warnings.push_back(rest + " after the last element that the header promises are passed over");
  }

  void prepare_vertices(const Element& element) {
    std::array<bool, roles> has{};
    for (const Property& property : element.properties) has[static_cast<std::size_t>(property.role)] = true;
    const auto missing = [&has](Role role) { return !has[static_cast<std::size_t>(role)]; };
    has_diameters_ = missing(Role::radius) && !missing(Role::diameter);
    has_radii_ = has_diameters_ || !missing(Role::radius);
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
        case Role::diameter:
          target = &diameter_;
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
    if (!is_finite(point_)) require_finite(point_, "vertex", number, values_.place());
    add_vertex(model_, point_);
    if (has_normals_) model_.normals.push_back(normal_);
    if (has_radii_) model_.radii.push_back(has_diameters_ ? diameter_ / 2 : radius_);
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
  bool has_normals_ = false, has_radii_ = false, has_diameters_ = false;
  Vec3 point_, normal_;
  double radius_ = 0, diameter_ = 0;
  std::vector<std::int32_t> indices_;
};

}  // namespace

RawModel parse_ply(std::string_view content, Monitor& monitor) {
  TextCursor text(content);
  const Header header = parse_header(text);
  if (header.encoding == Encoding::ascii) {
    try {
      return BodyParser(AsciiValues(text), header, monitor).parse();
    } catch (const InputError& error) {
      const std::string line = first_short_line(text, header);
      if (line.empty()) throw;
      const std::string what = error.what();
      const std::size_t cause = what.find('\n');
      throw InputError(what.substr(0, cause) + line, what.substr(cause + 1));
    }
  }
  const bool big_endian = header.encoding == Encoding::big_endian;
  return BodyParser(BinaryValues(content.substr(text.offset()), big_endian), header, monitor).parse();
}

}  // namespace ballflow::geometry

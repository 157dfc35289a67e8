#include "io/ply_header.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/monitor.hpp"

namespace ballflow::geometry::ply {
namespace {

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

class HeaderParser {
 public:
  explicit HeaderParser(TextCursor& text) : text_(text) {}

  Header parse() {
    const std::string_view magic = text_.rest_of_line();
    if (magic != "ply") {
      throw InputError("the PLY file does not begin with \"ply\", but with " + excerpt(magic),
                       "is it a PLY file? Its extension says so");
    }
    TextCursor second = text_;
    second.next_line();
    ends_with_cr_ = second.offset() == text_.offset() + 1 && text_.next_character() == '\r';
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
    end_line();
    if (!has_format)
      throw InputError("the PLY header has no \"format\" line", "the file is damaged; write it again");
    require_vertices();
    require_faces();
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(std::string_view token, const std::string& what) const {
    throw InputError("PLY header: " + what + text_.place_of(token), "the file is damaged; write it again");
  }

  /// After "end_header". Where lines end with CR, an LF is the first byte of the body.
  void end_line() {
    text_.rest_of_line();
    if (ends_with_cr_ && text_.next_character() == '\r') {
      text_.skip_character();
    } else {
      text_.next_line();
    }
  }

  void require_vertices() const {
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                     [](const Element& element) { return element.name == "vertex"; });
    if (vertex == header_.elements.end()) {
      throw InputError("the PLY header has no element \"vertex\"; its elements are " + names_of_elements(),
                       "the element of the vertices is called vertex");
    }
    for (const auto& [role, name] :
         {std::pair(Role::x, "x"), std::pair(Role::y, "y"), std::pair(Role::z, "z")}) {
      if (has(*vertex, role)) continue;
      throw InputError(std::string("the PLY header gives vertices no property ") + name,
                       "write the file again with x, y and z");
    }
  }

  void require_faces() const {
    const Element* other = nullptr;
    bool faces = false;
    for (const Element& element : header_.elements) {
      if (element.count == 0) continue;
      if (element.name == "face" || element.name == "tristrips") {
        faces = true;
        if (has(element, Role::indices)) continue;
        std::string properties;
        for (const Property& property : element.properties) {
          properties += (properties.empty() ? "" : ", ");
          properties += property.list ? "list " : "";
          properties += excerpt(property.name);
          if (property.list && is_float(property.type)) properties += " of floating-point numbers";
        }
        throw InputError(
            "the PLY header gives the element \"" + element.name +
                "\" no list vertex_indices or vertex_index of whole numbers; its properties are " +
                (properties.empty() ? "none" : properties),
            "write the corners of faces as property list uchar int vertex_indices");
      }
      if (other == nullptr && is_nearly_face(element.name)) other = &element;
    }
    if (faces || other == nullptr) return;
    throw InputError(
        "the PLY header has an element " + excerpt(other->name) + ", and none that is called \"face\"",
        "call it face if its elements are faces, or remove it to read the vertices as points");
  }

  static bool is_nearly_face(const std::string& name) {
    static constexpr std::array<std::string_view, 8> names = {"face",    "faces",    "facet",    "facets",
                                                              "polygon", "polygons", "triangle", "triangles"};
    std::string small;
    for (const char c : name) small += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    return std::find(names.begin(), names.end(), small) != names.end();
  }

  static bool has(const Element& element, Role role) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [role](const Property& property) { return property.role == role; });
  }

  std::string names_of_elements() const {
    std::string names;
    for (const Element& element : header_.elements)
      names += (names.empty() ? "" : ", ") + excerpt(element.name);
    return names.empty() ? "none" : names;
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
      using Name = std::pair<std::string_view, Role>;
      static constexpr std::array names = {Name{"x", Role::x},           Name{"y", Role::y},
                                           Name{"z", Role::z},           Name{"nx", Role::nx},
                                           Name{"ny", Role::ny},         Name{"nz", Role::nz},
                                           Name{"radius", Role::radius}, Name{"diameter", Role::diameter}};
      for (const auto& [name, role] : names) {
        if (property.name == name) return role;
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
  bool ends_with_cr_ = false;  // lines of the header, alone
};

}  // namespace

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

Header parse_header(TextCursor& text) { return HeaderParser(text).parse(); }

bool has_radii(std::string_view content) {
  bool radii = false;
  try {
    TextCursor text(content);
    for (const Element& element : parse_header(text).elements) {
      if ((element.name == "face" || element.name == "tristrips") && element.count > 0) return false;
      if (element.name != "vertex") continue;
      for (const Property& property : element.properties) {
        radii = radii || property.role == Role::radius || property.role == Role::diameter;
      }
    }
  } catch (const InputError&) {
    return false;
  }
  return radii;
}

}  // namespace ballflow::geometry::ply

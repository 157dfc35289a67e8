#include "io/formats.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "io/stl_layout.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {

const char* const readable_models =
    "readable are .off .obj .ply .stl, and points as text (.xyz .pts .pwn .csv .asc), each also with .gz or "
    ".zst";
const char* const readable_balls =
    "readable are ma, sph (also sphere trees), lines of x y z r (also csv), and PLY with a radius";
const char* const readable_covers = "readable are scp, rail and steiner files; for balls set format to balls";

namespace {

constexpr std::size_t beginning = 4096;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower(c);
  return result;
}

struct Extension {
  std::string_view name;
  std::optional<MeshFormat> format;  // none: the content decides
};
constexpr std::array extensions = {Extension{"", std::nullopt},          Extension{".txt", std::nullopt},
                                   Extension{".dat", std::nullopt},      Extension{".off", MeshFormat::off},
                                   Extension{".coff", MeshFormat::off},  Extension{".noff", MeshFormat::off},
                                   Extension{".cnoff", MeshFormat::off}, Extension{".stoff", MeshFormat::off},
                                   Extension{".obj", MeshFormat::obj},   Extension{".ply", MeshFormat::ply},
                                   Extension{".stl", MeshFormat::stl},   Extension{".xyz", MeshFormat::xyz},
                                   Extension{".pts", MeshFormat::xyz},   Extension{".pwn", MeshFormat::xyz},
                                   Extension{".csv", MeshFormat::xyz},   Extension{".asc", MeshFormat::xyz}};

struct OtherFormat {
  std::string_view start, word;  // how it begins, and what comes near the beginning
  const char* name;
  const char* hint = nullptr;
};

constexpr const char* surface_of_label =
    "of a label image (NRRD, NIfTI-1) make the surface: ballflow run graphs/label_surface.json --set "
    "image=FILE "
    "--out out";

// The first row that fits counts.
constexpr std::array others = {
    OtherFormat{"gltf", "", "a binary glTF model (GLB)"},
    OtherFormat{"{", "\"asset\"", "a glTF model"},
    OtherFormat{"{", "\"", "a JSON file"},
    OtherFormat{"<", "<collada", "a COLLADA model (DAE)"},
    OtherFormat{"<", "<vtkfile", "a VTK file"},
    OtherFormat{"<", "<robot", "a robot description (URDF or SRDF)",
                "name the file of one of its meshes; readable are .off .obj .ply .stl"},
    OtherFormat{"<", "<html", "a web page", "the download went wrong: fetch the file again"},
    OtherFormat{"<", "<!doctype html", "a web page", "the download went wrong: fetch the file again"},
    OtherFormat{"<", "<x3d", "an X3D model"},
    OtherFormat{"<", "<amf", "an AMF model"},
    OtherFormat{"<", "<?xml", "an XML file"},
    OtherFormat{"# vtk datafile", "", "a VTK file"},
    OtherFormat{"# .pcd", "", "a PCD file"},
    OtherFormat{"version", "https://git-lfs", "a pointer of Git LFS and not the file itself",
                "run: git lfs pull"},
    OtherFormat{"version", "fields", "a PCD file"},
    OtherFormat{"#vrml", "", "a VRML model"},
    OtherFormat{"iso-10303-21", "", "a STEP model"},
    OtherFormat{"0\nsection", "", "a DXF drawing"},
    OtherFormat{"kaydara fbx", "", "an FBX model"},
    OtherFormat{"blender", "", "a Blender file"},
    OtherFormat{"lasf", "", "a LAS file"},
    OtherFormat{"astm-e57", "", "an E57 file"},
    OtherFormat{"\x93numpy", "", "a NumPy array"},
    OtherFormat{"nrrd0", "", "an image (NRRD)", surface_of_label},
    OtherFormat{std::string_view("\x5c\x01\0\0", 4), "", "an image (NIfTI)", surface_of_label},
    OtherFormat{std::string_view("\0\0\x01\x5c", 4), "", "an image (NIfTI)", surface_of_label},
    OtherFormat{"objecttype", "elementtype", "an image (MetaImage)", surface_of_label},
    OtherFormat{"meshversionformatted", "", "a Medit mesh"},
    OtherFormat{"$meshformat", "", "a Gmsh mesh"},
    OtherFormat{"%pdf", "", "a PDF document"},
    OtherFormat{"\x89png", "", "a picture"}};

bool is_number(std::string_view token) { return parse_real(token).has_value(); }

/// The first line that begins with a word of OBJ and goes on as its word demands.
bool is_obj(std::string_view content) {
  static constexpr std::array<std::string_view, 9> first_words = {"mtllib", "usemtl", "o",  "g", "s",
                                                                  "v",      "vn",     "vt", "f"};
  TextCursor text(content.substr(0, 16 * beginning), '#', {}, '\\');
  std::string_view word = text.token();
  if (std::find(first_words.begin(), first_words.end(), word) == first_words.end()) return false;
  for (; !word.empty(); text.next_line(), word = text.token()) {
    if (word != "v" && word != "vn" && word != "vt" && word != "f") continue;
    const std::string_view next = text.token_on_line();
    return is_number(next.substr(0, word == "f" ? next.find('/') : next.size()));
  }
  return false;
}

bool is_stl(std::string_view content) {
  const auto layout = stl_layout(content);
  if (layout && layout->facets == layout->fitting && layout->extra == 0 && layout->facets != 0) return true;
  const std::string start = lower(content.substr(0, beginning));
  TextCursor text(start);
  return text.token() == "solid" && start.find('\0') == std::string::npos &&
         (start.find("facet") != std::string::npos || start.find("endsolid") != std::string::npos);
}

/// Whether the first line has three numbers or more and is not the header of an OFF file without keyword.
bool is_points(std::string_view content) {
  TextCursor text(content, '#', ",;");
  std::size_t numbers = 0, counts = 0;
  for (std::string_view token = text.token(); !token.empty(); token = text.token_on_line(), ++numbers) {
    if (!is_number(token)) return false;
    const auto whole = parse_integer(token);
    counts += whole && *whole >= 0;
  }
  return numbers > 3 || (numbers == 3 && counts < 3);
}

MeshFormat likely_format(std::string_view content) {
  return content.substr(0, 1024).find('\0') != std::string_view::npos ? MeshFormat::stl : MeshFormat::xyz;
}

}  // namespace

const char* name_of(MeshFormat format) {
  static constexpr std::array names = {"OFF", "OBJ", "PLY", "STL", "points as text"};
  return names[static_cast<std::size_t>(format)];
}

std::string lower_extension(const std::string& name) {
  const std::filesystem::path path = name;
  std::string text = lower(path.extension().string());
  if (text == ".gz" || text == ".zst") text = lower(path.stem().extension().string());
  return text;
}

bool is_model_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".ma" || extension == ".sph") return true;
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const Extension& one) { return one.format && one.name == extension; });
}

void refuse_other_formats(std::string_view content, const std::string& hint) {
  const std::string start = lower(content.substr(0, beginning));
  const std::size_t first = std::min(start.find_first_not_of(" \t\r\n"), start.size());
  const std::string_view text = std::string_view(start).substr(first);
  for (const OtherFormat& other : others) {
    if (!text.starts_with(other.start) || text.find(other.word) == std::string_view::npos) continue;
    throw InputError(std::string("the file is ").append(other.name).append(", which is not read here"),
                     other.hint != nullptr ? other.hint : "write it in another format: " + hint);
  }
}

std::optional<OffKeyword> off_keyword(std::string_view token) {
  OffKeyword keyword;
  const auto strip = [&](std::string_view prefix) {
    if (lower(token.substr(keyword.size, prefix.size())) != prefix) return false;
    keyword.size += prefix.size();
    return true;
  };
  keyword.textures = strip("st");
  keyword.colours = strip("c");
  // Geomview: N means normals, n that the dimension follows.
  const auto strip_exactly = [&](char letter) {
    if (keyword.size >= token.size() || token[keyword.size] != letter) return false;
    ++keyword.size;
    return true;
  };
  keyword.normals = strip_exactly('N');
  keyword.homogeneous = strip_exactly('4');
  keyword.dimension = strip_exactly('n');
  if (!strip("off")) return std::nullopt;
  // noff in small letters: which of the two is meant, the next line tells (one number or three).
  const std::string_view rest = token.substr(keyword.size);
  if (!rest.empty() && !parse_integer(rest)) return std::nullopt;
  return keyword;
}

std::optional<MeshFormat> certain_format(std::string_view content) {
  TextCursor text(content, '#');
  const std::string_view word = text.token();
  if (word == "ply") return MeshFormat::ply;
  if (const auto keyword = off_keyword(word)) {
    const std::string_view next = keyword->size < word.size() ? word.substr(keyword->size) : text.token();
    if (next == "BINARY" || parse_integer(next)) return MeshFormat::off;
  }
  if (is_stl(content)) return MeshFormat::stl;
  if (is_obj(content)) return MeshFormat::obj;
  return std::nullopt;
}

MeshFormat format_of(const std::string& path, std::string_view content, Monitor& monitor) {
  const std::string extension = lower_extension(path);
  const auto known = std::find_if(extensions.begin(), extensions.end(),
                                  [&](const Extension& one) { return one.name == extension; });
  const bool by_name = known != extensions.end() && known->format;
  std::optional<MeshFormat> certain = certain_format(content);
  if (!certain) refuse_other_formats(content, readable_models);
  if (by_name && !certain) {
    // No OBJ, PLY or STL file begins with a number.
    if (*known->format == MeshFormat::off || *known->format == MeshFormat::xyz || !is_points(content)) {
      return *known->format;
    }
    certain = MeshFormat::xyz;
  }
  if (!certain && known == extensions.end()) {
    throw InputError("the file \"" + path + "\" has the unknown extension \"" + extension + "\"",
                     readable_models);
  }
  if (!certain) return likely_format(content);
  if (known == extensions.end() || (by_name && *known->format != *certain)) {
    monitor.warn("the file is called " + extension + ", but its content is " + name_of(*certain) +
                 ": it is read as that");
  }
  return *certain;
}

}  // namespace ballflow::geometry

// Which formats are read, in the words of messages, and what content looks like whatever its name says.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/monitor.hpp"

namespace ballflow::geometry {

enum class MeshFormat { off, obj, ply, stl, xyz };

/// "OFF", "OBJ", "PLY", "STL" or "points as text".
const char* name_of(MeshFormat format);

/// For hints: the formats of models, of balls and of covers that are read.
extern const char* const readable_models;
extern const char* const readable_balls;
extern const char* const readable_covers;

/// The extension in small letters (".off"), before .gz or .zst.
std::string lower_extension(const std::string& path);

/// Whether the extension is one of a model, or of balls (.ma, .sph), and of nothing else.
bool is_model_name(const std::string& path);

/// Throws InputError naming the format when the content is certainly of one that no reader knows: glTF, DAE,
/// VTK, PCD, URDF and SRDF, STEP, DXF, FBX, Blender, LAS, E57, NumPy, Medit and Gmsh files, other XML and
/// JSON, web pages, and pointers of Git LFS. `hint` lists what is readable.
void refuse_other_formats(std::string_view content, const std::string& hint);

/// The format of a model whose content cannot be of another one; none where that is open.
std::optional<MeshFormat> certain_format(std::string_view content);

/// The format of a model. Where its extension (which .gz or .zst may follow) and its content disagree, the
/// content decides, with a warning; for names without extension, .txt and .dat it decides alone. Points as
/// text are .xyz .pts .pwn .csv .asc. Throws InputError for an unknown extension when the content does not
/// tell either, and for other formats by their names.
MeshFormat format_of(const std::string& path, std::string_view content, Monitor& monitor = no_monitor());

/// Whether the token is the first word of an OFF file: [ST][C][N]OFF and their variants with 4 or n, in any
/// case; the number of vertices may follow without a blank, as in ModelNet ("OFF288").
struct OffKeyword {
  bool textures = false, colours = false, normals = false, homogeneous = false, dimension = false;
  std::size_t size = 0;  // characters up to and with "OFF"
};
std::optional<OffKeyword> off_keyword(std::string_view token);

}  // namespace ballflow::geometry

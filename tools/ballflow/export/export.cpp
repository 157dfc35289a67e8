#include "export/export.hpp"

#include <algorithm>
#include <filesystem>

#include "ballflow/error.hpp"
#include "export/format_table.hpp"

namespace ballflow {
namespace {

const std::vector<TypeFormats>& table() {
  static const std::vector<TypeFormats> types = {point_set_formats(),
                                                 triangle_mesh_formats(),
                                                 balls_formats(),
                                                 pole_set_formats(),
                                                 local_feature_size_formats(),
                                                 growth_formats(),
                                                 cover_state_formats(),
                                                 simplicial_complex_formats(),
                                                 medial_axis_formats(),
                                                 topology_table_formats(),
                                                 sample_assignment_formats(),
                                                 surface_report_formats(),
                                                 robot_formats(),
                                                 robot_spheres_formats(),
                                                 polygon2_formats(),
                                                 disc_outline_formats(),
                                                 ball_distance_formats(),
                                                 path_formats(),
                                                 matched_balls_formats(),
                                                 way_formats(),
                                                 shape_prior_formats(),
                                                 shape_fit_formats(),
                                                 ellipsoids_formats()};
  return types;
}

std::vector<Format> formats_of(std::string_view type) {
  std::vector<Format> formats;
  for (const TypeFormats& entry : table()) {
    if (entry.type == type) formats = entry.formats;
  }
  for (const Format& generic : generic_formats()) {
    const bool known = std::any_of(formats.begin(), formats.end(),
                                   [&](const Format& format) { return format.name == generic.name; });
    if (!known) formats.push_back(generic);
  }
  return formats;
}

std::string extension(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  if (!text.empty()) text.erase(0, 1);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  return text;
}

}  // namespace

std::vector<std::string> export_formats(std::string_view type) {
  std::vector<std::string> names;
  for (const Format& format : formats_of(type)) names.emplace_back(format.name);
  return names;
}

std::vector<std::string> exported_types() {
  std::vector<std::string> types;
  for (const TypeFormats& entry : table()) types.emplace_back(entry.type);
  return types;
}

std::string extension_of(std::string_view type, std::string_view format) {
  for (const Format& known : formats_of(type)) {
    if (known.name == format && !known.extension.empty()) return std::string(known.extension);
  }
  return std::string(format);
}

std::string default_format(std::string_view type) { return std::string(formats_of(type).front().name); }

void export_artifact(const Artifact& artifact, const std::string& path, const std::string& format) {
  const std::string name = format.empty() ? extension(path) : format;
  const std::vector<Format> formats = formats_of(artifact.type());
  auto found = std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.name == name; });
  if (found == formats.end() && format.empty())
    found = std::find_if(formats.begin(), formats.end(),
                         [&](const Format& f) { return !name.empty() && f.extension == name; });
  if (found == formats.end()) {
    std::string all;
    for (const Format& f : formats) all += (all.empty() ? "" : ", ") + std::string(f.name);
    throw Error(ExitCode::usage,
                name.empty() ? path + " has no extension that names a format"
                             : "a " + artifact.type() + " cannot be written as \"" + name + "\"",
                "use one of " + all);
  }
  OutputFile out(path);
  found->write(artifact, out);
  out.commit();
}

}  // namespace ballflow

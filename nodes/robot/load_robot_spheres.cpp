#include "robot/load_robot_spheres.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "io/file_content.hpp"
#include "robot/robot_spheres.hpp"
#include "urdf/sample_robot.hpp"

namespace ballflow::geometry {
namespace {

constexpr const char* formats =
    "spheres are read from cuRobo YAML, XRDF, foam and ballpark JSON, URDF, SRDF and CSV with "
    "link,x,y,z,radius";

std::string trimmed(std::string text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  std::size_t begin = 0;
  while (begin < text.size() && blank(text[begin])) ++begin;
  return text.substr(begin);
}

/// False for what is no finite number.
bool to_number(const std::string& text, double& value) {
  const char* from = text.data();
  const char* const end = from + text.size();
  if (from != end && *from == '+') ++from;
  const auto [stop, error] = std::from_chars(from, end, value);
  return error == std::errc() && stop == end && from != end && std::isfinite(value);
}

class YamlSpheres {
 public:
  YamlSpheres(const std::string& file, std::vector<std::string>& warnings)
      : file_(file), warnings_(warnings) {}

  std::vector<LinkSpheres> read(const YAML::Node& root) {
    if (!root.IsMap()) fail(root, "is no list of spheres by link", formats);
    for (const YAML::Node& kinematics :
         {child(child(root, "robot_cfg"), "kinematics"), child(root, "kinematics"), root}) {
      tell_buffer(kinematics);
      const YAML::Node spheres = child(kinematics, "collision_spheres");
      if (!spheres.IsDefined()) continue;
      if (spheres.IsScalar())
        fail(spheres, "names another file for its spheres, \"" + spheres.Scalar() + "\"", "give that file");
      add_any(spheres);
      return std::move(all_);
    }
    const YAML::Node geometry = child(root, "geometry");
    if (geometry.IsDefined() && geometry.IsMap()) {
      for (const auto& entry : geometry) {
        const YAML::Node spheres = child(entry.second, "spheres");
        if (spheres.IsDefined()) add_any(spheres);
      }
      if (!all_.empty()) return std::move(all_);
    }
    const YAML::Node spheres = child(root, "spheres");
    add_any(spheres.IsDefined() ? spheres : root);
    return std::move(all_);
  }

 private:
  [[noreturn]] void fail(const YAML::Node& at, const std::string& why, const std::string& hint) const {
    const int line = at.IsDefined() ? at.Mark().line + 1 : 0;
    throw InputError(file_ + (line > 0 ? ":" + std::to_string(line) : "") + " " + why, hint);
  }

  static YAML::Node child(const YAML::Node& node, const char* name) {
    const YAML::Node missing(YAML::NodeType::Undefined);
    if (!node.IsDefined() || !node.IsMap()) return missing;
    const YAML::Node found = node[name];
    return found.IsDefined() ? found : missing;
  }

  void tell_buffer(const YAML::Node& kinematics) {
    const YAML::Node buffer = child(kinematics, "collision_sphere_buffer");
    double value = 0;
    if (buffer.IsDefined() && buffer.IsScalar() && to_number(buffer.Scalar(), value) && value != 0)
      warnings_.push_back(file_ + " asks for a buffer of " + buffer.Scalar() +
                          " m around its spheres in the world, which is not added: buffer");
  }

  double number(const YAML::Node& node, const std::string& what) const {
    double value = 0;
    if (!node.IsDefined() || !node.IsScalar() || !to_number(node.Scalar(), value))
      fail(node, what + " is no finite number", "write metres with a decimal point");
    return value;
  }

  Vec3 point(const YAML::Node& node, const std::string& what) const {
    if (!node.IsDefined() || !node.IsSequence() || node.size() != 3)
      fail(node, what + " has no centre of three numbers", "center: [x, y, z]");
    return {number(node[0], what), number(node[1], what), number(node[2], what)};
  }

  LinkSpheres& of_link(const std::string& link) {
    for (LinkSpheres& known : all_) {
      if (known.link == link) return known;
    }
    return all_.emplace_back(LinkSpheres{link, {}, {}});
  }

  void add_sphere(const YAML::Node& sphere, const std::string& link) {
    const std::string what = link.empty() ? "a sphere" : "a sphere of link \"" + link + "\"";
    if (!sphere.IsMap()) fail(sphere, "has " + what + " that is no {center, radius}", formats);
    YAML::Node center(YAML::NodeType::Undefined);
    for (const char* const name : {"center", "origin", "position", "xyz", "centre"}) {
      if (const YAML::Node found = child(sphere, name); found.IsDefined()) center.reset(found);
    }
    LinkSpheres& to = of_link(link);
    to.centers.push_back(point(center, "says: " + what));
    const YAML::Node radius = child(sphere, "radius");
    to.radii.push_back(
        number(radius.IsDefined() ? radius : child(sphere, "r"), "says: the radius of " + what));
  }

  void add_any(const YAML::Node& spheres) {
    if (spheres.IsSequence()) {  // each names its link, or none does
      for (const YAML::Node& sphere : spheres) {
        const YAML::Node link = child(sphere, "link");
        add_sphere(sphere, link.IsDefined() && link.IsScalar() ? link.Scalar() : "");
      }
      return;
    }
    if (!spheres.IsMap()) fail(spheres, "has no spheres", formats);
    for (const auto& entry : spheres) {
      const std::string link = entry.first.IsScalar() ? entry.first.Scalar() : "";
      const YAML::Node value = entry.second;
      if (value.IsSequence()) {
        of_link(link);
        for (const YAML::Node& sphere : value) add_sphere(sphere, link);
      } else if (child(value, "spheres").IsDefined() && child(value, "spheres").IsSequence()) {
        of_link(link);
        for (const YAML::Node& sphere : child(value, "spheres")) add_sphere(sphere, link);
      } else if (child(value, "centers").IsDefined() && child(value, "radii").IsDefined()) {
        const YAML::Node centers = child(value, "centers"), radii = child(value, "radii");
        if (!centers.IsSequence() || !radii.IsSequence() || centers.size() != radii.size())
          fail(value, "has other numbers of centres and radii for link \"" + link + "\"", formats);
        LinkSpheres& to = of_link(link);
        for (std::size_t i = 0; i < centers.size(); ++i) {
          to.centers.push_back(point(centers[i], "says: a sphere of link \"" + link + "\""));
          to.radii.push_back(number(radii[i], "says: a radius of link \"" + link + "\""));
        }
      } else if (value.IsNull()) {
        of_link(link);
      } else {
        fail(value, "has no list of spheres for \"" + link + "\"", formats);
      }
    }
  }

  const std::string& file_;
  std::vector<std::string>& warnings_;
  std::vector<LinkSpheres> all_;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

std::vector<LinkSpheres> read_csv(std::string_view content, const std::string& file) {
  std::vector<LinkSpheres> all;
  std::map<std::string, std::size_t> columns, place;
  std::int64_t number = 0;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    const std::string line(content.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (trimmed(line).empty() || line.starts_with("#")) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (columns.empty()) {
      for (std::size_t i = 0; i < cells.size(); ++i)
        columns.emplace(cells[i] == "radius" ? "r" : cells[i], i);
      for (const char* const name : {"link", "x", "y", "z", "r"}) {
        if (!columns.contains(name))
          throw InputError(file + ":" + std::to_string(number) + " has no column \"" + name + "\"",
                           "link,x,y,z,radius");
      }
      continue;
    }
    std::array<double, 4> values{};
    std::size_t k = 0;
    for (const char* const name : {"x", "y", "z", "r"}) {
      const std::size_t column = columns.at(name);
      if (column >= cells.size() || !to_number(cells[column], values[k++]))
        throw InputError(file + ":" + std::to_string(number) + ": \"" + name + "\" is no finite number",
                         "write metres with a decimal point");
    }
    const std::size_t column = columns.at("link");
    const std::string link = column < cells.size() ? cells[column] : "";
    const auto [known, fresh] = place.emplace(link, all.size());
    if (fresh) all.push_back({link, {}, {}});
    all[known->second].centers.push_back({values[0], values[1], values[2]});
    all[known->second].radii.push_back(values[3]);
  }
  return all;
}

}  // namespace

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  if (text.starts_with("[")) {
    try {
      for (const YAML::Node& name : YAML::Load(text)) names.push_back(name.as<std::string>());
      return names;
    } catch (const YAML::Exception& error) {
      throw InputError(std::string("the list of links is no JSON: ") + error.what(),
                       "[\"hand\", \"arm\"], or hand,arm");
    }
  }
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    names.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

std::vector<LinkSpheres> parse_link_spheres(std::string_view content, const std::string& file,
                                            std::vector<std::string>& warnings) {
  const auto next_text = [&](std::size_t from) { return content.find_first_not_of(" \t\r\n", from); };
  std::size_t first = next_text(0);
  while (first < content.size() && content[first] == '#')
    first = next_text(std::min(content.find('\n', first), content.size()));
  if (first >= content.size()) throw InputError(file + " has nothing in it", formats);
  std::vector<LinkSpheres> all;
  const std::string_view line = content.substr(first, content.find('\n', first) - first);
  if (content[first] == '<') {
    all = spheres_in_xml(content, file, warnings);
  } else if (line.find(',') != std::string_view::npos && line.find("link") != std::string_view::npos &&
             line.find_first_of("{[:") == std::string_view::npos) {
    all = read_csv(content, file);
  } else {
    try {
      all = YamlSpheres(file, warnings).read(YAML::Load(std::string(content)));
    } catch (const YAML::Exception& error) {
      throw InputError(
          file + ":" + std::to_string(error.mark.line + 1) + " is neither YAML nor JSON: " + error.msg,
          formats);
    }
  }
  for (LinkSpheres& link : all) {
    LinkSpheres kept{link.link, {}, {}};
    for (std::size_t i = 0; i < link.radii.size(); ++i) {
      if (!(link.radii[i] > 0)) continue;
      kept.centers.push_back(link.centers[i]);
      kept.radii.push_back(link.radii[i]);
    }
    if (kept.radii.size() < link.radii.size())
      warnings.push_back(file + ": " + std::to_string(link.radii.size() - kept.radii.size()) +
                         " spheres of link \"" + link.link +
                         "\" have a radius of 0 or less: they are left out");
    link = std::move(kept);
  }
  return all;
}

RobotSpheres load_robot_spheres(const Robot& robot, const LoadRobotSpheresOptions& options,
                                Monitor& monitor) {
  std::vector<std::string> warnings;
  const std::string content =
      options.file.starts_with(sample_spheres_scheme)
          ? sample_spheres(options.file)
          : std::string(read_file_content(options.file, std::int64_t{1} << 28).view());
  const std::vector<LinkSpheres> all = parse_link_spheres(content, options.file, warnings);
  for (const std::string& warning : warnings) monitor.warn(warning);
  const std::vector<std::string> names = names_of(robot.link_names), shaped = links_with_surface(robot);
  std::vector<std::vector<Vec3>> centers(robot.links());
  std::vector<std::vector<double>> radii(robot.links());
  std::size_t used = 0;
  for (const LinkSpheres& spheres : all) {
    std::string link = spheres.link;
    if (link.empty()) {
      link = shaped.size() == 1 ? shaped[0] : std::filesystem::path(options.file).stem().string();
      if (std::find(names.begin(), names.end(), link) == names.end())
        throw InputError(options.file + " does not say which link its spheres are for",
                         "name the file like the link, or give a file with names of links");
    }
    const auto found = std::find(names.begin(), names.end(), link);
    if (found == names.end()) {
      monitor.warn(options.file + ": the robot has no link \"" + link + "\": its " +
                   std::to_string(spheres.radii.size()) + " spheres are left out");
      continue;
    }
    const auto place = static_cast<std::size_t>(found - names.begin());
    for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
      centers[place].push_back(spheres.centers[i]);
      radii[place].push_back(spheres.radii[i] + options.buffer);
    }
    used += spheres.radii.size();
  }
  if (used == 0) {
    std::string known;
    for (std::size_t i = 0; i < names.size() && i < 30; ++i) known += (i == 0 ? "" : ", ") + names[i];
    throw InputError(
        options.file + " has no sphere for a link of the robot \"" + std::string(view(robot.name)) + "\"",
        "its links are " + known);
  }
  return with_balls(robot, centers, radii);
}

}  // namespace ballflow::geometry

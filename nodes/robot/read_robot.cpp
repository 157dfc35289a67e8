#include "robot/read_robot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/first_equal.hpp"
#include "io/file_content.hpp"
#include "io/formats.hpp"
#include "io/model_faces.hpp"
#include "io/raw_model.hpp"
#include "robot/mesh_files.hpp"
#include "robot/read_dae.hpp"
#include "robot/solids.hpp"
#include "urdf/sample_robot.hpp"
#include "urdf/urdf.hpp"

namespace ballflow::geometry {
namespace {

namespace fs = std::filesystem;

constexpr Vec3 positive_zero{0, 0, 0};  // -0 + 0 is 0, and equal points have equal bits
constexpr std::int64_t most_bytes = std::int64_t{2} << 30;

/// The text of the URDF and what messages call it.
std::string urdf_text(const ReadRobotOptions& options) {
  if (options.file.starts_with(sample_robot_scheme)) return sample_robot(options.file);
  return std::string(read_file_content(options.file, most_bytes).view());
}

MeshPlaces places_of(const ReadRobotOptions& options) {
  return {fs::path(options.file).parent_path().string(), folders_in(options.packages)};
}

const std::vector<UrdfShape>& shapes_of(const UrdfLink& link, RobotGeometry geometry) {
  return geometry == RobotGeometry::visual ? link.visuals : link.collisions;
}

SolidMesh read_model(const std::string& path, Monitor& monitor) {
  const FileContent content = read_file_content(path, most_bytes);
  if (lower_extension(path) == ".dae") return read_dae(content.view(), path, monitor);
  RawModel raw;
  switch (format_of(path, content.view(), monitor)) {
    case MeshFormat::off:
      raw = parse_off(content.view(), monitor);
      break;
    case MeshFormat::obj:
      raw = parse_obj(content.view(), monitor);
      break;
    case MeshFormat::ply:
      raw = parse_ply(content.view(), monitor);
      break;
    case MeshFormat::stl:
      raw = parse_stl(content.view(), monitor);
      break;
    case MeshFormat::xyz:
      throw InputError(path + " has points and no triangles", "name the mesh of the link");
  }
  for (const std::string& warning : raw.warnings) monitor.warn(path + ": " + warning);
  for (Vec3& v : raw.vertices) v = v + positive_zero;
  FaceCounts counts;
  SolidMesh mesh;
  mesh.triangles = triangles_of(raw, first_equal_point(raw.vertices), counts, monitor);
  mesh.vertices = std::move(raw.vertices);
  if (mesh.triangles.empty()) throw InputError(path + " has no triangles", "name the mesh of the link");
  return mesh;
}

class RobotReader {
 public:
  RobotReader(const ReadRobotOptions& options, Monitor& monitor)
      : options_(options), monitor_(monitor), places_(places_of(options)) {}

  Robot read() {
    const std::string text = urdf_text(options_);
    const Urdf urdf = parse_urdf(text, options_.file);
    for (const std::string& warning : urdf.warnings) monitor_.warn(warning);
    Robot robot;
    robot.description = text_of(text);
    robot.name = text_of(urdf.name);
    add_tree(urdf, robot);
    std::vector<std::int64_t> vertex_ends, triangle_ends;
    for (const UrdfLink& link : urdf.links) {
      monitor_.step(static_cast<double>(vertex_ends.size()) / static_cast<double>(urdf.links.size()));
      add_surface(link);
      vertex_ends.push_back(static_cast<std::int64_t>(vertices_.size()));
      triangle_ends.push_back(static_cast<std::int64_t>(triangles_.size()));
    }
    robot.vertex_ends = std::move(vertex_ends);
    robot.triangle_ends = std::move(triangle_ends);
    robot.vertices = std::move(vertices_);
    robot.triangles = std::move(triangles_);
    return robot;
  }

 private:
  static void add_tree(const Urdf& urdf, Robot& robot) {
    std::map<std::string, std::int32_t> link_ids, joint_ids;
    std::vector<std::string> links, joints;
    for (const UrdfLink& link : urdf.links) {
      link_ids[link.name] = static_cast<std::int32_t>(links.size());
      links.push_back(link.name);
    }
    for (const UrdfJoint& joint : urdf.joints) {
      joint_ids[joint.name] = static_cast<std::int32_t>(joints.size());
      joints.push_back(joint.name);
    }
    std::vector<std::uint8_t> kinds;
    std::vector<std::int32_t> parents, children, mimics;
    std::vector<Pose> origins;
    std::vector<Vec3> axes;
    std::vector<std::array<double, 2>> limits, lines;
    for (const UrdfJoint& joint : urdf.joints) {
      kinds.push_back(static_cast<std::uint8_t>(joint.kind));
      parents.push_back(link_ids.at(joint.parent));
      children.push_back(link_ids.at(joint.child));
      origins.push_back(joint.origin);
      axes.push_back(joint.axis);
      limits.push_back({joint.lower, joint.upper});
      mimics.push_back(joint.mimics.empty() ? -1 : joint_ids.at(joint.mimics));
      lines.push_back({joint.mimic_factor, joint.mimic_offset});
    }
    robot.link_names = names_text(links);
    robot.joint_names = names_text(joints);
    robot.joint_kinds = std::move(kinds);
    robot.joint_parents = std::move(parents);
    robot.joint_children = std::move(children);
    robot.joint_origins = std::move(origins);
    robot.joint_axes = std::move(axes);
    robot.joint_limits = std::move(limits);
    robot.joint_mimics = std::move(mimics);
    robot.joint_mimic_lines = std::move(lines);
  }

  const SolidMesh& model(const UrdfShape& shape, const std::string& where) {
    const MeshPlace place = find_mesh(shape.file, places_);
    if (place.path.empty())
      throw InputError(where + ": there is no mesh \"" + shape.file + "\", nor one of its name below " +
                           (places_.folder.empty() ? std::string("this folder") : places_.folder),
                       "name the folder that has the package or the meshes: packages");
    if (!place.as_named && told_.insert(shape.file).second)
      monitor_.warn(where + ": " + shape.file + " is not there; " + place.path + " is taken");
    const auto known = models_.find(place.path);
    if (known != models_.end()) return known->second;
    return models_[place.path] = read_model(place.path, monitor_);
  }

  /// Null for shapes without a volume.
  const SolidMesh* solid(const UrdfShape& shape, const std::string& where, SolidMesh& made) {
    const Vec3 s = shape.size;
    bool flat = false;
    switch (shape.kind) {
      case UrdfShape::Kind::mesh:
        return &model(shape, where);
      case UrdfShape::Kind::box:
        flat = s.x == 0 || s.y == 0 || s.z == 0;
        if (!flat) made = box_mesh(s);
        break;
      case UrdfShape::Kind::cylinder:
        flat = s.x == 0 || s.y == 0;
        if (!flat) made = cylinder_mesh(s.x, s.y);
        break;
      case UrdfShape::Kind::sphere:
        flat = s.x == 0;
        if (!flat) made = ball_mesh_around(s.x);
        break;
    }
    if (flat) monitor_.warn(where + ": a shape of size 0 is left out");
    return flat ? nullptr : &made;
  }

  void add_surface(const UrdfLink& link) {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (const UrdfShape& shape : shapes_of(link, options_.geometry)) {
      const std::string where =
          options_.file + ":" + std::to_string(shape.line) + ": link \"" + link.name + "\"";
      SolidMesh made;
      const SolidMesh* part = nullptr;
      try {
        part = solid(shape, where, made);
      } catch (const InputError& error) {
        const std::string text = error.what();
        if (text.starts_with(options_.file)) throw;
        const std::size_t split = text.find('\n');
        throw InputError(where + ": " + text.substr(0, split),
                         split == std::string::npos ? "" : text.substr(split + 1));
      }
      if (part == nullptr) continue;
      const auto first = static_cast<std::int32_t>(vertices.size());
      if (vertices.size() + part->vertices.size() > 2'000'000'000)
        throw InputError(where + " has more than 2 000 000 000 vertices", "simplify its meshes");
      const Vec3 s = shape.scale;
      for (const Vec3& v : part->vertices) {
        vertices.push_back(moved(shape.origin, {s.x * v.x, s.y * v.y, s.z * v.z}) + positive_zero);
        if (!is_finite(vertices.back()))
          throw InputError(where + ": a vertex is not finite after scale and origin", "check both");
      }
      const bool mirrored = s.x * s.y * s.z < 0;
      for (Triangle t : part->triangles) {
        if (mirrored) std::swap(t[1], t[2]);
        triangles.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
    weld_equal(vertices, triangles);
  }

  /// Appends them: each point once, without triangles that have one twice.
  void weld_equal(std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
    const std::vector<std::int32_t> first = first_equal_point(vertices);
    std::vector<std::int32_t> place(vertices.size(), -1);
    std::int32_t next = 0;
    for (const Triangle& t : triangles) {
      Triangle welded{};
      for (std::size_t k = 0; k < 3; ++k) welded[k] = first[static_cast<std::size_t>(t[k])];
      if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
      for (std::int32_t& v : welded) {
        std::int32_t& to = place[static_cast<std::size_t>(v)];
        if (to < 0) {
          to = next++;
          vertices_.push_back(vertices[static_cast<std::size_t>(v)]);
        }
        v = to;
      }
      triangles_.push_back(welded);
    }
  }

  const ReadRobotOptions& options_;
  Monitor& monitor_;
  const MeshPlaces places_;
  std::map<std::string, SolidMesh> models_;  // by path
  std::set<std::string> told_;
  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
};

}  // namespace

Robot read_robot(const ReadRobotOptions& options, Monitor& monitor) {
  return RobotReader(options, monitor).read();
}

std::vector<std::pair<std::string, std::string>> mesh_files_of(const ReadRobotOptions& options) {
  std::map<std::string, std::string> files;
  try {
    const MeshPlaces places = places_of(options);
    const Urdf urdf = parse_urdf(urdf_text(options), options.file);
    for (const UrdfLink& link : urdf.links) {
      for (const UrdfShape& shape : shapes_of(link, options.geometry)) {
        if (shape.kind == UrdfShape::Kind::mesh && !files.contains(shape.file))
          files[shape.file] = find_mesh(shape.file, places).path;
      }
    }
  } catch (const InputError&) {
    return {};  // read_robot says why
  }
  return {files.begin(), files.end()};
}

}  // namespace ballflow::geometry

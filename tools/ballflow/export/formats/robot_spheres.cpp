#include "export/formats/robot_spheres.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ballflow/json.hpp"
#include "urdf/sphere_xml.hpp"

namespace ballflow {
namespace {

using geometry::Balls;
using geometry::JointKind;
using geometry::Pose;
using geometry::RobotSpheres;
using geometry::shortest_text;
using geometry::Vec3;
using geometry::xml_text;

std::string plain(Vec3 v) { return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z); }
std::string listed(Vec3 v) {
  return "[" + shortest_text(v.x) + ", " + shortest_text(v.y) + ", " + shortest_text(v.z) + "]";
}

/// A text in double quotes, as JSON and YAML have it.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// "[a, b]"
std::string quoted_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + quoted(name);
  return "[" + list + "]";
}

std::string root_of(const RobotSpheres& spheres) {
  return names_of(spheres.link_names)[geometry::from_root(spheres).front()];
}

std::vector<std::string> links_with_balls(const RobotSpheres& spheres) {
  std::vector<std::string> names = names_of(spheres.link_names), with;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (geometry::balls_of(spheres, i).size() > 0) with.push_back(names[i]);
  }
  return with;
}

/// For each link those after it that need no test against it.
std::vector<std::vector<std::string>> ignored(const RobotSpheres& spheres) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  std::vector<std::vector<std::string>> lists(names.size());
  for (const auto& [a, b] : spheres.pair_links)
    lists[static_cast<std::size_t>(a)].push_back(names[static_cast<std::size_t>(b)]);
  return lists;
}

/// "link": and a list of spheres, for every link with balls.
void yaml_spheres(const RobotSpheres& spheres, const std::string& indent, OutputFile& out) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Balls balls = geometry::balls_of(spheres, i);
    if (balls.size() == 0) continue;
    out << indent << quoted(names[i]) << ":\n";
    for (std::size_t k = 0; k < balls.size(); ++k)
      out << indent << "  - center: " << listed(balls.centers[k]) << "\n"
          << indent << "    radius: " << shortest_text(balls.radii[k]) << "\n";
  }
}

void yaml_ignored(const RobotSpheres& spheres, const std::string& indent, OutputFile& out) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  const auto lists = ignored(spheres);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!lists[i].empty()) out << indent << quoted(names[i]) << ": " << quoted_list(lists[i]) << "\n";
  }
}

std::string pairs_words(const RobotSpheres& spheres) {
  return spheres.poses == 0 ? "pairs of links were not looked for"
                            : "pairs by " + std::to_string(spheres.poses) + " sampled poses, not proven";
}

double default_value(const RobotSpheres& spheres, std::size_t joint) {
  const auto [lower, upper] = spheres.joint_limits[joint];
  const bool limited = spheres.joint_kinds[joint] == static_cast<std::uint8_t>(JointKind::revolute) ||
                       spheres.joint_kinds[joint] == static_cast<std::uint8_t>(JointKind::prismatic);
  return limited && lower <= upper ? std::clamp(0.0, lower, upper) : 0.0;
}

/// w x y z
std::string quaternion(const Pose& p) {
  // The largest of the four is found without loss, the others from it.
  const std::array<double, 4> squares = {1 + p[0] + p[4] + p[8], 1 + p[0] - p[4] - p[8],
                                         1 - p[0] + p[4] - p[8], 1 - p[0] - p[4] + p[8]};
  const auto largest =
      static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  const double s = 2 * std::sqrt(squares[largest]);
  std::array<double, 4> q{};
  switch (largest) {
    case 0:
      q = {s / 4, (p[7] - p[5]) / s, (p[2] - p[6]) / s, (p[3] - p[1]) / s};
      break;
    case 1:
      q = {(p[7] - p[5]) / s, s / 4, (p[1] + p[3]) / s, (p[2] + p[6]) / s};
      break;
    case 2:
      q = {(p[2] - p[6]) / s, (p[1] + p[3]) / s, s / 4, (p[5] + p[7]) / s};
      break;
    default:
      q = {(p[3] - p[1]) / s, (p[2] + p[6]) / s, (p[5] + p[7]) / s, s / 4};
      break;
  }
  return shortest_text(q[0]) + " " + shortest_text(q[1]) + " " + shortest_text(q[2]) + " " +
         shortest_text(q[3]);
}

class MjcfWriter {
 public:
  MjcfWriter(const RobotSpheres& spheres, OutputFile& out)
      : spheres_(spheres),
        out_(out),
        links_(names_of(spheres.link_names)),
        joints_(names_of(spheres.joint_names)) {}

  void write() {
    out_ << "<mujoco model=\"" << xml_text(geometry::view(spheres_.name))
         << "\">\n  <compiler angle=\"radian\"/>\n"
         << "  <worldbody>\n";
    // Bodies from the root on, without recursion: a robot may be a long chain.
    std::vector<std::vector<std::size_t>> children(links_.size());
    for (std::size_t j = 0; j < joints_.size(); ++j)
      children[static_cast<std::size_t>(spheres_.joint_parents[j])].push_back(j);
    struct Open {
      std::size_t link, next;
    };
    std::vector<Open> open;
    const std::size_t root = geometry::from_root(spheres_).front();
    begin(root, nullptr, 2);
    open.push_back({root, 0});
    while (!open.empty()) {
      Open& at = open.back();
      if (at.next == children[at.link].size()) {
        open.pop_back();
        out_ << std::string(2 * open.size() + 4, ' ') << "</body>\n";
        continue;
      }
      const std::size_t joint = children[at.link][at.next++];
      const auto link = static_cast<std::size_t>(spheres_.joint_children[joint]);
      begin(link, &joint, open.size() + 2);
      open.push_back({link, 0});
    }
    out_ << "  </worldbody>\n";
    contacts();
    followers();
    out_ << "</mujoco>\n";
  }

 private:
  void begin(std::size_t link, const std::size_t* joint, std::size_t depth) {
    const std::string indent(2 * depth, ' ');
    out_ << indent << "<body name=\"" << xml_text(links_[link]) << "\"";
    if (joint != nullptr) {
      const Pose& pose = spheres_.joint_origins[*joint];
      out_ << " pos=\"" << plain({pose[9], pose[10], pose[11]}) << "\" quat=\"" << quaternion(pose) << "\"";
    }
    out_ << ">\n";
    if (joint != nullptr) write_joint(*joint, indent + "  ");
    const Balls balls = geometry::balls_of(spheres_, link);
    for (std::size_t k = 0; k < balls.size(); ++k)
      out_ << indent << "  <geom type=\"sphere\" size=\"" << shortest_text(balls.radii[k]) << "\" pos=\""
           << plain(balls.centers[k]) << "\"/>\n";
  }

  void write_joint(std::size_t joint, const std::string& indent) {
    const auto kind = static_cast<JointKind>(spheres_.joint_kinds[joint]);
    const bool turns = kind == JointKind::revolute || kind == JointKind::continuous;
    if (!turns && kind != JointKind::prismatic) return;
    out_ << indent << "<joint name=\"" << xml_text(joints_[joint]) << "\" type=\""
         << (turns ? "hinge" : "slide") << "\" axis=\"" << plain(spheres_.joint_axes[joint]) << "\"";
    if (kind != JointKind::continuous)
      out_ << " limited=\"true\" range=\"" << shortest_text(spheres_.joint_limits[joint][0]) << " "
           << shortest_text(spheres_.joint_limits[joint][1]) << "\"";
    out_ << "/>\n";
  }

  void contacts() {
    if (spheres_.pair_links.empty()) return;
    out_ << "  <contact>\n";
    for (const auto& [a, b] : spheres_.pair_links)
      out_ << "    <exclude body1=\"" << xml_text(links_[static_cast<std::size_t>(a)]) << "\" body2=\""
           << xml_text(links_[static_cast<std::size_t>(b)]) << "\"/>\n";
    out_ << "  </contact>\n";
  }

  void followers() {
    std::string lines;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      if (spheres_.joint_mimics[j] < 0) continue;
      const auto [factor, offset] = spheres_.joint_mimic_lines[j];
      lines += "    <joint joint1=\"" + xml_text(joints_[j]) + "\" joint2=\"" +
               xml_text(joints_[static_cast<std::size_t>(spheres_.joint_mimics[j])]) + "\" polycoef=\"" +
               shortest_text(offset) + " " + shortest_text(factor) + " 0 0 0\"/>\n";
    }
    if (!lines.empty()) out_ << "  <equality>\n" << lines << "  </equality>\n";
  }

  const RobotSpheres& spheres_;
  OutputFile& out_;
  const std::vector<std::string> links_, joints_;
};

}  // namespace

void write_spheres_urdf(const RobotSpheres& spheres, OutputFile& out) {
  out << geometry::urdf_with_spheres(spheres);
}

void write_spheres_srdf(const RobotSpheres& spheres, OutputFile& out) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  out << "<?xml version=\"1.0\"?>\n<!-- " << pairs_words(spheres) << " -->\n<robot name=\""
      << xml_text(geometry::view(spheres.name)) << "\">\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Balls balls = geometry::balls_of(spheres, i);
    out << "  <link_sphere_approximation link=\"" << xml_text(names[i]) << "\">\n";
    for (std::size_t k = 0; k < balls.size(); ++k)
      out << "    <sphere center=\"" << plain(balls.centers[k]) << "\" radius=\""
          << shortest_text(balls.radii[k]) << "\"/>\n";
    if (balls.size() == 0) out << "    <sphere center=\"0 0 0\" radius=\"0\"/>\n";
    out << "  </link_sphere_approximation>\n";
  }
  for (std::size_t i = 0; i < spheres.pair_links.size(); ++i) {
    std::string reason = name_of(static_cast<geometry::PairReason>(spheres.pair_reasons[i]));
    reason[0] = static_cast<char>(reason[0] - 'a' + 'A');
    out << "  <disable_collisions link1=\""
        << xml_text(names[static_cast<std::size_t>(spheres.pair_links[i][0])]) << "\" link2=\""
        << xml_text(names[static_cast<std::size_t>(spheres.pair_links[i][1])]) << "\" reason=\"" << reason
        << "\"/>\n";
  }
  out << "</robot>\n";
}

void write_curobo(const RobotSpheres& spheres, OutputFile& out) {
  const std::vector<std::string> with = links_with_balls(spheres);
  out << "# Spheres of links in metres; " << pairs_words(spheres)
      << ".\n# urdf_path, ee_link and cspace are not known here: add yours.\nrobot_cfg:\n  kinematics:\n    "
         "base_link: "
      << quoted(root_of(spheres)) << "\n    collision_link_names: " << quoted_list(with)
      << "\n    collision_spheres:" << (with.empty() ? " {}\n" : "\n");
  yaml_spheres(spheres, "      ", out);
  out << "    collision_sphere_buffer: 0.0\n    self_collision_ignore:"
      << (spheres.pair_links.empty() ? " {}\n" : "\n");
  yaml_ignored(spheres, "      ", out);
  out << "    self_collision_buffer:" << (with.empty() ? " {}\n" : "\n");
  for (const std::string& link : with) out << "      " << quoted(link) << ": 0.0\n";
}

void write_xrdf(const RobotSpheres& spheres, OutputFile& out) {
  const std::vector<std::string> with = links_with_balls(spheres), joints = names_of(spheres.joint_names);
  out << "# Spheres of links in metres; " << pairs_words(spheres)
      << ".\n# cspace and tool_frames are not known here: add yours.\nformat: xrdf\nformat_version: 1.0\n"
      << "default_joint_positions:";
  std::string positions;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto kind = static_cast<JointKind>(spheres.joint_kinds[j]);
    if ((kind == JointKind::revolute || kind == JointKind::continuous || kind == JointKind::prismatic) &&
        spheres.joint_mimics[j] < 0)
      positions += "  " + quoted(joints[j]) + ": " + shortest_text(default_value(spheres, j)) + "\n";
  }
  out << (positions.empty() ? " {}\n" : "\n") << positions
      << "geometry:\n  \"spheres\":\n    spheres:" << (with.empty() ? " {}\n" : "\n");
  yaml_spheres(spheres, "      ", out);
  out << "collision:\n  geometry: \"spheres\"\n  buffer_distance: {}\nself_collision:\n  geometry: "
         "\"spheres\"\n"
      << "  buffer_distance: {}\n  ignore:" << (spheres.pair_links.empty() ? " {}\n" : "\n");
  yaml_ignored(spheres, "    ", out);
}

void write_foam(const RobotSpheres& spheres, OutputFile& out) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  out << "{";
  const char* comma = "\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Balls balls = geometry::balls_of(spheres, i);
    if (balls.size() == 0) continue;
    out << comma << " " << quoted(names[i]) << ": {\"spheres\": [";
    comma = ",\n";
    for (std::size_t k = 0; k < balls.size(); ++k)
      out << (k == 0 ? "\n" : ",\n") << "  {\"origin\": " << listed(balls.centers[k])
          << ", \"radius\": " << shortest_text(balls.radii[k]) << "}";
    out << "]}";
  }
  out << "\n}\n";
}

void write_mjcf(const RobotSpheres& spheres, OutputFile& out) { MjcfWriter(spheres, out).write(); }

void write_spheres_csv(const RobotSpheres& spheres, OutputFile& out) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  out << "link,x,y,z,radius\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Balls balls = geometry::balls_of(spheres, i);
    const bool plain_name = names[i].find_first_of(",\"") == std::string::npos;
    for (std::size_t k = 0; k < balls.size(); ++k) {
      const Vec3 c = balls.centers[k];
      out << (plain_name ? names[i] : quoted(names[i])) << "," << shortest_text(c.x) << ","
          << shortest_text(c.y) << "," << shortest_text(c.z) << "," << shortest_text(balls.radii[k]) << "\n";
    }
  }
}

}  // namespace ballflow

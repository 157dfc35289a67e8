#include "urdf/urdf.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

using tinyxml2::XMLElement;

constexpr double full_turn = 6.283185307179586476925;

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Urdf read() {
    tinyxml2::XMLDocument document;
    if (document.Parse(text_.data(), text_.size()) != tinyxml2::XML_SUCCESS) {
      fail(document.ErrorLineNum(),
           std::string("this is no XML: ") + document.ErrorIDToName(document.ErrorID()),
           "a URDF is an XML file with a <robot> in it");
    }
    const XMLElement* root = document.RootElement();
    if (root == nullptr) fail(1, "there is no <robot>", "a URDF is an XML file with a <robot> in it");
    if (std::strcmp(root->Name(), "robot") != 0) {
      const std::string name = root->Name();
      const std::string what = name == "sdf"      ? "this is an SDF file"
                               : name == "mujoco" ? "this is an MJCF file"
                                                  : "the root element is <" + name + ">, not <robot>";
      fail(*root, what, "give the URDF of the robot");
    }
    refuse_xacro(*root);
    if (const char* name = root->Attribute("name")) urdf_.name = name;
    for (const XMLElement* at = root->FirstChildElement(); at != nullptr; at = at->NextSiblingElement()) {
      const std::string name = at->Name();
      // A <joint> of a <transmission> is another thing, and deeper; so are elements of Gazebo and Drake.
      if (name == "link") urdf_.links.push_back(link(*at));
      if (name == "joint") urdf_.joints.push_back(joint(*at));
    }
    if (urdf_.links.empty()) fail(*root, "the robot has no <link>", "give the URDF of a robot with links");
    check_names();
    check_tree();
    return std::move(urdf_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& cause, const std::string& hint) const {
    throw InputError(file_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " + cause, hint);
  }
  [[noreturn]] void fail(const XMLElement& at, const std::string& cause, const std::string& hint) const {
    fail(at.GetLineNum(), cause, hint);
  }

  /// The attribute xmlns:xacro and comments stay behind when a file is expanded, elements and commands do
  /// not.
  void refuse_xacro(const XMLElement& at) const {
    bool found = std::string_view(at.Name()).starts_with("xacro:");
    for (const tinyxml2::XMLAttribute* a = at.FirstAttribute(); a != nullptr; a = a->Next())
      found = found || std::strstr(a->Value(), "${") != nullptr || std::strstr(a->Value(), "$(") != nullptr;
    if (found) {
      const std::string stem = file_.ends_with(".xacro") ? file_.substr(0, file_.size() - 6) : "robot.urdf";
      fail(at, "this is a xacro file, which has to be expanded first",
           "xacro " + file_ + " > " + (stem.ends_with(".urdf") ? stem : stem + ".urdf"));
    }
    for (const XMLElement* part = at.FirstChildElement(); part != nullptr; part = part->NextSiblingElement())
      refuse_xacro(*part);
  }

  std::string attribute(const XMLElement& at, const char* name, const std::string& owner) const {
    const char* text = at.Attribute(name);
    if (text == nullptr || *text == '\0')
      fail(at, owner + " has no \"" + name + "\"", std::string("give it one: ") + name + "=\"...\"");
    return text;
  }

  std::string name_of(const XMLElement& at, const std::string& what) const {
    std::string name = attribute(at, "name", "<" + what + ">");
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      fail(at, "the name of a <" + what + "> has a control character in it", "give it a plain name");
    return name;
  }

  std::vector<double> numbers(const XMLElement& at, const char* text, const char* name, std::size_t wanted,
                              const std::string& owner) const {
    std::vector<double> values;
    const char* const end = text + std::strlen(text);
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; };
    for (const char* from = text;;) {
      while (from != end && blank(*from)) ++from;
      if (from == end) break;
      if (*from == '+') ++from;
      double value = 0;
      const auto [stop, error] = std::from_chars(from, end, value);
      const char* token_end = from;
      while (token_end != end && !blank(*token_end)) ++token_end;
      const std::string token(from, token_end);
      if (error != std::errc() || stop != token_end || !std::isfinite(value))
        fail(at, owner + ": \"" + name + "\" has \"" + token.substr(0, 40) + "\", which is no finite number",
             "write numbers with a decimal point");
      values.push_back(value);
      from = stop;
    }
    if (values.size() != wanted)
      fail(at,
           owner + ": \"" + name + "\" needs " + std::to_string(wanted) + " number" +
               (wanted == 1 ? "" : "s") + ", has " + std::to_string(values.size()),
           std::string("see \"") + text + "\"");
    return values;
  }
  double number(const XMLElement& at, const char* name, const std::string& owner) const {
    return numbers(at, attribute(at, name, owner).c_str(), name, 1, owner)[0];
  }
  double number_or(const XMLElement& at, const char* name, double otherwise, const std::string& owner) const {
    return at.Attribute(name) == nullptr ? otherwise : number(at, name, owner);
  }
  Vec3 vector_or(const XMLElement& at, const char* name, Vec3 otherwise, const std::string& owner) const {
    const char* text = at.Attribute(name);
    if (text == nullptr) return otherwise;
    const std::vector<double> v = numbers(at, text, name, 3, owner);
    return {v[0], v[1], v[2]};
  }
  double length_of(const XMLElement& at, const char* name, const std::string& owner) const {
    const double value = number(at, name, owner);
    if (value < 0) fail(at, owner + ": \"" + name + "\" is negative", "lengths are at least 0");
    return value;
  }

  Pose origin(const XMLElement& owner_element, const std::string& owner) const {
    const XMLElement* at = owner_element.FirstChildElement("origin");
    if (at == nullptr) return no_motion;
    const Vec3 xyz = vector_or(*at, "xyz", {}, owner), rpy = vector_or(*at, "rpy", {}, owner);
    // Around the fixed axes x, y, z, one after the other.
    Pose pose =
        composed(rotation({0, 0, 1}, rpy.z / full_turn),
                 composed(rotation({0, 1, 0}, rpy.y / full_turn), rotation({1, 0, 0}, rpy.x / full_turn)));
    pose[9] = xyz.x, pose[10] = xyz.y, pose[11] = xyz.z;
    return pose;
  }

  UrdfShape shape(const XMLElement& at, const std::string& owner) const {
    UrdfShape result;
    result.line = at.GetLineNum();
    result.origin = origin(at, owner);
    const XMLElement* geometry = at.FirstChildElement("geometry");
    const XMLElement* kind = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (kind == nullptr)
      fail(at, owner + " has no geometry", "<geometry><mesh filename=\"...\"/></geometry>");
    const std::string name = kind->Name();
    if (name == "mesh") {
      result.file = attribute(*kind, "filename", owner + ": its mesh");
      result.scale = vector_or(*kind, "scale", {1, 1, 1}, owner);
      if (result.scale.x == 0 || result.scale.y == 0 || result.scale.z == 0)
        fail(*kind, owner + ": its mesh has a scale of 0", "a scale is a factor, 1 where there is none");
    } else if (name == "box") {
      result.kind = UrdfShape::Kind::box;
      const std::vector<double> v =
          numbers(*kind, attribute(*kind, "size", owner + ": its box").c_str(), "size", 3, owner);
      result.size = {v[0], v[1], v[2]};
      if (v[0] < 0 || v[1] < 0 || v[2] < 0)
        fail(*kind, owner + ": a box with a negative edge", "lengths are at least 0");
    } else if (name == "cylinder") {
      result.kind = UrdfShape::Kind::cylinder;
      result.size = {length_of(*kind, "radius", owner), length_of(*kind, "length", owner), 0};
    } else if (name == "sphere") {
      result.kind = UrdfShape::Kind::sphere;
      result.size.x = length_of(*kind, "radius", owner);
    } else {
      fail(*kind, owner + " is a <" + name + ">, which is not read",
           "shapes are mesh, box, cylinder and sphere");
    }
    return result;
  }

  UrdfLink link(const XMLElement& at) const {
    UrdfLink result;
    result.name = name_of(at, "link");
    result.line = at.GetLineNum();
    for (const XMLElement* child = at.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string kind = child->Name();
      if (kind != "collision" && kind != "visual") continue;
      std::vector<UrdfShape>& shapes = kind == "visual" ? result.visuals : result.collisions;
      shapes.push_back(
          shape(*child, "link \"" + result.name + "\", " + kind + " " + std::to_string(shapes.size() + 1)));
    }
    return result;
  }

  UrdfJoint joint(const XMLElement& at) {
    UrdfJoint result;
    result.name = name_of(at, "joint");
    result.line = at.GetLineNum();
    const std::string owner = "joint \"" + result.name + "\"";
    static const std::map<std::string, JointKind> kinds = {
        {"fixed", JointKind::fixed},           {"revolute", JointKind::revolute},
        {"continuous", JointKind::continuous}, {"prismatic", JointKind::prismatic},
        {"floating", JointKind::floating},     {"planar", JointKind::planar}};
    const std::string type = attribute(at, "type", owner);
    const auto kind = kinds.find(type);
    if (kind == kinds.end())
      fail(at, owner + " has the type \"" + type + "\"",
           "types are fixed, revolute, continuous, prismatic, floating and planar");
    result.kind = kind->second;
    result.origin = origin(at, owner);
    for (const auto& [element, to] :
         {std::pair("parent", &result.parent), std::pair("child", &result.child)}) {
      const XMLElement* end = at.FirstChildElement(element);
      if (end == nullptr)
        fail(at, owner + " has no <" + element + ">", std::string("<") + element + " link=\"...\"/>");
      *to = attribute(*end, "link", owner + ": its " + element);
    }
    if (const XMLElement* axis = at.FirstChildElement("axis")) {
      const Vec3 given = vector_or(*axis, "xyz", {1, 0, 0}, owner);
      const double norm = length(given);
      if (!(norm > 0) && result.kind != JointKind::fixed && result.kind != JointKind::floating)
        fail(*axis, owner + " has an axis of length 0", "an axis is a direction, like \"0 0 1\"");
      if (norm > 0) result.axis = {given.x / norm, given.y / norm, given.z / norm};
    }
    const bool limited = result.kind == JointKind::revolute || result.kind == JointKind::prismatic;
    if (const XMLElement* limit = at.FirstChildElement("limit"); limit != nullptr && limited) {
      result.lower = number_or(*limit, "lower", 0, owner);
      result.upper = number_or(*limit, "upper", 0, owner);
    } else if (limited) {
      urdf_.warnings.push_back(file_ + ":" + std::to_string(result.line) + ": " + owner +
                               " has no limits: it is taken to stay at 0");
    }
    if (const XMLElement* mimic = at.FirstChildElement("mimic")) {
      result.mimics = attribute(*mimic, "joint", owner + ": its mimic");
      result.mimic_factor = number_or(*mimic, "multiplier", 1, owner);
      result.mimic_offset = number_or(*mimic, "offset", 0, owner);
    }
    return result;
  }

  template <class Item>
  void refuse_doubles(const std::vector<Item>& items, const char* what) const {
    std::map<std::string, int> lines;
    for (const Item& item : items) {
      const auto [known, fresh] = lines.emplace(item.name, item.line);
      if (!fresh)
        fail(item.line,
             std::string(what) + " \"" + item.name + "\" is there twice, first in line " +
                 std::to_string(known->second),
             "rename or remove one of them");
    }
  }

  void check_names() const {
    refuse_doubles(urdf_.links, "link");
    refuse_doubles(urdf_.joints, "joint");
    std::set<std::string> links, joints;
    for (const UrdfLink& link : urdf_.links) links.insert(link.name);
    for (const UrdfJoint& joint : urdf_.joints) joints.insert(joint.name);
    for (const UrdfJoint& joint : urdf_.joints) {
      const std::string owner = "joint \"" + joint.name + "\"";
      for (const std::string* end : {&joint.parent, &joint.child}) {
        if (!links.contains(*end))
          fail(joint.line, owner + " joins the link \"" + *end + "\", which is not there",
               "declare the link, or correct its name");
      }
      if (!joint.mimics.empty() && !joints.contains(joint.mimics))
        fail(joint.line, owner + " follows the joint \"" + joint.mimics + "\", which is not there",
             "correct the name of the joint");
    }
  }

  void check_tree() const {
    std::map<std::string, const UrdfJoint*> above;
    for (const UrdfJoint& joint : urdf_.joints) {
      const auto [known, fresh] = above.emplace(joint.child, &joint);
      if (!fresh)
        fail(joint.line,
             "link \"" + joint.child + "\" is the child of two joints, \"" + known->second->name +
                 "\" and \"" + joint.name + "\"",
             "the links of a URDF are a tree: a loop is closed by other means");
    }
    std::vector<const UrdfLink*> roots;
    for (const UrdfLink& link : urdf_.links) {
      if (!above.contains(link.name)) roots.push_back(&link);
    }
    if (roots.empty())
      fail(urdf_.joints.front().line, "the joints run in a circle", "one link is the child of no joint");
    if (roots.size() > 1)
      fail(roots[1]->line,
           "the robot has " + std::to_string(roots.size()) + " roots, \"" + roots[0]->name + "\" and \"" +
               roots[1]->name + (roots.size() > 2 ? "\" among them" : "\""),
           "join them by a joint of type fixed");
    std::set<std::string> done;
    for (const UrdfLink& link : urdf_.links) {  // every link up to the root, or to one that reaches it
      std::set<std::string> way;
      std::string at = link.name;
      while (!done.contains(at) && above.contains(at)) {
        if (!way.insert(at).second)
          fail(above.at(at)->line, "the joints run in a circle through link \"" + at + "\"",
               "the links of a URDF are a tree");
        at = above.at(at)->parent;
      }
      done.insert(way.begin(), way.end());
    }
  }

  const std::string_view text_;
  const std::string& file_;
  Urdf urdf_;
};

}  // namespace

std::vector<std::string> links_with_shapes(const Urdf& urdf, bool visual) {
  std::vector<std::string> names;
  for (const UrdfLink& link : urdf.links) {
    const std::vector<UrdfShape>& shapes = visual ? link.visuals : link.collisions;
    const auto has_volume = [](const UrdfShape& s) {
      return s.kind == UrdfShape::Kind::mesh || (s.kind == UrdfShape::Kind::sphere && s.size.x > 0) ||
             (s.size.x > 0 && s.size.y > 0 && (s.kind == UrdfShape::Kind::cylinder || s.size.z > 0));
    };
    if (std::any_of(shapes.begin(), shapes.end(), has_volume)) names.push_back(link.name);
  }
  return names;
}

Urdf parse_urdf(std::string_view text, const std::string& file) { return Reader(text, file).read(); }

}  // namespace ballflow::geometry

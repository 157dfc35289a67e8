#include "urdf/sphere_xml.hpp"

#include <tinyxml2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "base/monitor.hpp"
#include "urdf/urdf.hpp"

namespace ballflow::geometry {
namespace {

using tinyxml2::XMLElement;

std::vector<LinkSpheres> spheres_in_urdf(std::string_view text, const std::string& file,
                                         std::vector<std::string>& warnings) {
  std::vector<LinkSpheres> all;
  for (const UrdfLink& link : parse_urdf(text, file).links) {
    LinkSpheres found{link.name, {}, {}};
    std::size_t others = 0;
    for (const UrdfShape& shape : link.collisions) {
      if (shape.kind != UrdfShape::Kind::sphere) {
        ++others;
        continue;
      }
      found.centers.push_back({shape.origin[9], shape.origin[10], shape.origin[11]});
      found.radii.push_back(shape.size.x);
    }
    if (others > 0)
      warnings.push_back(file + ": link \"" + link.name + "\" has " + std::to_string(others) +
                         " collisions that are no spheres: they are left out");
    if (!found.radii.empty()) all.push_back(std::move(found));
  }
  return all;
}

std::vector<double> numbers(const XMLElement& at, const char* name, std::size_t wanted,
                            const std::string& file) {
  const auto fail = [&](const std::string& why) {
    throw InputError(file + ":" + std::to_string(at.GetLineNum()) + ": \"" + name + "\" of a sphere " + why,
                     "center=\"x y z\" radius=\"r\"");
  };
  std::vector<double> values;
  const char* from = at.Attribute(name);
  if (from == nullptr) fail("is missing");
  for (const char* const end = from + std::strlen(from);;) {
    while (from != end && (*from == ' ' || *from == '\t' || *from == '\n')) ++from;
    if (from == end) break;
    double value = 0;
    const auto [stop, error] = std::from_chars(from, end, value);
    if (error != std::errc() || !std::isfinite(value)) fail("is no finite number");
    values.push_back(value);
    from = stop;
  }
  if (values.size() != wanted) fail("has " + std::to_string(values.size()) + " numbers");
  return values;
}

std::vector<LinkSpheres> spheres_in_srdf(const XMLElement& root, const std::string& file) {
  std::vector<LinkSpheres> all;
  for (const XMLElement* at = root.FirstChildElement("link_sphere_approximation"); at != nullptr;
       at = at->NextSiblingElement("link_sphere_approximation")) {
    const char* link = at->Attribute("link");
    if (link == nullptr)
      throw InputError(file + ":" + std::to_string(at->GetLineNum()) + ": an approximation names no link",
                       "link=\"...\"");
    LinkSpheres& found = all.emplace_back(LinkSpheres{link, {}, {}});
    for (const XMLElement* sphere = at->FirstChildElement("sphere"); sphere != nullptr;
         sphere = sphere->NextSiblingElement("sphere")) {
      const std::vector<double> c = numbers(*sphere, "center", 3, file),
                                r = numbers(*sphere, "radius", 1, file);
      found.centers.push_back({c[0], c[1], c[2]});
      found.radii.push_back(r[0]);
    }
  }
  return all;
}

}  // namespace

std::string shortest_text(double value) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

std::vector<LinkSpheres> spheres_in_xml(std::string_view text, const std::string& file,
                                        std::vector<std::string>& warnings) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS &&
      document.RootElement() != nullptr && std::strcmp(document.RootElement()->Name(), "robot") == 0 &&
      document.RootElement()->FirstChildElement("link") == nullptr) {
    std::vector<LinkSpheres> all = spheres_in_srdf(*document.RootElement(), file);
    if (all.empty())
      throw InputError(file + " has neither links nor sphere approximations",
                       "give a URDF whose collisions are spheres, or an SRDF with link_sphere_approximation");
    return all;
  }
  return spheres_in_urdf(text, file, warnings);
}

std::string urdf_with_spheres(const RobotSpheres& spheres) {
  const std::string_view text = view(spheres.description);
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  XMLElement* root = document.RootElement();
  if (root == nullptr) throw InputError("the robot has no description", "read it from a URDF");
  const std::vector<std::string> names = names_of(spheres.link_names);
  for (XMLElement* link = root->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    for (XMLElement* old = link->FirstChildElement("collision"); old != nullptr;) {
      XMLElement* const next = old->NextSiblingElement("collision");
      link->DeleteChild(old);
      old = next;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (link->Attribute("name") == nullptr || names[i] != link->Attribute("name")) continue;
      const Balls balls = balls_of(spheres, i);
      for (std::size_t k = 0; k < balls.size(); ++k) {
        XMLElement* collision = link->InsertNewChildElement("collision");
        XMLElement* origin = collision->InsertNewChildElement("origin");
        const Vec3 c = balls.centers[k];
        origin->SetAttribute(
            "xyz", (shortest_text(c.x) + " " + shortest_text(c.y) + " " + shortest_text(c.z)).c_str());
        origin->SetAttribute("rpy", "0 0 0");
        XMLElement* sphere = collision->InsertNewChildElement("geometry")->InsertNewChildElement("sphere");
        sphere->SetAttribute("radius", shortest_text(balls.radii[k]).c_str());
      }
    }
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace ballflow::geometry

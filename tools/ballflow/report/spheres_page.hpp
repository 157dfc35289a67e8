// What spheres leave out of a robot, as a page that can be attached to an issue of another project.
#pragma once

#include <string>
#include <vector>

#include "types/enclosure.hpp"

namespace ballflow::report {

struct LinkCheck {
  std::string link;
  geometry::Enclosure enclosure;
  double volume = 0;        // of the union of the spheres, cubic metres
  double solid_volume = 0;  // of the link; 0 where its surface is not closed
};

struct SpheresCheck {
  std::string robot, spheres;                // names of the files
  std::string robot_digest, spheres_digest;  // SHA-256 of the contents; empty where there is no file
  std::string geometry;                      // "collision" or "visual"
  double buffer = 0;                         // metres, added to every radius
  bool enclosing = true;                     // they are meant to contain the links
  std::vector<LinkCheck> links;
  std::string version;  // of the program
};

/// A line for the terminal: "3 of 10 links enclosed by 59 spheres; 62 % of the surface is outside, up to 100
/// mm".
std::string verdict(const SpheresCheck& check);

/// A table for the terminal, a row for each link.
std::vector<std::vector<std::string>> table(const SpheresCheck& check);

std::string markdown_page(const SpheresCheck& check);
std::string html_page(const SpheresCheck& check);

}  // namespace ballflow::report

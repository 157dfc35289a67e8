// What spheres leave out of a robot, as a page that can be attached to an issue of another project.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/picture.hpp"
#include "types/enclosure.hpp"

namespace ballflow::report {

struct LinkCheck {
  std::string link;
  geometry::Enclosure enclosure;
  double volume = 0;        // of the union of the spheres, cubic metres
  double ball_volume = 0;   // of all spheres together, overlaps as often as spheres share them
  double solid_volume = 0;  // of the link; 0 where its surface is not closed
};

/// How well other numbers of spheres would do.
struct LinkCurve {
  std::string link;
  std::vector<std::pair<double, double>>
      points;  // spheres, and what the mode makes small as a part of the whole
};

struct SpheresCheck {
  std::string robot, spheres;                // names of the files
  std::string robot_digest, spheres_digest;  // SHA-256 of the contents; empty where there is no file
  std::string geometry;                      // "collision" or "visual"; empty: a mesh, no robot
  double buffer = 0;                         // metres, added to every radius
  std::string mode;       // what they were made for: "enclose", "inside", "protrude"; empty: they are checked
  bool enclosing = true;  // they are meant to contain the links
  std::vector<LinkCheck> links;
  std::vector<LinkCurve> curves;
  std::vector<Picture> pictures;  // for pages in HTML
  std::string version;            // of the program
};

/// A line for the terminal: "3 of 10 links enclosed by 59 spheres; 62 % of the surface is outside, up to 100
/// mm".
std::string verdict(const SpheresCheck& check);

/// A table for the terminal, a row for each link.
std::vector<std::vector<std::string>> table(const SpheresCheck& check);

/// Whether all links are proven to be enclosed.
bool all_enclosed(const SpheresCheck& check);

std::string markdown_page(const SpheresCheck& check);
std::string html_page(const SpheresCheck& check);

}  // namespace ballflow::report

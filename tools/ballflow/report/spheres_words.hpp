// Numbers of pages about spheres, in words.
#pragma once

#include <cstdio>
#include <string>

#include "report/spheres_page.hpp"

namespace ballflow::report {

inline std::string with_format(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

inline std::string percent(double share) {
  if (share == 0) return "0";
  return share < 0.0005 ? "under 0.05 %" : with_format(share < 0.0995 ? "%.2g %%" : "%.3g %%", 100 * share);
}

inline std::string length(double metres) { return metres == 0 ? "0" : with_format("%.3g mm", 1000 * metres); }

/// Which part of the surface is in no sphere, about.
inline double open_share(const LinkCheck& link) {
  return link.enclosure.area > 0 ? link.enclosure.open_area / link.enclosure.area : 0;
}

/// The volume of the link is known: its surface is closed.
inline bool has_volume(const LinkCheck& link) { return link.solid_volume > 0; }

}  // namespace ballflow::report

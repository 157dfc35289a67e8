// Pictures in pages.
#pragma once

#include <string>

namespace ballflow::report {

struct Picture {
  std::string title;
  std::string png;  // the bytes of the file
};

/// A figure element that holds the picture itself; `words` are said behind its title.
std::string figure(const Picture& picture, const std::string& words = {});

}  // namespace ballflow::report

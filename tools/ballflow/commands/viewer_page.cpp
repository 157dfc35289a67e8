#include "commands/viewer_page.hpp"

#include <fstream>
#include <sstream>

#include "ballflow/error.hpp"
#include "ballflow/registry.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {

std::string viewer_template(const Common& common) {
  // Node libraries are in lib/ballflow, in the build folder as where ballflow is installed.
  const std::string path = Registry::default_folder() + "/../../share/ballflow/viewer.html";
  common.places->reads("the viewer", path);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file) {
    throw Error(ExitCode::store, "this ballflow was built without its viewer",
                "\"tools/setup viewer\" installs nodejs and npm, with which the next build makes it");
  }
  return text.str();
}

}  // namespace ballflow::cli

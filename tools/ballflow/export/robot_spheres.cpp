// Robot: what can be looked at. RobotSpheres: what planners and simulators of robots read.
#include "export/formats/robot_spheres.hpp"

#include "export/format_table.hpp"
#include "types/robot_type.hpp"

namespace ballflow {
namespace {

template <void (*write)(const geometry::RobotSpheres&, OutputFile&)>
Format robot_format(std::string_view name, std::string_view extension = {}) {
  return {
      name,
      [](const Artifact& artifact, OutputFile& out) { write(typed<geometry::RobotSpheres>(artifact), out); },
      extension};
}

}  // namespace

TypeFormats robot_spheres_formats() {
  return {"RobotSpheres",
          {robot_format<write_spheres_urdf>("urdf"),
           robot_format<write_spheres_srdf>("srdf"),
           robot_format<write_curobo>("curobo", "yml"),
           robot_format<write_xrdf>("xrdf"),
           robot_format<write_foam>("foam", "json"),
           robot_format<write_mjcf>("mjcf", "xml"),
           robot_format<write_spheres_csv>("csv"),
           {"glb", write_glb}}};
}

TypeFormats robot_formats() { return {"Robot", {{"glb", write_glb}}}; }

}  // namespace ballflow

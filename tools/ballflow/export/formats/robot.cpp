// Collision spheres for robots: yaml (cuRobo) and urdf. Both mean metres, and both need the name of a link,
// which balls do not have: it is "link".
#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {

void write_yaml(const PolyData& data, OutputFile& out) {
  out << "collision_spheres:\n  link:" << (data.points.empty() ? " []\n" : "\n");
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const geometry::Vec3 c = data.points[i];
    out << "    - center: [" << c.x << ", " << c.y << ", " << c.z << "]\n      radius: " << (*data.radii)[i]
        << '\n';
  }
}

void write_urdf(const PolyData& data, OutputFile& out) {
  out << "<?xml version=\"1.0\"?>\n<robot name=\"ballflow\">\n  <link name=\"link\">\n";
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    out << "    <collision><origin xyz=\"";
    text(out, data.points[i]);
    out << "\"/><geometry><sphere radius=\"" << (*data.radii)[i] << "\"/></geometry></collision>\n";
  }
  out << "  </link>\n</robot>\n";
}

}  // namespace ballflow

// DiscOutline: its arcs as they are.
#include "types/disc_outline.hpp"

#include "export/format_table.hpp"
#include "types/planar_types.hpp"

namespace ballflow {

TypeFormats disc_outline_formats() {
  return {"DiscOutline",
          {{"svg", [](const Artifact& artifact,
                      OutputFile& out) { write_svg(typed<geometry::DiscOutline>(artifact), out); }},
           {"csv", [](const Artifact& artifact, OutputFile& out) {
              write_csv(typed<geometry::DiscOutline>(artifact), out);
            }}}};
}

}  // namespace ballflow

// CoverState: what is left of its matrix (scp, lp), what was chosen (csv).
#include "cover/save_cover.hpp"
#include "export/format_table.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::CoverState;

void write_scp(const Artifact& artifact, OutputFile& out) {
  geometry::save_scp(typed<CoverState>(artifact), [&out](std::string_view text) { out << text; });
}

void write_lp(const Artifact& artifact, OutputFile& out) {
  geometry::save_lp(typed<CoverState>(artifact), [&out](std::string_view text) { out << text; });
}

void write_cover_csv(const Artifact& artifact, OutputFile& out) {
  const auto cover = typed<CoverState>(artifact);
  out << "ball,how\n";
  for (std::size_t i = 0; i < cover.chosen.size(); ++i) {
    out << cover.chosen[i] << ',' << int{cover.chosen_how[i]} << '\n';
  }
}

}  // namespace

TypeFormats cover_state_formats() {
  // json stays the default: what most users want of a cover is its summary.
  return {"CoverState",
          {generic_formats().front(), {"scp", write_scp}, {"lp", write_lp}, {"csv", write_cover_csv}}};
}

}  // namespace ballflow

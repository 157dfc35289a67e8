// ShapePrior: itself, so that it can be given to other graphs, the scores of its instances (csv), and the
// balls of its mean. ShapeFit: its summary, and the fitted balls.
#include "types/shape_prior.hpp"

#include <string>

#include "export/format_table.hpp"
#include "types/shape_types.hpp"

namespace ballflow {
namespace {

using geometry::ShapeFit;
using geometry::ShapePrior;

/// A line per instance: its distance from the mean, its scores in standard deviations.
void write_scores(const Artifact& artifact, OutputFile& out) {
  const auto prior = typed<ShapePrior>(artifact);
  out << "instance,distance";
  for (std::size_t mode = 0; mode < prior.mode_count(); ++mode) out << ",mode_" << mode;
  out << '\n';
  for (std::size_t i = 0; i < prior.instances(); ++i) {
    out << i << ',' << prior.distances[i];
    for (std::size_t mode = 0; mode < prior.mode_count(); ++mode)
      out << ',' << prior.scores[i * prior.mode_count() + mode];
    out << '\n';
  }
}

PolyData mean_of(const ShapePrior& prior) {
  PolyData data;
  data.points = prior.centers;
  data.radii = prior.radii;
  data.dot_every_point();
  return data;
}

PolyData balls_of_fit(const ShapeFit& fit) {
  PolyData data;
  data.points = fit.centers;
  data.radii = fit.radii;
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats shape_prior_formats() {
  return {"ShapePrior",
          {generic_formats().back(),
           {"csv", write_scores},
           format<ShapePrior, mean_of, write_ply>("ply"),
           format<ShapePrior, mean_of, write_vtp>("vtp"),
           format<ShapePrior, mean_of, write_npy>("npy")}};
}

TypeFormats shape_fit_formats() {
  return {"ShapeFit",
          {generic_formats().front(), format<ShapeFit, balls_of_fit, write_csv>("csv"),
           format<ShapeFit, balls_of_fit, write_ply>("ply"), format<ShapeFit, balls_of_fit, write_vtp>("vtp"),
           format<ShapeFit, balls_of_fit, write_npy>("npy")}};
}

}  // namespace ballflow

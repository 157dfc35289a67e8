// MatchedBalls: the balls of the instance in the order of the template, and whether each has a partner of its
// own.
#include "types/matched_balls.hpp"

#include "export/format_table.hpp"
#include "types/prior_types.hpp"

namespace ballflow {
namespace {

using geometry::MatchedBalls;

PolyData poly_data(const MatchedBalls& matched) {
  PolyData data;
  data.points = matched.centers;
  data.radii = matched.radii;
  std::vector<std::uint8_t> partners;
  for (std::size_t i = 0; i < matched.size(); ++i)
    partners.push_back(static_cast<std::uint8_t>(matched.partners[i] + matched.unique[i]));
  data.point_codes = {"partner", std::move(partners)};
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats matched_balls_formats() {
  return {
      "MatchedBalls",
      {format<MatchedBalls, poly_data, write_csv>("csv"), format<MatchedBalls, poly_data, write_ply>("ply"),
       format<MatchedBalls, poly_data, write_vtp>("vtp"), format<MatchedBalls, poly_data, write_npy>("npy")}};
}

}  // namespace ballflow

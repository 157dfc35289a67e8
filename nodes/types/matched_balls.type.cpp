#include "types/matched_balls.hpp"

#include <cstdint>

#include "types/box_summary.hpp"
#include "types/prior_types.hpp"

namespace ballflow {

void TypeOf<geometry::MatchedBalls>::declare(TypeDecl<geometry::MatchedBalls>& d) {
  using T = geometry::MatchedBalls;
  d.id("MatchedBalls", 1)
      .doc(
          "The balls and surface points of a template, found again on one instance, in its own coordinates "
          "and in the order of the template.");
  d.array("centers", &T::centers).length("k").doc("of the instance's balls, model units");
  d.array("radii", &T::radii).length("k").doc("of the same balls, model units, above 0");
  d.array("carried", &T::carried)
      .length("k")
      .doc("where the template's centers were carried to, model units");
  d.array("carried_radii", &T::carried_radii)
      .length("k")
      .optional()
      .doc("of the template's balls, in proportion to the carried points around them, model units, above 0");
  d.array("residuals", &T::residuals)
      .length("k")
      .doc("from the carried ball to the instance's own in (x, y, z, r), model units");
  d.array("partners", &T::partners)
      .length("k")
      .doc("1; 0: no ball of the instance is near enough, the carried one stands here");
  d.array("unique", &T::unique).length("k").doc("1; 0: another ball has the same partner, or there is none");
  d.array("points", &T::points).length("m").doc("on the surface, carried from those of the template");
  d.array("normals", &T::normals).length("m").doc("of the surface there, of length 1, outwards");
  d.array("point_residuals", &T::point_residuals)
      .length("m")
      .doc("of the points from the surface that the samples tell, model units");
  d.array("samples", &T::samples).length("n").doc("of the instance's surface, model units");
  d.array("sample_normals", &T::sample_normals).length("n").doc("of length 1, outwards");
  d.scalar("rotation", &T::rotation).doc("from the instance to the template: 3 x 3 by rows");
  d.scalar("scale", &T::scale).doc("above 0; 1 of a rigid transform");
  d.scalar("translation", &T::translation).doc("added last, model units of the template");
  d.scalar("similarity", &T::similarity).doc("1: the scale was free");
  d.scalar("mirrored", &T::mirrored).doc("1: the transform mirrors");
  d.scalar("diagonal", &T::diagonal).doc("of the bounding box of the instance's samples, model units");
  d.summary("balls", "of the template").summary("points", "surface points of the template");
  d.summary("without_partner", "balls that no ball of the instance is near to");
  d.summary("shared", "balls whose partner is also that of another one");
  d.summary("residual", "mean of the balls with a partner from it, model units; null: none has one");
  d.summary("surface_residual", "mean of the points from the surface, model units; null: no points");
  d.summary("diagonal", "of the bounding box of the instance, model units");
  d.summary("degrees", "of the rotation from the instance to the template; null where it mirrors");
  d.summary("scale", "from the instance to the template")
      .summary("bbox", "of the union of balls, model units");
  d.summarize([](const T& v) {
    std::int64_t with = 0, unique = 0;
    double residual = 0, surface = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      with += v.partners[i];
      unique += v.unique[i];
      if (v.partners[i] != 0) residual += v.residuals[i];
    }
    for (const double value : v.point_residuals) surface += value;
    const auto mean = [](double sum, std::size_t count) {
      return count == 0 ? SummaryValue(nullptr) : SummaryValue(sum / static_cast<double>(count));
    };
    const geometry::ShapePose pose = geometry::pose_of(v);
    return Summary{
        {"balls", static_cast<std::int64_t>(v.size())},
        {"points", static_cast<std::int64_t>(v.points.size())},
        {"without_partner", static_cast<std::int64_t>(v.size()) - with},
        {"shared", with - unique},
        {"residual", mean(residual, static_cast<std::size_t>(with))},
        {"surface_residual", mean(surface, v.points.size())},
        {"diagonal", v.diagonal},
        {"degrees", v.mirrored != 0 ? SummaryValue(nullptr)
                                    : SummaryValue(geometry::degrees_between(pose, geometry::ShapePose{}))},
        {"scale", v.scale},
        {"bbox", box_summary(geometry::bounding_box(geometry::balls_of(v)))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

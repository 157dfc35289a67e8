#include "types/enclosure_fit_type.hpp"

namespace ballflow {

void TypeOf<geometry::EnclosureFit>::declare(TypeDecl<geometry::EnclosureFit>& d) {
  using T = geometry::EnclosureFit;
  d.id("EnclosureFit", 1).doc("How well balls fit around a solid.");
  d.scalar("wanted", &T::wanted).doc("balls at most");
  d.scalar("balls", &T::balls).doc("balls that are used");
  d.scalar("solid", &T::solid)
      .doc("volume of the solid, counted on a lattice, cubed model units; 0 for sheets");
  d.scalar("outside", &T::outside).doc("volume of the union outside of it, likewise");
  d.scalar("area", &T::area).doc("of the triangles, squared model units");
  d.scalar("loss", &T::loss).doc("what the search made small, by its kind");
  d.scalar("kind", &T::kind)
      .doc("0 volume outside, 1 volume of the solid in no ball, 2 area of the surface in no ball");
  d.scalar("filled_voids", &T::filled_voids).doc("voids of the first result that were filled");
  d.summary(
      "loss_share",
      "what the search made small, as a part of the solid's volume or of the surface; null without one");
  d.summary("wanted", "balls at most").summary("balls", "balls that are used");
  d.summary("outside_share", "about what the balls waste, as a part of the solid's volume; null for sheets");
  d.summary("words", "the same in words").summary("solid", "volume of the solid, about; cubed model units");
  d.summary("outside", "volume of the union outside of it, about")
      .summary("filled_voids", "voids that were filled");
  d.summarize([](const T& v) {
    const double whole =
        v.kind == static_cast<std::uint8_t>(geometry::FitKind::uncovered_area) ? v.area : v.solid;
    return Summary{{"wanted", v.wanted},
                   {"balls", v.balls},
                   {"outside_share", v.solid > 0 ? SummaryValue(v.outside / v.solid) : SummaryValue(nullptr)},
                   {"loss_share", whole > 0 ? SummaryValue(v.loss / whole) : SummaryValue(nullptr)},
                   {"words", geometry::describe(v)},
                   {"solid", v.solid},
                   {"outside", v.outside},
                   {"filled_voids", v.filled_voids}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::BallCounts>::declare(TypeDecl<geometry::BallCounts>& d) {
  using T = geometry::BallCounts;
  d.id("BallCounts", 1).doc("How many balls each of several objects gets.");
  d.array("counts", &T::counts).length("n").doc("balls, at least one");
  d.array("outside", &T::outside)
      .length("n")
      .doc("volume outside that is expected with them, cubed model units");
  d.summary("objects", "objects")
      .summary("balls", "all balls")
      .summary("outside", "volume outside that is expected");
  d.summarize([](const T& v) {
    std::int64_t balls = 0;
    double outside = 0;
    for (const std::int32_t count : v.counts) balls += count;
    for (const double volume : v.outside) outside += volume;
    return Summary{
        {"objects", static_cast<std::int64_t>(v.counts.size())}, {"balls", balls}, {"outside", outside}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

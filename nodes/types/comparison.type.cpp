#include "types/comparison.hpp"

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::Comparison>::declare(TypeDecl<geometry::Comparison>& d) {
  using T = geometry::Comparison;
  d.id("Comparison", 3)
      .doc("How far the boundary of a union of balls is from a surface; lengths in model units.");
  d.scalar("compared_with", &T::compared_with).doc("the surface: 1 points, 2 an open mesh, 3 a closed mesh");
  d.scalar("surface_samples", &T::surface_samples).doc("number of samples of the surface");
  d.scalar("union_samples", &T::union_samples).doc("number of samples of the boundary of the union");
  d.scalar("spacing", &T::spacing).doc("no point of either is farther from a sample");
  d.scalar("surface_to_union", &T::surface_to_union)
      .doc("one-sided distance from the surface to the boundary: at least, value, at most; mean");
  d.scalar("union_to_surface", &T::union_to_surface).doc("the same from the boundary to the surface");
  d.scalar("coverage", &T::coverage).doc("part of the area of the surface that lies in the union");
  d.scalar("uncovered", &T::uncovered).doc("largest distance of a sample of the surface from the union");
  d.scalar("protrusion", &T::protrusion).doc("largest radius minus distance of the centre from the surface");
  d.scalar("union_volume", &T::union_volume).doc("volume of the union");
  d.scalar("surface_volume", &T::surface_volume).doc("volume that the surface encloses");
  d.scalar("surface_encloses", &T::surface_encloses).doc("1 when the surface is a closed mesh");
  d.summary("compared_with", "the surface: a closed mesh, an open mesh, or a cloud of points");
  d.summary("hausdorff", "the larger one of the two one-sided distances, from samples");
  d.summary("hausdorff_at_most", "upper bound of it");
  d.summary("surface_to_union", "one-sided distance from the surface to the boundary of the union");
  d.summary("union_to_surface", "one-sided distance back");
  d.summary("chamfer", "mean of the two mean distances");
  d.summary("coverage", "part of the surface that lies in the union, in [0, 1]");
  d.summary("uncovered", "largest distance of a sample of the surface from the union");
  d.summary("protrusion", "no ball with its centre inside reaches farther beyond the surface");
  d.summary("volume", "of the union");
  d.summary("volume_error", "(volume of the union - of the solid) / of the solid; null unless it is closed");
  d.summary("spacing", "no point of a surface is farther from a sample");
  d.summarize([](const T& v) {
    const bool solid = v.surface_encloses != 0 && v.surface_volume > 0;
    const SummaryValue error =
        solid ? SummaryValue((v.union_volume - v.surface_volume) / v.surface_volume) : SummaryValue(nullptr);
    return Summary{{"compared_with", in_words(static_cast<geometry::ComparedWith>(v.compared_with))},
                   {"hausdorff", v.hausdorff()},
                   {"hausdorff_at_most", v.hausdorff_at_most()},
                   {"surface_to_union", v.surface_to_union.value},
                   {"union_to_surface", v.union_to_surface.value},
                   {"chamfer", v.chamfer()},
                   {"coverage", v.coverage},
                   {"uncovered", v.uncovered},
                   {"protrusion", v.protrusion},
                   {"volume", v.union_volume},
                   {"volume_error", error},
                   {"spacing", v.spacing}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

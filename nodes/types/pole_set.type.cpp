#include "types/pole_set.hpp"

#include <algorithm>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::PoleSet>::declare(TypeDecl<geometry::PoleSet>& d) {
  using T = geometry::PoleSet;
  d.id("PoleSet", 1)
      .doc(
          "Voronoi vertices that are poles of samples, other bounded ones beside them, and the poles of "
          "samples.");
  d.array("centers", &T::centers).length("p").doc("Voronoi vertices, model units");
  d.array("radii", &T::radii).length("p").doc("distance to the defining samples, model units");
  d.array("labels", &T::labels).length("p").doc("0 unlabelled, 1 inner, 2 outer");
  d.array("defining_offsets", &T::defining_offsets).length("p+1").doc("where the samples of a pole begin");
  d.array("defining_samples", &T::defining_samples)
      .length("d")
      .doc("samples on the sphere of each pole, ascending");
  d.array("unbounded", &T::unbounded).length("p").doc("1 where a far-away bounding point is a site");
  d.array("sample_poles", &T::sample_poles)
      .length("n")
      .doc(
          "poles of each sample, -1 for none: the farthest vertex of its cell, the farthest behind it, and, "
          "where the labels of both are the same, the farthest with the other label");
  d.array("uncertain", &T::uncertain)
      .length("p")
      .optional()
      .doc("1 where the evidence for the label is weak; only of labels by angle");
  d.summary("samples", "number of samples").summary("poles", "number of distinct poles");
  d.summary("candidates", "other vertices; LabelPoles chooses third poles among them");
  d.summary("inner", "entries labelled inner").summary("outer", "entries labelled outer");
  d.summarize([](const T& v) {
    std::int64_t count[3] = {0, 0, 0};
    for (const std::uint8_t label : v.labels) ++count[label < 3 ? label : 0];
    const std::vector<std::uint8_t> pole = geometry::is_pole(v);
    const auto poles = std::count(pole.begin(), pole.end(), 1);
    return Summary{{"samples", v.sample_poles.size()},
                   {"poles", poles},
                   {"candidates", static_cast<std::int64_t>(v.size()) - poles},
                   {"inner", count[1]},
                   {"outer", count[2]}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

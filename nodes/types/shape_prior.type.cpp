#include "types/shape_prior.hpp"

#include <cmath>
#include <vector>

#include "types/box_summary.hpp"
#include "types/shape_types.hpp"

namespace ballflow {

void TypeOf<geometry::ShapePrior>::declare(TypeDecl<geometry::ShapePrior>& d) {
  using T = geometry::ShapePrior;
  d.id("ShapePrior", 1).doc("Mean and modes of variation of instances of one shape, as labelled balls.");
  d.array("centers", &T::centers).length("k").doc("of the mean, model units");
  d.array("radii", &T::radii).length("k").doc("geometric means, model units");
  d.array("points", &T::points).length("m").optional().doc("of the mean surface, model units");
  d.array("normals", &T::normals).length("m").optional().doc("of the mean surface, of length 1");
  d.array("vertices", &T::vertices)
      .length("v")
      .optional()
      .doc("of the template's surface where the mean has it, model units");
  d.array("triangles", &T::triangles).length("t").optional().doc("of the template's surface, v indices");
  d.scalar("point_share", &T::point_share).doc("weight of the points in the metric; the rest is the balls'");
  d.scalar("radius_unit", &T::radius_unit).doc("length that a change of log r by 1 counts as, model units");
  d.scalar("along", &T::along).doc("weight of displacements of points along the surface");
  d.array("modes", &T::modes)
      .length("qk")
      .optional()
      .doc("x, y, z, log r that one standard deviation adds to each ball, mode by mode");
  d.array("point_modes", &T::point_modes).length("qm").optional().doc("the same of each point: x, y, z");
  d.array("variances", &T::variances).length("q").optional().doc("descending, squared model units");
  d.scalar("total_variance", &T::total_variance).doc("of all modes, also those that are not kept");
  d.array("scores", &T::scores).length("nq").optional().doc("instance by instance, standard deviations");
  d.array("poses", &T::poses).length("n").doc("3 x 4 by rows: from an instance's coordinates to the model's");
  d.array("distances", &T::distances).length("n").doc("of the instances from the mean, model units");
  d.array("generalization", &T::generalization)
      .length("g")
      .optional()
      .doc("distance of an instance from the model of the others with 0, 1, ... modes, model units");
  d.array("generalization_deviation", &T::generalization_deviation)
      .length("g")
      .optional()
      .doc("standard deviation over the instances");
  d.array("specificity", &T::specificity)
      .length("q")
      .optional()
      .doc("distance of random shapes with 1, 2, ... modes from the nearest instance, model units");
  d.array("specificity_deviation", &T::specificity_deviation)
      .length("q")
      .optional()
      .doc("standard deviation over the random shapes");
  d.scalar("measure", &T::measure)
      .doc("of generalization: 0 to the instance's balls, 1 to planes at its points, 2 to its mesh");
  d.scalar("scaled", &T::scaled).doc("1: the instances were scaled to one size");
  d.summary("instances", "number of instances").summary("balls", "number of balls of each");
  d.summary("points", "number of surface points of each").summary("modes", "number of modes");
  d.summary("triangles", "of the mesh of the mean; 0: none");
  d.summary("bbox", "bounding box of the mean's centers, model units");
  d.summary("compactness", "part of the variance in the first modes: of 1, of 2, ...");
  d.summary("deviations", "root of the variance of each mode, model units");
  d.summary("generalization",
            "mean distance of an instance from the model of the others with 0, 1, ... modes, model units");
  d.summary("generalization_deviation", "its standard deviation");
  d.summary("specificity", "mean distance of random shapes with 1, 2, ... modes from the nearest instance");
  d.summary("specificity_deviation", "its standard deviation");
  d.summary("measured_to", "what the distances of generalization are measured to");
  d.summarize([](const T& v) {
    std::vector<double> compactness, deviations;
    double sum = 0;
    for (const double variance : v.variances) {
      sum += variance;
      compactness.push_back(v.total_variance > 0 ? sum / v.total_variance : 0);
      deviations.push_back(std::sqrt(variance));
    }
    return Summary{{"instances", v.instances()},
                   {"balls", v.balls()},
                   {"points", v.points.size()},
                   {"modes", v.mode_count()},
                   {"triangles", v.triangles.size()},
                   {"bbox", box_summary(geometry::bounding_box(v.centers.span()))},
                   {"compactness", compactness},
                   {"deviations", deviations},
                   {"generalization", v.generalization},
                   {"generalization_deviation", v.generalization_deviation},
                   {"specificity", v.specificity},
                   {"specificity_deviation", v.specificity_deviation},
                   {"measured_to", in_words(static_cast<geometry::SurfaceMeasure>(v.measure))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

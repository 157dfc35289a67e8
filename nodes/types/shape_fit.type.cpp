#include "types/shape_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "types/shape_types.hpp"

namespace ballflow {

void TypeOf<geometry::ShapeFit>::declare(TypeDecl<geometry::ShapeFit>& d) {
  using T = geometry::ShapeFit;
  d.id("ShapeFit", 1).doc("The most plausible shape of a model for an observation of a part of it.");
  d.array("scores", &T::scores).length("q").optional().doc("posterior mean, standard deviations");
  d.array("covariance", &T::covariance).length("qq").optional().doc("posterior, of the scores, row by row");
  d.scalar("pose", &T::pose).doc("3 x 4 by rows: from the model to the observation");
  d.array("centers", &T::centers).length("k").doc("of the fitted balls, model units");
  d.array("radii", &T::radii).length("k").doc("of the fitted balls, model units");
  d.array("deviations", &T::deviations).length("k").doc("how uncertain each ball's place is, model units");
  d.scalar("residual", &T::residual).doc("root mean square distance of what is explained, model units");
  d.scalar("expected", &T::expected).doc("the same of an instance that the model does not know");
  d.scalar("outliers", &T::outliers).doc("part of the observation that no part of the shape explains");
  d.scalar("mahalanobis", &T::mahalanobis).doc("root mean square score: about 1 for instances");
  d.scalar("noise", &T::noise).doc("width around the shape at the end, model units");
  d.scalar("observed", &T::observed).doc("points or balls of the observation");
  d.scalar("iterations", &T::iterations).doc("steps of the fit");
  d.scalar("converged", &T::converged).doc("1: it stood still at the end");
  d.summary("scores", "posterior mean, standard deviations of the prior");
  d.summary("score_deviations", "posterior standard deviations: 1 where the observation says nothing");
  d.summary("residual", "root mean square distance of what is explained from the shape, model units");
  d.summary("expected", "the same of an instance that the model does not know, model units; null: not known");
  d.summary("outliers", "part of the observation that no part of the shape explains");
  d.summary("mahalanobis", "root mean square score: about 1 for instances of the model, 0 for the mean");
  d.summary("largest_deviation", "of the place of a ball, model units");
  d.summary("observed", "points or balls of the observation");
  d.summary("iterations", "steps").summary("converged", "whether it stood still at the end");
  d.summarize([](const T& v) {
    std::vector<double> deviations;
    const std::size_t q = v.scores.size();
    for (std::size_t i = 0; i < q; ++i) deviations.push_back(std::sqrt(v.covariance[i * q + i]));
    double largest = 0;
    for (const double deviation : v.deviations) largest = std::max(largest, deviation);
    return Summary{{"scores", v.scores},
                   {"score_deviations", deviations},
                   {"residual", v.residual},
                   {"expected", v.expected > 0 ? SummaryValue(v.expected) : SummaryValue(nullptr)},
                   {"outliers", v.outliers},
                   {"mahalanobis", v.mahalanobis},
                   {"largest_deviation", largest},
                   {"observed", v.observed},
                   {"iterations", static_cast<std::int64_t>(v.iterations)},
                   {"converged", v.converged != 0}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

#include "types/artifact_types.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ballflow {
namespace {

Json box_json(const geometry::Box& box) {
  if (box.empty()) return nullptr;
  return {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
}
}  // namespace

void TypeOf<geometry::PointSet>::declare(TypeDecl<geometry::PointSet>& d) {
  using T = geometry::PointSet;
  d.id("PointSet", 1).doc("A sample of a surface: n pairwise distinct points.");
  d.array("points", &T::points).length("n").doc("coordinates, model units");
  d.array("normals", &T::normals).length("n").optional().doc("unit normals, where the source had them");
  d.summary("count", "number of points").summary("bbox", "[[min x, y, z], [max x, y, z]], model units");
  d.summarize([](const T& v) {
    return Json{{"count", v.points.size()}, {"bbox", box_json(geometry::bounding_box(v.points.span()))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::TriangleMesh>::declare(TypeDecl<geometry::TriangleMesh>& d) {
  using T = geometry::TriangleMesh;
  d.id("TriangleMesh", 1)
      .doc("An indexed set of triangles; it may be open or non-manifold, the summary says so.");
  d.array("vertices", &T::vertices).length("v").doc("coordinates, model units");
  d.array("triangles", &T::triangles).length("f").doc("vertex indices");
  d.summary("vertices", "number of vertices").summary("faces", "number of triangles");
  d.summary("closed", "every edge belongs to exactly two triangles");
  d.summary("manifold", "edges have at most two triangles, vertex stars are one disk or half disk");
  d.summary("oriented", "no two triangles run through a shared edge in the same direction");
  d.summary("genus",
            "total over the components, boundary loops filled; null when not manifold or not oriented");
  d.summary("components", "connected components")
      .summary("boundary_loops", "closed chains of boundary edges");
  d.summarize([](const T& v) {
    const geometry::MeshTopology t = geometry::mesh_topology(v);
    return Json{{"vertices", t.vertices},     {"faces", t.faces},
                {"closed", t.closed},         {"manifold", t.manifold},
                {"oriented", t.oriented},     {"genus", t.genus < 0 ? Json(nullptr) : Json(t.genus)},
                {"components", t.components}, {"boundary_loops", t.boundary_loops}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::PoleSet>::declare(TypeDecl<geometry::PoleSet>& d) {
  using T = geometry::PoleSet;
  d.id("PoleSet", 1)
      .doc(
          "Voronoi vertices that are poles of samples, or candidates for third poles, and the poles of "
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
  d.summary("samples", "number of samples").summary("poles", "number of distinct poles");
  d.summary("candidates", "vertices that are no pole; LabelPoles chooses third poles among them");
  d.summary("inner", "poles labelled inner").summary("outer", "poles labelled outer");
  d.summarize([](const T& v) {
    std::int64_t count[3] = {0, 0, 0};
    for (const std::uint8_t label : v.labels) ++count[label < 3 ? label : 0];
    const std::vector<std::uint8_t> pole = geometry::is_pole(v);
    const auto poles = std::count(pole.begin(), pole.end(), 1);
    return Json{{"samples", v.sample_poles.size()},
                {"poles", poles},
                {"candidates", static_cast<std::int64_t>(v.size()) - poles},
                {"inner", count[1]},
                {"outer", count[2]}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::Balls>::declare(TypeDecl<geometry::Balls>& d) {
  using T = geometry::Balls;
  d.id("Balls", 1).doc("A set of closed balls.");
  d.array("centers", &T::centers).length("n").doc("model units");
  d.array("radii", &T::radii).length("n").doc("model units, >= 0");
  d.array("defining_offsets", &T::defining_offsets)
      .length("n+1")
      .optional()
      .doc("where the samples of a ball begin");
  d.array("defining_samples", &T::defining_samples)
      .length("d")
      .optional()
      .doc("samples each ball passes through");
  d.summary("count", "number of balls").summary("bbox", "bounding box of the union, model units");
  d.summary("min_radius", "model units").summary("max_radius", "model units");
  d.summarize([](const T& v) {
    Json smallest = nullptr, largest = nullptr;
    if (v.size() != 0) {
      const auto [low, high] = std::minmax_element(v.radii.begin(), v.radii.end());
      smallest = *low;
      largest = *high;
    }
    return Json{{"count", v.size()},
                {"bbox", box_json(geometry::bounding_box(v))},
                {"min_radius", smallest},
                {"max_radius", largest}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::Growth>::declare(TypeDecl<geometry::Growth>& d) {
  using T = geometry::Growth;
  using geometry::GrowthStop;
  d.id("Growth", 1).doc("How far balls have grown, and what stopped each of them.");
  d.array("centers", &T::centers).length("n").doc("centres of the balls, model units");
  d.array("radii", &T::radii).length("n").doc("radii before, model units");
  d.array("grown_radii", &T::grown_radii).length("n").doc("radii after, model units");
  d.array("limits", &T::limits).length("n").doc("largest radius allowed whatever is asked for, or infinity");
  d.array("stops", &T::stops)
      .length("n")
      .doc("0 grown as far as asked for, 1 pole bound, 2 critical Gabriel point, 3 neighbour");
  d.scalar("betti_before", &T::betti_before).doc("components, tunnels, cavities of the union; -1 if unknown");
  d.scalar("betti_after", &T::betti_after).doc("those of the grown union");
  d.summary("balls", "number of balls").summary("stopped", "balls smaller than asked for");
  d.summary("stopped_by_poles", "they might reach the outer medial axis (Lemma 3.4)");
  d.summary("stopped_by_gabriel", "they would reach a critical Gabriel point");
  d.summary("stopped_by_neighbour", "a ball near them has stopped, and the topology would change");
  d.summary("mean_growth", "of the radii, model units; null without balls");
  d.summary("max_growth", "of the radii, model units; null without balls");
  d.summary("betti_before", "[components, tunnels, cavities] of the union, null where nobody has looked");
  d.summary("betti_after", "those of the grown union");
  d.summarize([](const T& v) {
    const auto stopped = [&v](GrowthStop by) {
      return std::count(v.stops.begin(), v.stops.end(), static_cast<std::uint8_t>(by));
    };
    Json mean = nullptr, most = nullptr;
    if (!v.radii.empty()) {
      double sum = 0, largest = 0;
      for (std::size_t i = 0; i < v.radii.size(); ++i) {
        const double growth = v.grown_radii[i] - v.radii[i];
        sum += growth;
        largest = std::max(largest, growth);
      }
      mean = sum / static_cast<double>(v.radii.size());
      most = largest;
    }
    const auto betti = [](const std::array<std::int64_t, 3>& b) {
      return b[0] < 0 ? Json(nullptr) : Json(b);
    };
    return Json{{"balls", v.radii.size()},
                {"stopped", static_cast<std::int64_t>(v.stops.size()) - stopped(GrowthStop::wish)},
                {"stopped_by_poles", stopped(GrowthStop::poles)},
                {"stopped_by_gabriel", stopped(GrowthStop::gabriel)},
                {"stopped_by_neighbour", stopped(GrowthStop::neighbour)},
                {"mean_growth", mean},
                {"max_growth", most},
                {"betti_before", betti(v.betti_before)},
                {"betti_after", betti(v.betti_after)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::LocalFeatureSize>::declare(TypeDecl<geometry::LocalFeatureSize>& d) {
  using T = geometry::LocalFeatureSize;
  d.id("LocalFeatureSize", 1)
      .doc("D^, the distance of every sample to the nearest pole: an estimate of the local feature size.");
  d.array("points", &T::points).length("n").doc("the sample, model units");
  d.array("pole_distances", &T::pole_distances)
      .length("n")
      .doc(
          "D^, model units. For r-samples, r <= 0.08: distance to the discrete medial axis in "
          "[0.817 D^, D^], local feature size at most 1.2802 D^");
  d.summary("count", "number of samples");
  d.summary("min_pole_distance", "smallest D^; null without samples");
  d.summary("max_pole_distance", "largest D^");
  d.summary("discrete_at_least", "times D^: lower bound of the distance to the discrete medial axis");
  d.summary("at_most", "times D^: upper bound of the local feature size");
  d.summarize([](const T& v) {
    Json smallest = nullptr, largest = nullptr;
    if (!v.pole_distances.empty()) {
      const auto [low, high] = std::minmax_element(v.pole_distances.begin(), v.pole_distances.end());
      smallest = *low;
      largest = *high;
    }
    return Json{{"count", v.points.size()},
                {"min_pole_distance", smallest},
                {"max_pole_distance", largest},
                {"discrete_at_least", T::discrete_at_least},
                {"at_most", T::at_most}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::CoverState>::declare(TypeDecl<geometry::CoverState>& d) {
  using T = geometry::CoverState;
  d.id("CoverState", 2)
      .doc("A set covering instance on its way to a solution: residual matrix, choices, bounds.");
  d.scalar("balls", &T::balls).doc("number of balls of the original instance");
  d.scalar("samples", &T::samples).doc("number of samples of the original instance");
  d.array("row_offsets", &T::row_offsets).length("r+1").doc("where the columns of a row begin");
  d.array("columns", &T::columns).length("nnz").doc("column indices of the residual matrix, rows ascending");
  d.array("row_ids", &T::row_ids).length("r").doc("ball of each row");
  d.array("column_ids", &T::column_ids).length("c").doc("sample of each column");
  d.array("chosen", &T::chosen).length("k").doc("chosen balls in order of choice");
  d.array("chosen_how", &T::chosen_how)
      .length("k")
      .doc("0 essential, 1 exact, 2 greedy, 3 trusted, 4 all, 5 searched, 6 returned to keep the topology");
  d.array("uncovered", &T::uncovered).length("u").doc("samples that no ball covers");
  d.scalar("lower_bound", &T::lower_bound).doc("proven lower bound on any cover, -1 while nothing is known");
  d.scalar("lower_bound_how", &T::lower_bound_how)
      .doc("0 unknown, 1 solver, 2 Lemma 3.7, 3 share bound, 4 certified");
  d.array("certificate_samples", &T::certificate_samples).length("l").doc("samples with a price, by group");
  d.array("certificate_prices", &T::certificate_prices)
      .length("l")
      .doc("price of the sample, in 2^-20 balls");
  d.array("certificate_groups", &T::certificate_groups)
      .length("l")
      .doc("group of the sample, ascending from 0");
  d.scalar("settled_groups", &T::settled_groups)
      .doc("the first groups of the certificate, about what has left the matrix");
  d.summary("rows", "balls left in the matrix").summary("cols", "samples left in the matrix");
  d.summary("nnz", "entries of the matrix").summary("chosen", "balls chosen so far");
  d.summary("remaining", "samples that no chosen ball covers yet");
  d.summary("lower_bound", "no cover has fewer balls; null while nothing is known");
  d.summary("lower_bound_how", "its ground: certified, share, lemma_3_7, solver, or unknown");
  d.summary("certified_bound", "what the certificate of the state proves, 0 without one");
  d.summary("upper_bound", "chosen balls once nothing remains, else null");
  d.summary("gap", "(upper - lower) / lower, a fraction; null while a bound is unknown");
  d.summary("essential", "chosen as the only ball of a sample")
      .summary("exact", "chosen by exact optimisation");
  d.summary("greedy", "chosen greedily: each may cost one ball more than the optimum");
  d.summary("trusted", "from a solver that stopped before it proved optimality");
  d.summary("searched", "kept by local search");
  d.summary("returned", "returned by TopologyRepair, in its output only");
  d.summary("uncovered", "samples that no ball covers");
  d.summarize([](const T& v) {
    constexpr std::array<const char*, 5> grounds{"unknown", "solver", "lemma_3_7", "share", "certified"};
    const auto upper = v.upper_bound();
    const auto gap = v.gap();
    return Json{{"rows", v.rows()},
                {"cols", v.cols()},
                {"nnz", v.nnz()},
                {"chosen", v.chosen.size()},
                {"remaining", v.remaining()},
                {"lower_bound", v.lower_bound < 0 ? Json(nullptr) : Json(v.lower_bound)},
                {"lower_bound_how", grounds[v.lower_bound_how]},
                {"certified_bound", v.certified_bound()},
                {"upper_bound", upper ? Json(*upper) : Json(nullptr)},
                {"gap", gap ? Json(*gap) : Json(nullptr)},
                {"essential", v.count(geometry::Choice::essential)},
                {"exact", v.count(geometry::Choice::exact)},
                {"greedy", v.count(geometry::Choice::greedy)},
                {"trusted", v.count(geometry::Choice::trusted)},
                {"searched", v.count(geometry::Choice::searched)},
                {"uncovered", v.uncovered.size()}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::Bisection>::declare(TypeDecl<geometry::Bisection>& d) {
  using T = geometry::Bisection;
  d.id("Bisection", 1).doc("A search for the smallest growth with which few enough balls cover a sample.");
  d.scalar("value", &T::value).doc("to be tried next; once done, the answer");
  d.scalar("too_small", &T::too_small).doc("largest value known to need too many balls; -1 for none");
  d.scalar("large_enough", &T::large_enough).doc("smallest value known to need few enough; -1 for none");
  d.scalar("balls", &T::balls).doc("what large_enough needs; -1 while unknown");
  d.scalar("balls_before", &T::balls_before).doc("what too_small needs; -1 while unknown");
  d.scalar("tried", &T::tried).doc("values that were tried");
  d.scalar("done", &T::done).doc("1 at the end");
  d.summary("value", "to be tried next; once done, the answer").summary("done", "1 at the end");
  d.summary("balls", "what the smallest sufficient value needs; null while there is none");
  d.summary("balls_before", "what the largest insufficient value needs; null while there is none");
  d.summary("tried", "values that were tried");
  d.summarize([](const T& v) {
    const auto known = [](std::int64_t n) { return n < 0 ? Json(nullptr) : Json(n); };
    return Json{{"value", v.value},
                {"done", v.done},
                {"balls", known(v.balls)},
                {"balls_before", known(v.balls_before)},
                {"tried", v.tried}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::CoverCheck>::declare(TypeDecl<geometry::CoverCheck>& d) {
  using T = geometry::CoverCheck;
  d.id("CoverCheck", 2).doc("The outcome of checking from geometry that balls cover samples.");
  d.scalar("balls", &T::balls).doc("number of balls");
  d.scalar("samples", &T::samples).doc("number of samples");
  d.array("uncovered", &T::uncovered).length("u").doc("samples in no ball, ascending");
  d.scalar("certified_bound", &T::certified_bound)
      .doc("no cover has fewer balls: a checked certificate proves it; -1 without one");
  d.summary("certified_bound", "the same, null without a certificate");
  d.summary("balls", "number of balls").summary("samples", "number of samples");
  d.summary("covered", "samples in at least one ball").summary("uncovered", "samples in none");
  d.summarize([](const T& v) {
    const auto missing = static_cast<std::int64_t>(v.uncovered.size());
    return Json{{"balls", v.balls},
                {"samples", v.samples},
                {"covered", v.samples - missing},
                {"uncovered", missing},
                {"certified_bound", v.certified_bound < 0 ? Json(nullptr) : Json(v.certified_bound)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

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
    const Json error = solid ? Json((v.union_volume - v.surface_volume) / v.surface_volume) : Json(nullptr);
    return Json{{"compared_with", in_words(static_cast<geometry::ComparedWith>(v.compared_with))},
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

void TypeOf<geometry::MassProperties>::declare(TypeDecl<geometry::MassProperties>& d) {
  using T = geometry::MassProperties;
  d.id("MassProperties", 1)
      .doc("What a solid of density 1 weighs and how it turns, in powers of model units.");
  d.scalar("volume", &T::volume).doc("volume");
  d.scalar("area", &T::area).doc("area of the boundary");
  d.scalar("center_of_mass", &T::center_of_mass).doc("centre of mass");
  d.scalar("inertia", &T::inertia).doc("inertia tensor about the centre of mass: xx, yy, zz, xy, xz, yz");
  d.scalar("closure_error", &T::closure_error)
      .doc("length of the integral of the outward normal, divided by the area: 0 but for rounding");
  d.summary("volume", "cubed model units").summary("area", "of the boundary, squared model units");
  d.summary("center_of_mass", "[x, y, z], model units");
  d.summary("inertia", "[xx, yy, zz, xy, xz, yz] about the centre of mass at density 1");
  d.summary("closure_error", "0 but for rounding");
  d.summarize([](const T& v) {
    const geometry::Vec3 c = v.center_of_mass;
    return Json{{"volume", v.volume},
                {"area", v.area},
                {"center_of_mass", {c.x, c.y, c.z}},
                {"inertia", v.inertia},
                {"closure_error", v.closure_error}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::MinkowskiReport>::declare(TypeDecl<geometry::MinkowskiReport>& d) {
  using T = geometry::MinkowskiReport;
  d.id("MinkowskiReport", 2).doc("What the Minkowski sum of two sets of balls came to.");
  d.scalar("pairs", &T::pairs).doc("pairs of balls");
  d.scalar("survivors", &T::survivors)
      .doc("sums of pairs that were triangulated; of algorithm memory: that were vertices at the end");
  d.scalar("count", &T::count).doc("sums that contribute");
  d.scalar("touching_boundary", &T::touching_boundary).doc("of these, on the boundary of the union");
  d.scalar("lower", &T::lower).doc("corner of the bounding box of the union, model units");
  d.scalar("upper", &T::upper).doc("the opposite corner");
  d.scalar("error_bound", &T::error_bound)
      .doc("no point of the surface of the sum of the solids is farther from the union; -1: unknown");
  d.scalar("a_compared_with", &T::a_compared_with)
      .doc("the solid a: 0 its balls, 1 points, 2 an open mesh, 3 a closed mesh");
  d.scalar("b_compared_with", &T::b_compared_with).doc("the same of b");
  d.summary("pairs", "pairs of balls").summary("survivors", "sums of pairs that were triangulated");
  d.summary("count", "sums that contribute: the balls of the result");
  d.summary("touching_boundary", "of these, have a piece of their sphere on the boundary of the union");
  d.summary("bbox", "bounding box of the union, model units; null when it is empty");
  d.summary(
      "error_bound",
      "no point of the surface of the sum of the solids is farther from the union, model units; null when "
      "it is unknown");
  d.summary("error_bound_unknown", "why there is no error bound: no comparison, or one with no closed mesh");
  d.summarize([](const T& v) {
    geometry::Box box;
    if (v.count > 0) box = {v.lower, v.upper};
    const std::string why = geometry::why_unbounded(static_cast<geometry::ComparedWith>(v.a_compared_with),
                                                    static_cast<geometry::ComparedWith>(v.b_compared_with));
    return Json{{"pairs", v.pairs},
                {"survivors", v.survivors},
                {"count", v.count},
                {"touching_boundary", v.touching_boundary},
                {"bbox", box_json(box)},
                {"error_bound", v.error_bound < 0 ? Json(nullptr) : Json(v.error_bound)},
                {"error_bound_unknown", why.empty() ? Json(nullptr) : Json(why)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::SimplicialComplex>::declare(TypeDecl<geometry::SimplicialComplex>& d) {
  using T = geometry::SimplicialComplex;
  d.id("SimplicialComplex", 1)
      .doc("The weighted zero alpha-shape of balls: the dual complex of their union.");
  d.array("centers", &T::centers).length("n").doc("centres of the balls, model units");
  d.array("weights", &T::weights).length("n").doc("squared radii, delta included");
  d.array("vertices", &T::vertices).length("v").doc("balls that are vertices of the complex");
  d.array("edges", &T::edges).length("e").doc("pairs of balls, ascending");
  d.array("triangles", &T::triangles).length("t").doc("triples of balls, ascending");
  d.array("tetrahedra", &T::tetrahedra).length("c").doc("quadruples of balls, ascending");
  d.array("vertex_classes", &T::vertex_classes).length("v").doc("0 interior, 1 regular, 2 singular");
  d.array("edge_classes", &T::edge_classes).length("e").doc("0 interior, 1 regular, 2 singular");
  d.array("triangle_classes", &T::triangle_classes).length("t").doc("0 interior, 1 regular, 2 singular");
  d.scalar("delta", &T::delta).doc("added to every squared radius before anything was decided");
  d.scalar("betti", &T::betti).doc("components, tunnels, cavities of the union");
  d.summary("vertices", "number").summary("edges", "number").summary("triangles", "number");
  d.summary("tetrahedra", "number").summary("singular_vertices", "isolated balls");
  d.summary("singular_edges", "edges in no triangle")
      .summary("singular_triangles", "triangles in no tetrahedron");
  d.summary("interior_vertices", "number")
      .summary("interior_edges", "number")
      .summary("interior_triangles", "number");
  d.summary("regular_vertices", "number")
      .summary("regular_edges", "number")
      .summary("regular_triangles", "number");
  d.summary("delta", "squared model units");
  d.summary("euler_characteristic", "vertices - edges + triangles - tetrahedra");
  d.summary("betti", "[components, tunnels, cavities] of the union");
  d.summarize([](const T& v) {
    Json s{{"vertices", v.vertices.size()},
           {"edges", v.edges.size()},
           {"triangles", v.triangles.size()},
           {"tetrahedra", v.tetrahedra.size()}};
    const auto classes = [&s](const char* what, const geometry::Array<std::uint8_t>& values) {
      std::int64_t count[3] = {0, 0, 0};
      for (const std::uint8_t c : values) ++count[c < 3 ? c : 1];
      s[std::string("singular_") + what] = count[2];
      s[std::string("regular_") + what] = count[1];
      s[std::string("interior_") + what] = count[0];
    };
    classes("vertices", v.vertex_classes);
    classes("edges", v.edge_classes);
    classes("triangles", v.triangle_classes);
    s["delta"] = v.delta;
    s["euler_characteristic"] = v.euler_characteristic();
    s["betti"] = v.betti;
    return s;
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::MedialAxis>::declare(TypeDecl<geometry::MedialAxis>& d) {
  using T = geometry::MedialAxis;
  d.id("MedialAxis", 2)
      .doc("The medial axis of a union of balls as a polygon complex with a radius at every vertex.");
  d.array("vertices", &T::vertices).length("v").doc("model units");
  d.array("radii", &T::radii).length("v").doc("radius of the maximal inscribed ball, model units");
  d.array("edges", &T::edges).length("e").doc("vertex pairs of edges that bound no polygon");
  d.array("polygon_offsets", &T::polygon_offsets).length("f+1").doc("where the corners of a polygon begin");
  d.array("polygon_vertices", &T::polygon_vertices).length("k").doc("corners in order around the polygon");
  d.array("polygon_kinds", &T::polygon_kinds).length("f").doc("0 singular triangle, 1 Voronoi facet, 2 wall");
  d.array("polygon_sheets", &T::polygon_sheets)
      .length("f")
      .doc("sheet of each polygon: polygons joined across edges of exactly two polygons");
  d.array("sheet_orientable", &T::sheet_orientable)
      .length("s")
      .doc("1 when the polygons of the sheet face one way, 0 when that is impossible");
  d.array("seams", &T::seams).length("m").doc("vertex pairs of edges of three and more polygons, ascending");
  d.array("seam_degrees", &T::seam_degrees).length("m").doc("polygons at each seam");
  d.array("seam_curves", &T::seam_curves)
      .length("m")
      .doc("curve of each seam: seams joined at vertices where exactly two end");
  d.summary("vertices", "number")
      .summary("edges", "edges that bound no polygon")
      .summary("polygons", "number");
  d.summary("euler_characteristic", "vertices - edges + polygons, every edge counted once");
  d.summary("components", "connected components");
  d.summary("sheets", "components of the polygons after cutting at seams");
  d.summary("sheets_not_orientable", "sheets with one side only");
  d.summary("seams", "edges of three and more polygons");
  d.summary("seam_curves", "curves that the seams form");
  d.summary("expected_euler_characteristic", "that of the alpha-shape the axis was made from");
  d.summarize([](const T& v) {
    const geometry::AxisTopology t = geometry::axis_topology(v);
    return Json{
        {"vertices", v.vertices.size()},
        {"edges", v.edges.size()},
        {"polygons", v.polygons()},
        {"euler_characteristic", t.euler_characteristic},
        {"components", t.components},
        {"sheets", v.sheet_orientable.size()},
        {"sheets_not_orientable",
         std::count(v.sheet_orientable.begin(), v.sheet_orientable.end(), std::uint8_t{0})},
        {"seams", v.seams.size()},
        {"seam_curves",
         v.seam_curves.empty() ? 0 : *std::max_element(v.seam_curves.begin(), v.seam_curves.end()) + 1}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::TopologyTable>::declare(TypeDecl<geometry::TopologyTable>& d) {
  using T = geometry::TopologyTable;
  using geometry::TopologyStage;
  d.id("TopologyTable", 1)
      .doc("Euler characteristic and Betti numbers of a shape at the stages of a pipeline.");
  d.array("stages", &T::stages)
      .length("n")
      .doc(
          "0 solid inside the surface, 1 inner balls, 2 enlarged balls, 3 kept balls, 4 alpha-shape, 5 "
          "medial axis");
  d.array("betti", &T::betti).length("n").doc("components, tunnels, cavities; -1 where they are unknown");
  d.array("euler", &T::euler).length("n").doc("Euler characteristics, 0 where they are unknown");
  d.summary("words", "what differs from stage to stage, or that nothing does");
  d.summary("changes", "number of Betti numbers that differ from stage to stage");
  constexpr std::array<std::pair<TopologyStage, const char*>, geometry::topology_stages> whose{
      {{TopologyStage::surface, "of the solid inside the surface"},
       {TopologyStage::inner, "of the union of the inner balls"},
       {TopologyStage::enlarged, "of the union of the enlarged balls"},
       {TopologyStage::kept, "of the union of the balls that are kept"},
       {TopologyStage::complex, "of the alpha-shape"},
       {TopologyStage::axis, "of the medial axis"}}};
  for (const auto& [stage, of] : whose) {
    d.summary(geometry::name(stage),
              std::string("[components, tunnels, cavities] ") + of + "; null when not known");
    d.summary(std::string(geometry::name(stage)) + "_euler", std::string("Euler characteristic ") + of);
  }
  d.summarize([](const T& v) {
    Json s = Json::object();
    for (std::size_t i = 0; i < geometry::topology_stages; ++i) {
      const auto stage = static_cast<TopologyStage>(i);
      const auto row = v.row(stage);
      const bool known = row && v.known(*row);
      s[geometry::name(stage)] = known ? Json(v.betti[*row]) : Json(nullptr);
      s[std::string(geometry::name(stage)) + "_euler"] = known ? Json(v.euler[*row]) : Json(nullptr);
    }
    const auto changes = geometry::topology_changes(v);
    std::string words;
    for (const std::string& change : changes) words += (words.empty() ? "" : "; ") + change;
    for (std::size_t row = 0; row < v.size() && words.empty(); ++row) {
      if (v.known(row)) words = geometry::describe(v.betti[row]) + " at every stage that is known";
    }
    s["words"] = words.empty() ? "unknown" : words;
    s["changes"] = changes.size();
    return s;
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::TopologyCheck>::declare(TypeDecl<geometry::TopologyCheck>& d) {
  using T = geometry::TopologyCheck;
  using geometry::Betti;
  d.id("TopologyCheck", 1)
      .doc("What the inclusion of a union of few balls in that of all of them does to homology over Z/2.");
  d.scalar("kept", &T::kept).doc("number of balls before the repair");
  d.scalar("returned", &T::returned).doc("number of balls that the repair returned");
  d.scalar("whole", &T::whole).doc("components, tunnels, cavities of the union of all balls");
  d.scalar("before", &T::before).doc("those of the balls before the repair");
  d.scalar("before_rank", &T::before_rank).doc("how many of them are independent ones of the whole");
  d.scalar("after", &T::after).doc("those of the balls after the repair");
  d.scalar("after_rank", &T::after_rank).doc("how many of them are independent ones of the whole");
  d.scalar("inclusions", &T::inclusions).doc("how many sets of balls were compared with the whole");
  d.scalar("everything", &T::everything).doc("1 where nothing less than all balls had the right topology");
  d.summary("isomorphism", "the inclusion induces isomorphisms of homology over Z/2 after the repair");
  d.summary("isomorphism_before", "the same before the repair");
  d.summary("words", "what was wrong, and how many balls were returned");
  d.summary("kept", "number of balls before the repair").summary("returned", "balls that were returned");
  d.summary("inclusions", "how many sets of balls were compared with the whole");
  d.summary("everything", "true where nothing less than all balls had the right topology");
  d.summary("whole", "[components, tunnels, cavities] of the union of all balls");
  d.summary("before", "those before the repair").summary("after", "those after the repair");
  d.summary("before_rank", "how many of them are independent ones of the whole");
  d.summary("after_rank", "how many of them are independent ones of the whole");
  d.summarize([](const T& v) {
    return Json{{"isomorphism", v.inclusion_after().isomorphism()},
                {"isomorphism_before", v.inclusion_before().isomorphism()},
                {"words", geometry::describe(v)},
                {"kept", v.kept},
                {"returned", v.returned},
                {"inclusions", v.inclusions},
                {"everything", v.everything != 0},
                {"whole", v.whole},
                {"before", v.before},
                {"before_rank", v.before_rank},
                {"after", v.after},
                {"after_rank", v.after_rank}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow

#include "prior/choose_template.hpp"

#include <ballflow/sdk.hpp>
#include <string>
#include <vector>

#include "prior/eigen_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::ChooseTemplateOptions;

struct ChooseTemplate {
  InList<geometry::PointSet> samples, points;
  InList<geometry::Balls> inner;
  InList<geometry::TriangleMesh> meshes;
  Out<geometry::TriangleMesh> template_mesh;
  Out<geometry::PointSet> template_samples, template_points;
  Out<geometry::Balls> template_inner;
  ChooseTemplateOptions options;

  static void declare(NodeDecl<ChooseTemplate>& d) {
    d.id("ChooseTemplate", 1).summary("Which of several shapes stands for all of them.");
    d.doc(
        "The medoid: the shape on which all others lie best, by the sum of residuals of rough alignments in "
        "pairs; "
        "what belongs to it is handed on. Of more than two dozen shapes those are looked at whose distances "
        "of pairs "
        "of points are spread most usually. As long as the same shape is taken, whatever is made of it stays "
        "in the "
        "cache when shapes are added. Warns of shapes that are there twice. Refuses lists that are not "
        "equally long, and shapes without extent.");
    d.avoid_when("one shape is known to be the best: the parameter instance.");
    d.cites("osada2002", "D2: distances of pairs of points")
        .cites("gonzalez1985", "points that are evenly chosen");
    d.library("Eigen", geometry::eigen_version());
    d.memory(8 << 20, 4);
    d.input("samples", &ChooseTemplate::samples).doc("of the surface of each shape, evenly spread");
    d.input("inner", &ChooseTemplate::inner).doc("inner balls of each shape, in the same order");
    d.input("points", &ChooseTemplate::points).doc("the samples that the inner balls are about, likewise");
    d.input("meshes", &ChooseTemplate::meshes).optional().doc("surface of each shape, likewise");
    d.output("samples", &ChooseTemplate::template_samples).doc("those of the template");
    d.output("inner", &ChooseTemplate::template_inner).doc("those of the template");
    d.output("points", &ChooseTemplate::template_points).doc("those of the template");
    d.output("mesh", &ChooseTemplate::template_mesh).doc("that of the template; empty without meshes");
    d.param("instance", &ChooseTemplate::options, &ChooseTemplateOptions::instance)
        .unit("number")
        .at_least(-1)
        .at_most(1000000)
        .doc("which one, from 0 on; -1: the medoid");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (inner.size() != samples.size() || points.size() != samples.size())
      throw geometry::InputError("there are samples of " + std::to_string(samples.size()) +
                                     " shapes, inner balls of " + std::to_string(inner.size()) +
                                     " and points of " + std::to_string(points.size()),
                                 "connect the three of every shape, in one order");
    if (meshes.size() != 0 && meshes.size() != samples.size())
      throw geometry::InputError("there are samples of " + std::to_string(samples.size()) + " shapes and " +
                                     std::to_string(meshes.size()) + " meshes",
                                 "connect the mesh of every shape in the same order, or none");
    const std::vector<geometry::PointSet> shapes(samples.begin(), samples.end());
    const std::size_t chosen = geometry::choose_template(shapes, options, monitor);
    template_samples = samples[chosen];
    template_inner = inner[chosen];
    template_points = points[chosen];
    template_mesh = meshes.size() == 0 ? geometry::TriangleMesh{} : meshes[chosen];
    template_samples.summary("instance", static_cast<std::int64_t>(chosen));
  }
};

}  // namespace

const bf_node* choose_template_entry() { return node_entry<ChooseTemplate>(); }

}  // namespace ballflow::nodes

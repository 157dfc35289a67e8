// A node library of somebody else: one node, built against an installed ballflow.
#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

using namespace ballflow;
using geometry::Balls;
using geometry::Vec3;

struct Shift {
  In<Balls> balls;
  Out<Balls> shifted;
  Vec3 by;

  static void declare(NodeDecl<Shift>& d) {
    d.id("AcmeShift", 1).summary("Moves balls by a vector.");
    d.input("balls", &Shift::balls).doc("n balls");
    d.output("balls", &Shift::shifted).doc("n balls, same order and radii; no defining samples");
    d.param("x", &Shift::by, &Vec3::x).unit("model units").doc("along the x axis; 0 stays");
    d.param("y", &Shift::by, &Vec3::y).unit("model units").doc("along the y axis; 0 stays");
    d.param("z", &Shift::by, &Vec3::z).unit("model units").doc("along the z axis; 0 stays");
  }

  void run(RunContext&) {
    std::vector<Vec3> centers(balls->centers.begin(), balls->centers.end());
    for (Vec3& center : centers) center = center + by;
    shifted = Balls{std::move(centers), balls->radii, {}, {}};
  }
};

BALLFLOW_PLUGIN("acme", "0.1.0", node_entries<Shift>(), type_entries<>())

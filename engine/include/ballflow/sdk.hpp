// The C++ side of the plugin boundary: what the author of a node writes, and nothing else of the engine.
//
//   struct Enlarge {
//     In<Balls> balls;
//     Out<Balls> enlarged;
//     EnlargeOptions options;                       // defaults live once, in the options struct
//
//     static void declare(NodeDecl<Enlarge>& d) {
//       d.id("acme.Grow", 1).summary("Grow radii so that pruning may drop small features.");
//       d.cites("kornberger2010", "3.5");
//       d.input("balls", &Enlarge::balls).doc("n balls");
//       d.output("balls", &Enlarge::enlarged).doc("n balls, same order, radii >= input");
//       d.param("epsilon", &Enlarge::options, &EnlargeOptions::epsilon)
//           .unit("% of the longest bounding-box edge").at_least(0).doc("0 returns the input");
//     }
//     void run(RunContext& context) { enlarged = enlarge(*balls, options); }
//   };
//   BALLFLOW_PLUGIN("acme", "0.1.0", ballflow::node_entries<Enlarge>(), ballflow::type_entries<Balls>())
//
// A parameter may lie deeper: d.param("x", &N::options, &Options::inner, &Inner::x). A type that travels on
// edges is any struct of arrays with a specialisation of TypeOf that names them (sdk/type.hpp). A failing run
// throws; what() is "cause\nhint". What does not depend on the node or type is in the library ballflow::sdk,
// and no other library is needed.
#pragma once

#include "ballflow/plugin.h"
#include "ballflow/sdk/error.hpp"
#include "ballflow/sdk/library.hpp"
#include "ballflow/sdk/node.hpp"
#include "ballflow/sdk/summary.hpp"
#include "ballflow/sdk/type.hpp"

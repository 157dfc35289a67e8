// The smallest type and node that the SDK can declare.
#pragma once

#include <ballflow/sdk.hpp>

struct Toy {
  double value = 0;
};

template <>
struct ballflow::TypeOf<Toy> {
  static void declare(TypeDecl<Toy>& d) {
    d.id("Toy", 1).doc("One number.");
    d.scalar("value", &Toy::value).doc("the number");
  }
};

struct MakeToy {
  ballflow::Out<Toy> toy;
  double value = TOY_DEFAULT;
  static void declare(ballflow::NodeDecl<MakeToy>& d) {
    d.id("MakeToy", 1).summary("Make a toy.");
    d.output("toy", &MakeToy::toy).doc("the toy");
    d.param("value", &MakeToy::value).unit("1").doc("its number");
  }
  void run(ballflow::RunContext&) { toy = Toy{value}; }
};

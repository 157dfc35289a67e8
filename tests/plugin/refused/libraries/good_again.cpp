// Declares the same as good.cpp.
#define TOY_DEFAULT 1
#include "toy.hpp"

BALLFLOW_PLUGIN("good_again", "1.2.3", ballflow::node_entries<MakeToy>(), ballflow::type_entries<Toy>())

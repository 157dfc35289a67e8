// Declares the node of good.cpp with another default.
#define TOY_DEFAULT 2
#include "toy.hpp"

BALLFLOW_PLUGIN("other_content", "1.2.3", ballflow::node_entries<MakeToy>(), ballflow::type_entries<Toy>())

#define TOY_DEFAULT helper_version()
extern "C" int helper_version();
#include "toy.hpp"

BALLFLOW_PLUGIN("uses_helper", "1.2.3", ballflow::node_entries<MakeToy>(), ballflow::type_entries<Toy>())

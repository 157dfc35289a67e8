// The declaration of its node misses the summary.
#include "note.hpp"

static const char text[] = R"({"id":"Half","version":1})";
static const bf_node node = {
    sizeof(bf_node), 0, {text, sizeof text - 1}, nullptr, [](void*, const bf_run*) -> int { return BF_OK; },
    nullptr};
static const bf_node* const nodes[] = {&node};
static const bf_plugin tables = {sizeof(bf_plugin),
                                 BALLFLOW_ABI_VERSION,
                                 {"malformed", 9},
                                 {"1", 1},
                                 nullptr,
                                 0,
                                 nodes,
                                 1,
                                 nullptr,
                                 nullptr};

TABLES { return &tables; }

// Its node has a port of a type that nobody declares.
#include "note.hpp"

static const char text[] = R"({"id":"Lonely","version":1,"summary":"s","doc":"",
  "outputs":[{"name":"out","type":"Nowhere","type_version":1,"doc":"d"}]})";
static const bf_node node = {
    sizeof(bf_node), 0, {text, sizeof text - 1}, nullptr, [](void*, const bf_run*) -> int { return BF_OK; },
    nullptr};
static const bf_node* const nodes[] = {&node};
static const bf_plugin tables = {sizeof(bf_plugin),
                                 BALLFLOW_ABI_VERSION,
                                 {"unknown", 7},
                                 {"1", 1},
                                 nullptr,
                                 0,
                                 nodes,
                                 1,
                                 nullptr,
                                 nullptr};

TABLES { return &tables; }

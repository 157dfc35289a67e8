#include "note.hpp"

static const bf_plugin tables = {
    8, BALLFLOW_ABI_VERSION, {"small", 5}, {"1", 1}, nullptr, 7, nullptr, 7, nullptr, nullptr};

TABLES { return &tables; }

// The ABI note of this version, for libraries that are wrong in another way.
#pragma once

#include <ballflow/plugin.h>

extern "C" __attribute__((visibility("default"), used, section(BALLFLOW_ABI_SECTION)))
const bf_abi_note ballflow_abi_note = {{'B', 'A', 'L', 'L', 'F', 'L', 'O', 'W'}, BALLFLOW_ABI_VERSION, 0};

#define TABLES extern "C" __attribute__((visibility("default"))) const bf_plugin* ballflow_plugin(void)

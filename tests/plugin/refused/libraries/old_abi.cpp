// Built for the first ABI. If any of its code ran, the process would be gone.
#include <ballflow/plugin.h>

#include <cstdlib>

extern "C" __attribute__((visibility("default"), used, section(BALLFLOW_ABI_SECTION)))
const bf_abi_note ballflow_abi_note = {{'B', 'A', 'L', 'L', 'F', 'L', 'O', 'W'}, 1, 0};

__attribute__((constructor)) static void runs_when_loaded() { std::abort(); }

extern "C" __attribute__((visibility("default"))) const bf_plugin* ballflow_plugin(void) { std::abort(); }

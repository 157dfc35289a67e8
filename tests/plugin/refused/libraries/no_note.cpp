// A shared library that is no node library.
#include <cstdlib>

__attribute__((constructor)) static void runs_when_loaded() { std::abort(); }

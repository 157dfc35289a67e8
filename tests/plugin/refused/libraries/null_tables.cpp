#include "note.hpp"

TABLES { return nullptr; }

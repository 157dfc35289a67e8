#include "note.hpp"

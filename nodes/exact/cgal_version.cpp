#include "exact/cgal_version.hpp"

#include <CGAL/version.h>

namespace ballflow::geometry {

const char* cgal_version() { return CGAL_VERSION_STR; }

}  // namespace ballflow::geometry

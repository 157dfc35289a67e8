// Geometry that commands compute by themselves, outside of a run.
#pragma once

#include <functional>

#include "base/monitor.hpp"

namespace ballflow::cli {

/// Calls compute(monitor) with a monitor that Ctrl-C cancels. Throws Error instead of what geometry throws:
/// code usage for InputError, code cancelled, with `unfinished` ("no picture was written"), for Cancelled.
void watched(const char* unfinished, const std::function<void(geometry::Monitor&)>& compute);

}  // namespace ballflow::cli

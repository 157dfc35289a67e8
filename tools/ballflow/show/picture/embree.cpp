#include "show/picture/embree.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace ballflow::show {
namespace {

// The name changes with the interface that the header above describes.
constexpr const char* library_name = "libembree3.so.3";
static_assert(RTC_VERSION_MAJOR == 3);

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) {
    throw std::runtime_error(std::string(library_name) + " has no function " + name +
                             "; install Embree 3 (Debian package libembree3-3)");
  }
}

Embree load() {
  void* const library = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(std::string("pictures need Embree 3, which cannot be loaded: ") + dlerror() +
                             "; install it (Debian package libembree3-3)");
  }
  Embree functions{};
  find(library, "rtcAttachGeometry", functions.attach_geometry);
  find(library, "rtcCommitGeometry", functions.commit_geometry);
  find(library, "rtcGetDeviceError", functions.get_device_error);
  find(library, "rtcIntersect1", functions.intersect_1);
  find(library, "rtcJoinCommitScene", functions.join_commit_scene);
  find(library, "rtcNewDevice", functions.new_device);
  find(library, "rtcNewGeometry", functions.new_geometry);
  find(library, "rtcNewScene", functions.new_scene);
  find(library, "rtcOccluded1", functions.occluded_1);
  find(library, "rtcReleaseDevice", functions.release_device);
  find(library, "rtcReleaseGeometry", functions.release_geometry);
  find(library, "rtcReleaseScene", functions.release_scene);
  find(library, "rtcSetGeometryBoundsFunction", functions.set_geometry_bounds_function);
  find(library, "rtcSetGeometryIntersectFunction", functions.set_geometry_intersect_function);
  find(library, "rtcSetGeometryOccludedFunction", functions.set_geometry_occluded_function);
  find(library, "rtcSetGeometryUserData", functions.set_geometry_user_data);
  find(library, "rtcSetGeometryUserPrimitiveCount", functions.set_geometry_user_primitive_count);
  find(library, "rtcSetSceneFlags", functions.set_scene_flags);
  find(library, "rtcSetSceneProgressMonitorFunction", functions.set_scene_progress_monitor_function);
  return functions;
}

}  // namespace

const Embree& embree() {
  static const Embree functions = load();
  return functions;
}

}  // namespace ballflow::show

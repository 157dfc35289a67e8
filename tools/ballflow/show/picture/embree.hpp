// Embree, loaded when the first picture is drawn: linked, its 44 MB would cost every start of the program 10
// ms.
#pragma once

#include <embree3/rtcore.h>

namespace ballflow::show {

/// The functions of Embree that pictures need, by its own names.
struct Embree {
  decltype(&::rtcAttachGeometry) attach_geometry;
  decltype(&::rtcCommitGeometry) commit_geometry;
  decltype(&::rtcGetDeviceError) get_device_error;
  decltype(&::rtcIntersect1) intersect_1;
  decltype(&::rtcJoinCommitScene) join_commit_scene;
  decltype(&::rtcNewDevice) new_device;
  decltype(&::rtcNewGeometry) new_geometry;
  decltype(&::rtcNewScene) new_scene;
  decltype(&::rtcOccluded1) occluded_1;
  decltype(&::rtcReleaseDevice) release_device;
  decltype(&::rtcReleaseGeometry) release_geometry;
  decltype(&::rtcReleaseScene) release_scene;
  decltype(&::rtcSetGeometryBoundsFunction) set_geometry_bounds_function;
  decltype(&::rtcSetGeometryIntersectFunction) set_geometry_intersect_function;
  decltype(&::rtcSetGeometryOccludedFunction) set_geometry_occluded_function;
  decltype(&::rtcSetGeometryUserData) set_geometry_user_data;
  decltype(&::rtcSetGeometryUserPrimitiveCount) set_geometry_user_primitive_count;
  decltype(&::rtcSetSceneFlags) set_scene_flags;
  decltype(&::rtcSetSceneProgressMonitorFunction) set_scene_progress_monitor_function;
};

/// Loaded at the first call, from any thread, and never unloaded. Throws std::runtime_error with the reason
/// when the library cannot be loaded; the next call tries again.
const Embree& embree();

}  // namespace ballflow::show

// What an adapter needs: the SDK, the plain structs of nodes/types as types of artifacts, and the monitor of
// a node that runs. The names and meanings of their arrays and summary fields stand in <type>.type.cpp; they
// are part of the interface of the project and stable.
#pragma once

#include <atomic>
#include <ballflow/sdk.hpp>
#include <chrono>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/bisection.hpp"
#include "types/comparison.hpp"
#include "types/cover_check.hpp"
#include "types/cover_state.hpp"
#include "types/growth.hpp"
#include "types/local_feature_size.hpp"
#include "types/mass_properties.hpp"
#include "types/medial_axis.hpp"
#include "types/mesh_report.hpp"
#include "types/minkowski_report.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"
#include "types/refinement.hpp"
#include "types/simplicial_complex.hpp"
#include "types/surface_report.hpp"
#include "types/topology_check.hpp"
#include "types/topology_table.hpp"
#include "types/triangle_mesh.hpp"
#include "types/type_of.hpp"

namespace ballflow {

/// Shows the progress of a geometry function in the engine, and the engine's cancellation to it.
class ContextMonitor final : public geometry::Monitor {
 public:
  explicit ContextMonitor(const RunContext& context) : context_(context) {}
  void progress(double fraction) override { context_.progress(fraction); }
  bool cancelled() override { return context_.cancelled(); }
  void note(const std::string& text) override {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    auto last = last_note_.load();
    constexpr auto pause = std::chrono::steady_clock::duration(std::chrono::seconds(2)).count();
    if (now - last > pause && last_note_.compare_exchange_strong(last, now)) context_.info(text);
  }
  void warn(const std::string& text) override { context_.warn(text); }
  std::uint64_t memory_bytes() override { return context_.memory_bytes(); }

 private:
  const RunContext& context_;
  // Quick nodes say nothing: the first pause begins with the node.
  std::atomic<std::chrono::steady_clock::rep> last_note_ =
      std::chrono::steady_clock::now().time_since_epoch().count();
};

}  // namespace ballflow

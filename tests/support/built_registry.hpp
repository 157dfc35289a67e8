// For tests that run graphs with the node libraries of the build.
#pragma once

#include "ballflow/registry.hpp"
#include "ballflow/run.hpp"

namespace ballflow {

class Silent final : public EventSink {
 public:
  void on(const Event&) override {}
};

inline const Registry& registry() {
  static const auto instance = Registry::load();
  return *instance;
}

}  // namespace ballflow

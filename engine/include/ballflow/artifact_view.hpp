// An artifact as the plugin boundary shows it.
#pragma once

#include "ballflow/artifact.hpp"
#include "ballflow/plugin.h"

namespace ballflow {

/// Holds the artifact, and what the bf_artifact points to, until it and everybody who has called retain let
/// go.
class ArtifactView {
 public:
  explicit ArtifactView(ArtifactPtr artifact);
  /// Of an artifact that outlives the view and everybody who retains it.
  explicit ArtifactView(const Artifact& artifact);
  ~ArtifactView();
  ArtifactView(ArtifactView&& other) noexcept;
  ArtifactView(const ArtifactView&) = delete;
  ArtifactView& operator=(const ArtifactView&) = delete;
  ArtifactView& operator=(ArtifactView&&) = delete;

  const bf_artifact& raw() const;

 private:
  struct Shared;
  Shared* shared_;
};

}  // namespace ballflow

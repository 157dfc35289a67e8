#include "ballflow/artifact_view.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace ballflow {

struct ArtifactView::Shared {
  ArtifactPtr artifact;
  std::vector<bf_array> arrays;
  bf_artifact raw{};
  std::atomic<int> references{1};

  explicit Shared(ArtifactPtr a) : artifact(std::move(a)) {
    arrays.reserve(artifact->arrays().size());
    for (const NamedArray& array : artifact->arrays()) {
      bf_array view{};
      view.struct_size = sizeof view;
      view.name = {array.name.data(), array.name.size()};
      view.dtype = array.dtype;
      view.rank = static_cast<std::uint32_t>(array.shape.size());
      std::copy(array.shape.begin(), array.shape.end(), view.shape);  // seal and decode check the rank
      view.data = array.data;
      arrays.push_back(view);
    }
    raw.struct_size = sizeof raw;
    raw.type = {artifact->type().data(), artifact->type().size()};
    raw.type_version = static_cast<std::uint32_t>(artifact->version());
    raw.summary = {artifact->summary().data(), artifact->summary().size()};
    raw.arrays = arrays.data();
    raw.array_count = arrays.size();
    raw.owner = this;
    raw.retain = &retain;
    raw.release = &release;
  }
  static void retain(void* self) noexcept {
    static_cast<Shared*>(self)->references.fetch_add(1, std::memory_order_relaxed);
  }
  static void release(void* self) noexcept {
    auto* shared = static_cast<Shared*>(self);
    if (shared->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete shared;
  }
};

ArtifactView::ArtifactView(ArtifactPtr artifact) : shared_(new Shared(std::move(artifact))) {}
ArtifactView::ArtifactView(const Artifact& artifact)
    : ArtifactView(ArtifactPtr(std::shared_ptr<const void>(), &artifact)) {}
ArtifactView::ArtifactView(ArtifactView&& other) noexcept : shared_(std::exchange(other.shared_, nullptr)) {}
ArtifactView::~ArtifactView() {
  if (shared_ != nullptr) Shared::release(shared_);
}
const bf_artifact& ArtifactView::raw() const { return shared_->raw; }

}  // namespace ballflow

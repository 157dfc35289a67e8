// What is in the store, and in which order it goes (ballflow/gc.hpp).
#pragma once

#include <cstdint>
#include <functional>
#include <set>

#include "ballflow/gc.hpp"
#include "store/folders.hpp"

namespace ballflow {

/// Scores the artifacts by those actions that `counts` and sorts them.
void weigh(CacheContents& contents, std::int64_t now, const std::function<bool(const CachedAction&)>& counts);

std::set<Digest> pinned_digests(const StoreFolders& folders);

}  // namespace ballflow

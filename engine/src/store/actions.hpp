// ac/: what a node produced for a key.
#pragma once

#include <optional>

#include "store/folders.hpp"
#include "store/publisher.hpp"

namespace ballflow {

/// What Store::find_action, peek_action and put_action promise.
class Actions {
 public:
  Actions(const StoreFolders& folders, Publisher& publisher) : folders_(folders), publisher_(publisher) {}

  std::optional<ActionEntry> find(const Digest& key) const { return read(key, true); }
  std::optional<ActionEntry> peek(const Digest& key) const { return read(key, false); }
  ActionPut put(const Digest& key, const ActionEntry& entry, bool sync);

 private:
  std::optional<ActionEntry> read(const Digest& key, bool used) const;

  const StoreFolders& folders_;
  Publisher& publisher_;
};

}  // namespace ballflow

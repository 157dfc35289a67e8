#include "store/actions.hpp"

#include "store/store_format.hpp"

namespace ballflow {
namespace {

bool same_but_for_times(const ActionEntry& a, const ActionEntry& b) {
  return a.manifest == b.manifest && a.outputs == b.outputs && a.warnings == b.warnings;
}

}  // namespace

std::optional<ActionEntry> Actions::read(const Digest& key, bool used) const {
  const std::string hex = key.hex();
  const auto bytes =
      read_trusted(folders_, open_shard(folders_, folders_.ac, hex), rest_of(hex), entry_limit, used);
  return bytes ? decode_action(key, *bytes) : std::nullopt;
}

ActionPut Actions::put(const Digest& key, const ActionEntry& entry, bool sync) {
  if (!folders_.writing) return {};
  auto there = find(key);
  if (there && same_but_for_times(*there, entry)) return {true, std::nullopt};
  const std::string hex = key.hex(), bytes = encode(key, entry);
  if (bytes.size() > entry_limit) {
    publisher_.failed("ac/" + hex, -EFBIG);
    return {};
  }
  const auto publish = [&](bool replace) {
    return publisher_.publish(folders_.ac, "ac", hex, {std::as_bytes(std::span(bytes))}, {sync, replace, {}});
  };
  Published published = publish(there.has_value());
  if (published == Published::there) {
    // Damaged, or of another process that was quicker: what that one says must not go unseen either.
    there = find(key);
    if (there && same_but_for_times(*there, entry)) return {true, std::nullopt};
    published = publish(true);
  }
  if (published == Published::no) return {};
  ActionPut put{true, std::nullopt};
  if (there && there->outputs != entry.outputs) put.disagreed = std::move(there);
  return put;
}

}  // namespace ballflow

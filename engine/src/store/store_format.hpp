// The files of the store. Numbers are little-endian; text is a u32 length and so many bytes; the checksum at
// the end is the XXH3-128 (low u64, high u64) of everything before it. A file that does not follow its
// grammar to the last byte is a miss.
//
// Action entry, ac/<key>:
//   "bfaction" u32:1 key[32] f64:seconds f64:cpu_seconds text:manifest
//   u32:outputs { text:port text:type i32:type_version digest[32] u64:bytes u64:checksum.low
//   u64:checksum.high
//                 text:summary }
//   u32:warnings { text }
//   checksum
//
// Memoised digest of an input file, files/<SHA-256 of u64:device u64:inode>:
//   "bfdigest" u32:1 u64:device u64:inode u64:size i64:mtime_ns i64:ctime_ns digest[32] checksum
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ballflow/store.hpp"
#include "base/file_state.hpp"

namespace ballflow {

inline constexpr std::uint64_t entry_limit = 64u << 20;  // bytes; no honest entry comes near it

std::string encode(const Digest& key, const ActionEntry& entry);

/// Nothing when the bytes break the grammar or belong to another key.
std::optional<ActionEntry> decode_action(const Digest& key, std::string_view bytes);

struct Memo {
  FileState state;
  Digest digest;
};

std::string encode(const Memo& memo);

/// Nothing when the bytes break the grammar.
std::optional<Memo> decode_memo(std::string_view bytes);

}  // namespace ballflow

// The open folders of a store: whom they belong to has been checked, and everything else is reached from
// here without following a link. What all rooms of the store share.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "ballflow/digest.hpp"
#include "ballflow/store.hpp"
#include "base/file_state.hpp"
#include "base/open_file.hpp"

namespace ballflow {

inline constexpr mode_t folder_mode = 0755, lock_mode = 0600;

struct StoreFolders {
  std::shared_ptr<FileSystem> files;
  std::string path;  // of the root, absolute; empty: there is no store
  std::string why;   // it is read-only or absent
  OpenFile root, cas, ac, runs, pins, tmp, quarantine, memos, locks, leases;
  bool writing = false;
};

/// Opens or creates. Throws Error (code store) when a folder cannot be trusted.
std::shared_ptr<const StoreFolders> open_folders(const StoreOptions& options,
                                                 std::shared_ptr<FileSystem> files);

inline std::string shard_of(const std::string& hex) { return hex.substr(0, 2); }
inline std::string rest_of(const std::string& hex) { return hex.substr(2); }

/// The subfolder of a hexadecimal name; a symbolic link or one that others may write is as good as none.
OpenFile open_shard(const StoreFolders& folders, const OpenFile& top, const std::string& hex,
                    bool create = false);

/// The content of a file that is regular and can be trusted; nothing when it is not, or has more than `limit`
/// bytes. `used`: counts as a use of the file.
std::optional<std::string> read_trusted(const StoreFolders& folders, const OpenFile& folder,
                                        const std::string& name, std::uint64_t limit, bool used = false);

/// The names in a folder, sorted; none when it is not open.
std::vector<std::string> names_in(const StoreFolders& folders, const OpenFile& folder);

/// The regular files of cas/, ac/ or files/ with names that the store gives, sorted.
struct StoredFile {
  Digest name;
  std::uint64_t bytes = 0;
  std::int64_t modified = 0;  // nanoseconds since 1970
};
std::vector<StoredFile> files_below(const StoreFolders& folders, const OpenFile& top);

/// Moves a file away, where its absence is a miss; false when that cannot be.
bool to_quarantine(const StoreFolders& folders, const OpenFile& shard, const std::string& hex);

inline constexpr std::int64_t second = 1'000'000'000;  // in nanoseconds

inline std::string system_message(int negative_errno) {
  return std::generic_category().message(-negative_errno);
}

/// What a file costs on the disk: whole blocks of 4 KiB.
inline std::uint64_t disk_bytes(std::uint64_t size) { return (size + 4095) / 4096 * 4096; }

/// The time of last use of an action entry or a blob is the mtime of its file, set anew when it is used and
/// older than this (nanoseconds).
inline constexpr std::int64_t touch_interval = 3600 * second;

/// Records that an open file is used now.
void touch(const StoreFolders& folders, const OpenFile& file, const struct stat& status);

}  // namespace ballflow

#include "store/file_digests.hpp"

#include "ballflow/error.hpp"
#include "store/store_format.hpp"

namespace ballflow {
namespace {

std::optional<Memo> read_memo(const StoreFolders& folders, const std::string& hex, bool used) {
  const auto bytes =
      read_trusted(folders, open_shard(folders, folders.memos, hex), rest_of(hex), entry_limit, used);
  return bytes ? decode_memo(*bytes) : std::nullopt;
}

}  // namespace

Digest FileDigests::digest_of(const std::string& path) {
  FileSystem& files = *folders_.files;
  const auto fail = [&](const std::string& why, const std::string& hint) {
    throw Error(ExitCode::store, "cannot read " + path + ": " + why, hint);
  };
  constexpr int attempts = 3;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const OpenFile file(files,
                        files.open(FileSystem::working_folder, path, O_RDONLY | O_NONBLOCK | O_NOCTTY));
    struct stat status {};
    const int error = file.is_open() ? files.status(file.get(), status) : file.get();
    if (error < 0) fail(system_message(error), "check the path and the permissions of the file");
    if (!S_ISREG(status.st_mode)) {
      fail(S_ISDIR(status.st_mode) ? "it is a directory" : "it is not a regular file",
           "name a file, not a folder, pipe or device");
    }
    const FileState state(status);
    if (state.settled(files.now())) {
      const auto known = read_memo(folders_, state.memo_name(), true);
      if (known && known->state == state) return known->digest;
    }
    Digest digest;
    const std::int64_t size = sha256_of_file(files, file.get(), state.size, digest);
    if (size < 0) fail(system_message(static_cast<int>(size)), "check the disk");
    if (files.status(file.get(), status) < 0 || FileState(status) != state ||
        static_cast<std::uint64_t>(size) != state.size) {
      continue;
    }
    if (folders_.writing && state.settled(files.now())) {
      const std::string bytes = encode(Memo{state, digest});
      publisher_.publish(folders_.memos, "files", state.memo_name(), {std::as_bytes(std::span(bytes))},
                         {false, true, {}});
    }
    return digest;
  }
  fail("it changes while it is being read", "wait until its writer is done");
  return {};
}

bool FileDigests::intact(const Digest& name) const {
  const auto memo = read_memo(folders_, name.hex(), false);
  return memo && memo->state.memo_name() == name.hex();
}

}  // namespace ballflow

// pins/, and the finding of digests by their first digits.
#include <system_error>

#include "ballflow/error.hpp"
#include "ballflow/gc.hpp"
#include "store/contents.hpp"
#include "store/parts.hpp"

namespace ballflow {
namespace {

[[noreturn]] void cannot(const char* what, const Store& store, int error) {
  throw Error(ExitCode::store,
              std::string("cannot ") + what + " in " + store.root() + ": " + system_message(error),
              store.why());
}

}  // namespace

std::set<Digest> pinned_digests(const StoreFolders& folders) {
  std::set<Digest> digests;
  for (const std::string& name : names_in(folders, folders.pins)) {
    if (const auto digest = Digest::from_hex(name)) digests.insert(*digest);
  }
  return digests;
}

std::vector<Digest> find_artifacts(Store& store, std::string_view prefix) {
  const StoreFolders& folders = store.parts().folders;
  const std::string digits(prefix);
  if (digits.size() < 2) {
    std::vector<Digest> found;
    for (const StoredFile& file : files_below(folders, folders.cas)) {
      if (file.name.hex().starts_with(digits)) found.push_back(file.name);
    }
    return found;
  }
  // One subfolder is enough, and for a whole digest not even that is listed.
  const auto whole = Digest::from_hex(digits);
  const OpenFile shard = open_shard(folders, folders.cas, digits);
  const std::vector<std::string> names =
      whole ? std::vector<std::string>{rest_of(digits)} : names_in(folders, shard);
  std::vector<Digest> found;
  for (const std::string& name : names) {
    const auto digest = Digest::from_hex(shard_of(digits) + name);
    struct stat status {};
    if (!digest || !name.starts_with(rest_of(digits)) || !shard.is_open()) continue;
    if (folders.files->status(shard.get(), name, status) < 0 || !S_ISREG(status.st_mode)) continue;
    found.push_back(*digest);
  }
  return found;
}

std::vector<Digest> find_pins(Store& store, std::string_view prefix) {
  const StoreFolders& folders = store.parts().folders;
  if (const auto whole = Digest::from_hex(prefix)) {
    struct stat status {};
    const bool there =
        folders.pins.is_open() && folders.files->status(folders.pins.get(), whole->hex(), status) == 0;
    return there ? std::vector{*whole} : std::vector<Digest>();
  }
  std::vector<Digest> found;
  for (const Digest& digest : pinned_digests(folders)) {
    if (digest.hex().starts_with(prefix)) found.push_back(digest);
  }
  return found;
}

void pin(Store& store, const Digest& digest) {
  const StoreFolders& folders = store.parts().folders;
  if (!folders.writing) cannot("pin", store, -EROFS);
  const OpenFile file(*folders.files,
                      folders.files->open(folders.pins.get(), digest.hex(),
                                          O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK, 0444));
  if (!file.is_open()) cannot("pin", store, file.get());
}

void unpin(Store& store, const Digest& digest) {
  const StoreFolders& folders = store.parts().folders;
  const int result = folders.writing ? folders.files->remove(folders.pins.get(), digest.hex()) : -EROFS;
  if (result < 0 && result != -ENOENT) cannot("unpin", store, result);
}

}  // namespace ballflow

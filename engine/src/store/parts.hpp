// The rooms of a store, on the same open folders.
#pragma once

#include "store/actions.hpp"
#include "store/blobs.hpp"
#include "store/file_digests.hpp"
#include "store/folders.hpp"
#include "store/locks.hpp"
#include "store/publisher.hpp"
#include "store/shared.hpp"
#include "store/usage.hpp"

namespace ballflow {

class StoreParts {
 public:
  StoreParts(std::shared_ptr<const StoreFolders> opened, const UpstreamUse& upstream)
      : keep(std::move(opened)),
        folders(*keep),
        written(folders),
        publisher(folders, written),
        blobs(folders, publisher),
        actions(folders, publisher),
        file_digests(folders, publisher),
        locks(keep, [this](const std::string& what, int error) { publisher.failed(what, error); }),
        shared(upstream, folders, publisher, blobs) {}
  StoreParts(const StoreParts&) = delete;
  StoreParts& operator=(const StoreParts&) = delete;

  const std::shared_ptr<const StoreFolders> keep;  // also by locks, which may outlive the store
  const StoreFolders& folders;
  WrittenBytes written;
  Publisher publisher;
  Blobs blobs;
  Actions actions;
  FileDigests file_digests;
  KeyLocks locks;
  SharedResults shared;
};

}  // namespace ballflow

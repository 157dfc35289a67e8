// files/: digests of input files, so that large ones are not read again and again.
#pragma once

#include "store/folders.hpp"
#include "store/publisher.hpp"

namespace ballflow {

class FileDigests {
 public:
  FileDigests(const StoreFolders& folders, Publisher& publisher) : folders_(folders), publisher_(publisher) {}

  /// What Store::file_digest promises.
  Digest digest_of(const std::string& path);
  /// Whether files/<name> is there and undamaged.
  bool intact(const Digest& name) const;

 private:
  const StoreFolders& folders_;
  Publisher& publisher_;
};

}  // namespace ballflow

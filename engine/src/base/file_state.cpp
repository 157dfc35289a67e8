#include "base/file_state.hpp"

#include <unistd.h>

#include <algorithm>

#include "base/record.hpp"

namespace ballflow {

namespace {
constexpr std::int64_t settled_after = 2'000'000'000;  // ns; no file system stamps coarser than 2 s (FAT)
}

FileState::FileState(const struct stat& status)
    : device(status.st_dev),
      inode(status.st_ino),
      size(static_cast<std::uint64_t>(status.st_size)),
      modified(nanoseconds(status.st_mtim)),
      changed(nanoseconds(status.st_ctim)) {}

bool FileState::settled(std::int64_t now) const { return now - std::max(modified, changed) >= settled_after; }

std::string FileState::memo_name() const {
  RecordWriter writer;
  writer.number(device);
  writer.number(inode);
  return sha256(writer.bytes()).hex();
}

void encode(const FileState& state, RecordWriter& writer) {
  writer.number(state.device);
  writer.number(state.inode);
  writer.number(state.size);
  writer.number(state.modified);
  writer.number(state.changed);
}

FileState decode_state(RecordReader& reader) {
  FileState state;
  reader.number(state.device);
  reader.number(state.inode);
  reader.number(state.size);
  reader.number(state.modified);
  reader.number(state.changed);
  return state;
}

std::string distrust(const struct stat& status) {
  if (status.st_uid != ::geteuid() && status.st_uid != 0) {
    return "belongs to another user (id " + std::to_string(status.st_uid) + ")";
  }
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    std::string mode = "0000";
    for (std::size_t i = 0; i < mode.size(); ++i) {
      mode[i] = static_cast<char>('0' + (status.st_mode >> (9 - 3 * i) & 7));
    }
    return "can be written by other users (mode " + mode + ")";
  }
  return {};
}

}  // namespace ballflow

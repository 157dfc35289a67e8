// What node libraries declare, kept from one start of a program to the next, so that a library is opened only
// when one of its nodes runs. One file of the cache folder, <root>/libraries; numbers, texts and the checksum
// at the end are those of base/record.hpp:
//   "bflibrary" u32:2 u32:plugin ABI
//   text:LD_LIBRARY_PATH
//   u32:shared objects { text:path u64:device u64:inode u64:size i64:mtime_ns i64:ctime_ns }
//   u32:libraries { text:path u64:device u64:inode u64:size i64:mtime_ns i64:ctime_ns u8:has digest
//   digest[32]
//                   text:name text:version
//                   u32:types { text:id i32:version text:declaration }
//                   u32:nodes { text:id u8:lists files text:declaration
//                               u32:ports { text:name text:type i32:type_version } } }
//   checksum
// Only libraries that were loaded and found good are in it. What they declare has versions of libraries that
// they use (CBC, CGAL) in it, as these say at run time: the shared objects are all that processes had loaded
// when they added something, and when one of them is another file today, or libraries are looked for in other
// folders, nothing of the index counts. A file that does not follow its grammar to the last byte, or that
// others may have written, is none; so is what was written for another state of a library.
// Its number of format changes with what the engine refuses of declarations, too.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/file_system.hpp"
#include "base/file_state.hpp"
#include "base/open_file.hpp"
#include "plugin/outline.hpp"

namespace ballflow {

class LibraryIndex {
 public:
  /// Reads the index of the cache folder `root`, which is not made when it is not there: who only looks needs
  /// no cache. Nothing that goes wrong is an error: then there is no index. An empty `root`: there is none
  /// either.
  LibraryIndex(const std::string& root, std::shared_ptr<FileSystem> files);

  /// What the library at `path` (absolute, no link) declares in this state; null when that is not known.
  std::shared_ptr<const LibraryOutline> find(const std::string& path, const FileState& state) const;
  /// `state` is that of the file before and after it was loaded. A file that was written a moment ago is not
  /// taken: its time stamp may not tell it from the next one.
  void add(const std::string& path, const FileState& state, std::shared_ptr<const LibraryOutline> outline);
  /// Replaces the file, when something was added. What is in it of libraries that are gone is left out.
  void save();

 private:
  struct Known {
    FileState state;
    std::shared_ptr<const LibraryOutline> outline;
  };
  std::optional<std::string> read() const;
  void decode(std::string_view bytes);
  std::string encoded() const;
  void note_shared_objects();

  std::shared_ptr<FileSystem> files_;
  OpenFile root_;
  std::map<std::string, Known> libraries_;
  std::map<std::string, FileState> shared_objects_;  // by the path that the loader found
  bool changed_ = false;
};

}  // namespace ballflow

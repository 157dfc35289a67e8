// The files that a command reads and those that it writes: none is both.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "ballflow/graph.hpp"

namespace ballflow::cli {

/// What reads and what writes says so here, in any order, before it does it. A path that would be written
/// must not lead to a file that is read, to one that is written anyway, or into the cache, by whatever way:
/// symbolic and hard links, "..", another spelling, /proc/self/fd, and folders that are yet to be made. Files
/// are told apart by device and inode, those that do not exist by their path without links. Devices and pipes
/// hold nothing that could be lost. What the program prints must not go to a file that it reads (>> file),
/// but may go to one that is written (--report /dev/stdout).
///
/// All functions throw Error (code usage) that names both sides.
class Places {
 public:
  Places();

  /// `what`: "the input of node sample", "the graph".
  void reads(const std::string& what, const std::string& path);
  /// The files of a graph, and those that its nodes take as parameters.
  void reads(const Dag& dag);
  /// Nothing is written below this folder but by the cache itself.
  void has_cache(const std::string& root);
  /// `what`: "--report", "the output balls of --out".
  void writes(const std::string& what, const std::string& path);

 private:
  using File = std::pair<dev_t, ino_t>;
  struct Place {
    std::string given, path;   // as written; absolute and without links
    std::optional<File> file;  // where there is one
    bool is_special = false;   // a device or a pipe
  };
  struct Use {
    std::string what, given;
  };
  /// Uses of places: by their path, and where there is a file by this too.
  struct Uses {
    std::map<std::string, Use> by_path;
    std::map<File, Use> by_file;
    void add(const Place& place, const std::string& what);
    const Use* find(const Place& place) const;
  };

  /// Absolute and without links.
  std::string real_path(const std::string& path);
  std::string real(const std::filesystem::path& absolute);
  Place place_of(const std::string& path);
  bool in_cache(const Place& place);
  void reads(const DagNode& node);

  Uses read_, written_;
  std::set<File> printed_;      // where standard output and error go, when they are files
  std::set<std::string> seen_;  // what is read: a sweep names the same files many times
  std::optional<Place> cache_;
  // A sweep writes many files to few folders.
  std::map<std::string, std::string> real_folders_;
  std::map<std::string, bool> folders_in_cache_;
};

}  // namespace ballflow::cli

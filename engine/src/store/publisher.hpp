// The writing of files of the store: drafts in tmp/, in a folder of this process, moved into place.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/draft.hpp"
#include "store/folders.hpp"
#include "store/usage.hpp"

namespace ballflow {

enum class Published { no, there, written };  // `there`: something of this name was, and stays

struct PublishOptions {
  bool sync = false;     // flush to the disk before it is moved
  bool replace = false;  // what has its name
  std::function<bool()> give_up;
};

class Publisher {
 public:
  /// Removes what dead processes of this machine left in tmp/.
  Publisher(const StoreFolders& folders, WrittenBytes& written);
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// Writes a file of cas/, ac/ or files/ (`top_name`) under its hexadecimal name.
  Published publish(const OpenFile& top, const std::string& top_name, const std::string& hex,
                    const std::vector<std::span<const std::byte>>& pieces, const PublishOptions& options);

  /// The same from a source that writes piece by piece; what it returns when it is negative is why nothing is
  /// published, -ECANCELED is no trouble.
  using Write = std::function<int(std::span<const std::byte>)>;
  using Source = std::function<int(const Write&)>;
  Published publish_from(const Source& source, const OpenFile& top, const std::string& top_name,
                         const std::string& hex, const PublishOptions& options);

  /// Writes a text under a plain name into an open folder; what is there is replaced.
  bool publish(const OpenFile& folder, const std::string& name, std::string_view text);

  /// Keeps the first failure: "cannot write <what>: <error>".
  void failed(const std::string& what, int error);
  std::string trouble() const;

 private:
  struct Workspace;
  struct File;

  std::shared_ptr<Workspace> workspace(int& error);
  std::unique_ptr<File> write(const Source& source, const PublishOptions& options, int& error);
  void remove_stale_workspaces();

  const StoreFolders& folders_;
  WrittenBytes& written_;
  std::mutex workspace_mutex_;
  std::shared_ptr<Workspace> workspace_;
  std::atomic<std::uint64_t> next_file_ = 0;
  mutable std::mutex trouble_mutex_;
  std::string trouble_;
};

}  // namespace ballflow

// An upstream on a server: GET, HEAD and PUT of /ac/<sha256> and /cas/<sha256>, the remote cache protocol
// that Bazel's users know (https://bazel.build/remote/caching). Any server that keeps what it is sent will
// do.
#pragma once

#include <mutex>

#include "ballflow/upstream.hpp"

namespace ballflow {

/// Whether it begins with http:// or https://.
bool is_address(const std::string& place);

class UpstreamHttp final : public Upstream {
 public:
  /// Throws Error: when the address is none (code usage), when libcurl is not there (code store).
  explicit UpstreamHttp(std::string address);
  ~UpstreamHttp() override;

  const std::string& place() const override { return address_; }
  Read get(Room room, const Digest& name, const Sink& sink, bool afresh) override;
  std::optional<std::uint64_t> size(Room room, const Digest& name) override;
  /// A file that is there stays; between the look and the PUT another may come first and be replaced by the
  /// same.
  Written put(Room room, const Digest& name, const std::vector<std::span<const std::byte>>& pieces,
              const PutOptions& options) override;
  /// Where the server allows DELETE.
  bool set_aside(Room room, const Digest& name) override;

 private:
  class Connection;
  struct Answer {
    long status = 0;           // of HTTP; 0 where there was none
    std::string why;           // there was none
    bool unreachable = false;  // nothing was heard at all, or not in time
    std::uint64_t length = 0;  // of the content, as the server says
  };

  std::unique_ptr<Connection> take();
  void give_back(std::unique_ptr<Connection> connection);
  std::string url(Room room, const Digest& name) const;

  std::string address_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Connection>> idle_;  // each for one thread at a time; kept open for the next
};

}  // namespace ballflow

// A store that many machines share, behind the store on the local disk (store.hpp): a folder on NFS or
// Lustre, or a server of the remote cache protocol that Bazel's users know.
//
//   <folder>/cas/ab/cdef...  artifacts by SHA-256           http://host/path/cas/<sha256>
//   <folder>/ac/ab/cdef...   action entries by action key   http://host/path/ac/<sha256>
//
// Files are those of the local store, byte for byte. They never change: written under another name in the
// same folder and linked into place (the first publisher wins), blobs first and the entry last. There are no
// locks, no leases and no times of use, and nothing is deleted while jobs run. Blobs are verified by size and
// SHA-256 on their way in and lie on the local disk before anybody maps them. Entries are believed: who may
// write to an upstream may make others compute with wrong results, so its writers have to trust each other.
//
// Every function may be called from several threads at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballflow/digest.hpp"

namespace ballflow {

class FileSystem;

/// One shared place, which moves bytes and knows nothing of what they mean.
class Upstream {
 public:
  enum class Room { actions, blobs };  // ac/, cas/

  /// Takes the bytes of a file in their order, from its beginning; false: no more are wanted.
  using Sink = std::function<bool(std::span<const std::byte>)>;

  enum class Got {
    found,        // the sink took all of it
    refused,      // the sink wanted no more
    absent,       // there is no such file
    stale,        // it went away under the reader: ask once more
    failed,       // it cannot be read
    unreachable,  // nothing can, now: the server does not answer
  };
  struct Read {
    Got got = Got::absent;
    std::string why;  // of failed and unreachable
  };

  enum class Put {
    written,
    there,  // something of this name is, and stays
    given_up,
    failed,
    unreachable
  };
  struct Written {
    Put put = Put::failed;
    std::string why;  // of failed and unreachable
  };
  struct PutOptions {
    bool sync = false;              // flush to the disk before it gets its name
    bool replace = false;           // what is there is known to be damaged and could not be set aside
    std::function<bool()> give_up;  // polled every few megabytes
  };

  Upstream() = default;
  virtual ~Upstream() = default;
  Upstream(const Upstream&) = delete;
  Upstream& operator=(const Upstream&) = delete;

  /// As it was named: "/nfs/group/ballflow", "http://cache:8080/ballflow".
  virtual const std::string& place() const = 0;

  /// `afresh`: the file must be there and was not seen: do not believe what this machine remembers of the
  /// folder.
  virtual Read get(Room room, const Digest& name, const Sink& sink, bool afresh) = 0;
  /// The size of a file in bytes; nothing when it is not there or cannot be asked for.
  virtual std::optional<std::uint64_t> size(Room room, const Digest& name) = 0;
  virtual Written put(Room room, const Digest& name, const std::vector<std::span<const std::byte>>& pieces,
                      const PutOptions& options) = 0;
  /// Takes a damaged file out of the way, so that it is absent. False when that cannot be.
  virtual bool set_aside(Room room, const Digest& name) = 0;

  /// A folder, or an address that begins with http:// or https://. Throws Error (code store) when the folder
  /// is not there, is no folder or can be written by everybody; group-shared folders (mode 2770) are what it
  /// is made for. A server is not asked before something is wanted from it.
  static std::shared_ptr<Upstream> open(const std::string& place, std::shared_ptr<FileSystem> files = {});
};

/// How a store uses its upstream.
struct UpstreamUse {
  std::shared_ptr<Upstream> upstream;  // null: there is none
  bool read_only = false;
  /// The upstream is the only way to hand results on, as between the jobs of a cluster: everything is
  /// published, also what is quicker to make again than to store, and what cannot be fails its node (Error,
  /// code store).
  bool transport = false;
  /// For so many seconds a blob that an entry promises is looked for again: shared folders may show a file to
  /// one machine later than to another.
  double patience = 0;
};

}  // namespace ballflow

// An artifact: an immutable bundle of named typed arrays and a small JSON summary; the only thing that
// travels on edges. What is in memory is what is on disk is what crosses the plugin boundary.
//
// The file is in the safetensors layout:
//   8 bytes   little-endian length N of the header
//   N bytes   JSON header, padded with spaces so that the data starts at a multiple of 64:
//             {"__metadata__":{"ballflow":"1","summary":"<canonical JSON>","type":"Balls","version":"1"},
//              "centers":{"dtype":"F64","shape":[n,3],"data_offsets":[begin,end]}, ...}
//   data      the arrays without holes, by element size (largest first), then by name; offsets count from
//             the start of the data; little-endian, C order
// The bytes are canonical: equal arrays, summary and type give equal bytes. The digest is their SHA-256.
// Header keys are sorted, "__metadata__" first; there is no space in the header but its padding.
//
// Limits, of writing and of reading: the header (with the summary in it) has at most 16 MB; names of arrays
// and of the type are 1 to 255 printable ASCII characters without quote and backslash; ranks are 0 to
// BALLFLOW_MAX_RANK; a summary nests at most 64 deep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/digest.hpp"
#include "ballflow/error.hpp"
#include "ballflow/plugin.h"

namespace ballflow {

std::size_t dtype_size(std::uint32_t dtype);           // 0 for an unknown dtype
std::string_view dtype_name(std::uint32_t dtype);      // "f64", as in declarations
std::uint32_t dtype_from_name(std::string_view name);  // 0 for an unknown name

struct NamedArray {
  std::string name;
  std::uint32_t dtype = 0;  // bf_dtype
  std::vector<std::uint64_t> shape;
  const void* data = nullptr;
  // Keeps `data` alive and nothing else; null where only all of the artifact keeps it. A node that hands an
  // array on as it got it then does not hold on to the whole of its input, and a loop not to all states
  // before.
  std::shared_ptr<const void> keeper = {};

  std::uint64_t elements() const;
  std::uint64_t bytes() const;
};

/// A byte string that is not an artifact.
class BadArtifact : public Error {
 public:
  explicit BadArtifact(const std::string& what) : Error(ExitCode::store, what) {}
};

class Artifact {
 public:
  /// Seals arrays: sorts them and writes the header. `owner` keeps all data alive and unchanged; nothing is
  /// copied, and nothing is hashed before somebody asks (states of loops never are). `summary` is a JSON
  /// object; it is rewritten in canonical form. Throws Error (code plugin, because a node library made them)
  /// when a name is not unique, a size overflows or a limit is passed.
  static std::shared_ptr<const Artifact> seal(std::string type, int version, std::vector<NamedArray> arrays,
                                              std::string_view summary, std::shared_ptr<const void> owner);

  /// Reads the layout above from memory that `owner` keeps alive, without copying the arrays; `file` starts
  /// at a multiple of 8. Any byte string may be given: throws Error (code store) that says what is wrong with
  /// it. What it accepts is canonical: sealing the arrays again gives the same bytes. Computes the checksum,
  /// not the digest.
  static std::shared_ptr<const Artifact> decode(std::span<const std::byte> file,
                                                std::shared_ptr<const void> owner);

  /// Maps a file read-only and decodes it. The artifact stays valid when the file is deleted or replaced;
  /// like every mapping it does not survive that the file is cut short.
  static std::shared_ptr<const Artifact> map(const std::string& path);
  /// The same for an open file, which may be closed afterwards. `name` is for messages. `known`: the digest
  /// of the file, when somebody vouches for it; then digest() gives it without reading the file again.
  static std::shared_ptr<const Artifact> map(int file, const std::string& name,
                                             const std::optional<Digest>& known = std::nullopt);

  const std::string& type() const { return type_; }
  int version() const { return version_; }
  const std::vector<NamedArray>& arrays() const { return arrays_; }
  const NamedArray* find(std::string_view name) const;
  const std::string& summary() const { return summary_; }  // canonical JSON object
  const Digest& digest() const;                            // computed on first use
  Checksum checksum() const;                               // computed on first use, or with the digest
  /// Computes both, and looks at `give_up` every few milliseconds; false when it said so.
  bool hash(const std::function<bool()>& give_up) const;
  std::uint64_t file_size() const { return file_size_; }

  /// The file as a list of pieces, to be written one after the other.
  std::vector<std::span<const std::byte>> pieces() const;

 private:
  Artifact() = default;
  static std::shared_ptr<Artifact> read(std::span<const std::byte> file, std::shared_ptr<const void> owner);

  std::string type_;
  int version_ = 0;
  std::vector<NamedArray> arrays_;  // in the order of the file
  std::string summary_;
  std::string header_;  // length, JSON and padding
  mutable std::mutex sums_mutex_;
  mutable std::optional<Digest> digest_;  // once it was asked for; never changes then, like the checksum
  mutable std::optional<Checksum> checksum_;
  std::uint64_t file_size_ = 0;
  std::shared_ptr<const void> owner_;
};

using ArtifactPtr = std::shared_ptr<const Artifact>;

}  // namespace ballflow

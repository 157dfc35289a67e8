// One input of the fuzzer: the bytes of an artifact file. What the decoder accepts is what sealing would
// write.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "ballflow/artifact.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ballflow;
  // A copy of exact size, aligned as a mapped file: a sanitizer sees every byte read beyond its end.
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  const std::shared_ptr<void> file(std::aligned_alloc(64, (size + 63) / 64 * 64 + 64), Free());
  std::memcpy(file.get(), data, size);
  try {
    const auto read = Artifact::decode({static_cast<const std::byte*>(file.get()), size}, file);
    const auto artifact =
        Artifact::seal(read->type(), read->version(), read->arrays(), read->summary(), file);
    std::vector<std::byte> again;
    for (const auto piece : artifact->pieces()) again.insert(again.end(), piece.begin(), piece.end());
    if (again.size() != size || std::memcmp(again.data(), data, size) != 0) std::abort();
  } catch (const BadArtifact&) {
  }
  return 0;
}

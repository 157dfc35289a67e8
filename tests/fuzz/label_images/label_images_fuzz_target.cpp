// One input of the fuzzer: the content of a label image. Whatever is read has a label for every voxel, and a
// closed surface.
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "volume/label_surface.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ballflow::geometry;
  const std::vector<char> content(data, data + size);
  try {
    const LabelVolume volume = parse_label_volume({content.data(), content.size()});
    const auto voxels = static_cast<std::size_t>(volume.size[0] * volume.size[1] * volume.size[2]);
    if (volume.labels.size() != voxels) std::abort();
    const TriangleMesh mesh = label_surface(volume);
    if (!broken_invariant(mesh).empty() || !mesh_topology(mesh).closed) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}

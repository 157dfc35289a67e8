// One input of the fuzzer: a byte that names the format, then the content of a mesh file. Whatever is read is
// whole.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/read_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ballflow::geometry;
  if (size == 0) return 0;
  constexpr MeshFormat formats[] = {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl,
                                    MeshFormat::xyz};
  // A copy of exact size: a sanitizer sees every byte read beyond its end.
  const std::vector<char> content(data + 1, data + size);
  try {
    const MeshFile file = parse_mesh({content.data(), content.size()}, formats[data[0] % 5]);
    if (!broken_invariant(file.points).empty() || !broken_invariant(file.mesh).empty()) std::abort();
    if (file.points.points.size() + file.mesh.triangles.size() > content.size()) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}

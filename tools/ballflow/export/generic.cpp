// What every artifact can be written as.
#include "ballflow/node_decl.hpp"
#include "export/format_table.hpp"

namespace ballflow {
namespace {

void write_json(const Artifact& artifact, OutputFile& out) {
  Json arrays = Json::array();
  for (const NamedArray& array : artifact.arrays()) {
    arrays.push_back({{"name", array.name}, {"dtype", dtype_name(array.dtype)}, {"shape", array.shape}});
  }
  const Json text = {{"type", artifact.type()},
                     {"version", artifact.version()},
                     {"digest", artifact.digest().hex()},
                     {"summary", Json::parse(artifact.summary())},
                     {"arrays", std::move(arrays)}};
  out << std::string_view(text.dump(2)) << '\n';
}

void write_safetensors(const Artifact& artifact, OutputFile& out) {
  for (const auto piece : artifact.pieces()) out.write(piece.data(), piece.size());
}

}  // namespace

std::vector<Format> generic_formats() { return {{"json", write_json}, {"safetensors", write_safetensors}}; }

}  // namespace ballflow

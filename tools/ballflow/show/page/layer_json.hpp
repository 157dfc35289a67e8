// Layers as a page holds them: arrays in blocks, everything else in JSON.
#pragma once

#include <vector>

#include "ballflow/node_decl.hpp"
#include "show/page/blocks.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

/// {"name", "shape", "count", "centre", "lower", "upper", "vertices", "radii", "segments", "triangles",
/// "attributes", "colour_by", "opacity", "visible"}; arrays are numbers of blocks. Vertices are floats
/// relative to "centre", which is a double: models far from the origin lose nothing. A layer that moves has
/// "chain", the place of its chain in `chains`, to which it is added where it is not there yet, and "frames".
Json layer_json(const Layer& layer, Blocks& blocks, Json& chains);

/// Bytes of the arrays of layers before they are compressed.
std::size_t raw_bytes(const std::vector<Layer>& layers);

}  // namespace ballflow::show

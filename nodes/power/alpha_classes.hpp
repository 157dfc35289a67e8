// Which simplices of a regular triangulation belong to the weighted zero alpha-shape, and of which class they
// are. The notation is that of alpha_shape.hpp.
#pragma once

#include "base/array.hpp"
#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "power/regular_cells.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// The complex of the balls |x - centers[i]|^2 <= weights[i], whose regular triangulation is `cells`, with
/// classes of simplices and Betti numbers; `delta` is left 0. Decisions are exact. Weights are not negative.
SimplicialComplex alpha_classes(const RegularCells& cells, const Array<Vec3>& centers,
                                const Array<double>& weights, Monitor& monitor);

}  // namespace ballflow::geometry

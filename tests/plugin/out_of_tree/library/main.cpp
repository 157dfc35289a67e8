// The algorithms as a C++ library, without the engine: three balls in a row, of which two meet.
#include <cstdio>

#include "power/alpha_shape.hpp"

int main() {
  using namespace ballflow::geometry;
  const Balls balls{{{0, 0, 0}, {1.5, 0, 0}, {9, 0, 0}}, {1.0, 1.0, 1.0}, {}, {}};
  const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
  std::printf("%zu edge, %lld components\n", complex.edges.size(), static_cast<long long>(complex.betti[0]));
  return complex.edges.size() == 1 && complex.betti[0] == 2 ? 0 : 1;
}

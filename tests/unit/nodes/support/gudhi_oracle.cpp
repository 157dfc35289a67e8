#include "gudhi_oracle.hpp"

#include <gudhi/Alpha_complex_3d.h>
#include <gudhi/Persistent_cohomology.h>
#include <gudhi/Simplex_tree.h>

#include <algorithm>
#include <map>

namespace ballflow::test {

GudhiComplex gudhi_complex(std::span<const geometry::Vec3> centers, std::span<const double> weights) {
  using Complex =
      Gudhi::alpha_complex::Alpha_complex_3d<Gudhi::alpha_complex::complexity::EXACT, true, false>;
  std::vector<Complex::Weighted_point_3> points;
  std::map<geometry::Vec3, std::size_t> names;  // GUDHI numbers vertices in its own way
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const geometry::Vec3 c = centers[i];
    points.emplace_back(Complex::Bare_point_3(c.x, c.y, c.z), weights[i]);
    const auto [name, fresh] = names.emplace(c, i);
    if (!fresh && weights[i] > weights[name->second]) name->second = i;
  }
  Complex alpha(points);
  Gudhi::Simplex_tree<> tree;
  alpha.create_complex(tree);
  tree.prune_above_filtration(0.0);

  GudhiComplex result;
  for (const auto& simplex : tree.complex_simplex_range()) {
    std::vector<std::int32_t> ids;
    for (const auto& vertex : tree.simplex_vertex_range(simplex)) {
      const auto& p = alpha.get_point(static_cast<std::size_t>(vertex));
      ids.push_back(static_cast<std::int32_t>(
          names.at({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())})));
    }
    std::sort(ids.begin(), ids.end());
    result.simplices.push_back(std::move(ids));
    tree.assign_filtration(simplex, 0.0);
  }
  std::sort(result.simplices.begin(), result.simplices.end());

  tree.initialize_filtration();
  Gudhi::persistent_cohomology::Persistent_cohomology<Gudhi::Simplex_tree<>,
                                                      Gudhi::persistent_cohomology::Field_Zp>
      cohomology(tree, true);
  cohomology.init_coefficients(2);
  cohomology.compute_persistent_cohomology(-1);
  for (int k = 0; k < 3; ++k) result.betti[static_cast<std::size_t>(k)] = cohomology.betti_number(k);
  return result;
}

}  // namespace ballflow::test

#include "export/scaled.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ballflow/error.hpp"

namespace ballflow {
namespace {

struct Lengths {
  std::string_view type;
  std::vector<std::string_view> arrays;
};

const std::vector<Lengths>& lengths_of_types() {
  static const std::vector<Lengths> types = {{"Balls", {"centers", "radii"}},
                                             {"Ellipsoids", {"centers", "radii"}},
                                             {"Growth", {"centers", "radii", "grown_radii", "limits"}},
                                             {"MedialAxis", {"vertices", "radii"}},
                                             {"PointSet", {"points"}},
                                             {"PoleSet", {"centers", "radii"}},
                                             {"Polygon2", {"vertices"}},
                                             {"TriangleMesh", {"vertices"}}};
  return types;
}

}  // namespace

ArtifactPtr scaled(const ArtifactPtr& artifact, double factor) {
  const auto lengths = std::find_if(lengths_of_types().begin(), lengths_of_types().end(),
                                    [&](const Lengths& entry) { return entry.type == artifact->type(); });
  if (lengths == lengths_of_types().end()) {
    std::string types;
    for (const Lengths& entry : lengths_of_types())
      types.append(types.empty() ? "" : ", ").append(entry.type);
    throw Error(ExitCode::usage, "--scale: a " + artifact->type() + " is not scaled",
                "types that are: " + types);
  }
  struct Kept {
    ArtifactPtr artifact;
    std::vector<std::vector<double>> numbers;
  };
  const auto kept = std::make_shared<Kept>();
  kept->artifact = artifact;
  kept->numbers.reserve(lengths->arrays.size());
  std::vector<NamedArray> arrays = artifact->arrays();
  for (NamedArray& array : arrays) {
    if (std::find(lengths->arrays.begin(), lengths->arrays.end(), array.name) == lengths->arrays.end())
      continue;
    const auto* const first = static_cast<const double*>(array.data);
    std::vector<double> numbers(first, first + array.elements());
    for (double& x : numbers) {
      const bool finite = std::isfinite(x);  // limits of growth need not be
      x *= factor;
      if (finite && !std::isfinite(x)) {
        throw Error(ExitCode::usage, "--scale: a number of " + array.name + " becomes too large",
                    "take a smaller one");
      }
    }
    kept->numbers.push_back(std::move(numbers));
    array.data = kept->numbers.back().data();
  }
  return Artifact::seal(artifact->type(), artifact->version(), std::move(arrays), artifact->summary(), kept);
}

}  // namespace ballflow

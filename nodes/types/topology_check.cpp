#include "types/topology_check.hpp"

namespace ballflow::geometry {

std::string describe(const InclusionHomology& inclusion) {
  std::string text;
  constexpr const char* one[] = {"component", "tunnel", "cavity"};
  constexpr const char* many[] = {"components", "tunnels", "cavities"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto say = [&](std::int64_t n, const char* what) {
      if (n == 0) return;
      text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + (n == 1 ? one[k] : many[k]) +
              (n == 1 ? " is " : " are ") + what;
    };
    say(inclusion.whole[k] - inclusion.rank[k], "lost");
    say(inclusion.part[k] - inclusion.rank[k], "extra");
  }
  return text.empty() ? "the inclusion is an isomorphism" : text;
}

std::string describe(const TopologyCheck& check) {
  const std::string wrong = describe(check.inclusion_before());
  if (check.inclusion_before().isomorphism()) return wrong;
  std::string text = wrong + ": " + std::to_string(check.returned) +
                     (check.returned == 1 ? " ball" : " balls") + " returned to " +
                     std::to_string(check.kept);
  if (!check.inclusion_after().isomorphism()) text += ", and still " + describe(check.inclusion_after());
  if (check.everything != 0) text += ", which are all there are: nothing less had the right topology";
  return text;
}

std::string broken_invariant(const TopologyCheck& check) {
  if (check.kept < 0 || check.returned < 0 || check.inclusions < 0) return "a number of balls is negative";
  if (check.everything > 1) return "everything is " + std::to_string(check.everything) + ", not 0 or 1";
  for (const InclusionHomology& h : {check.inclusion_before(), check.inclusion_after()}) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (h.rank[k] < 0 || h.rank[k] > h.part[k] || h.rank[k] > h.whole[k]) {
        return "a map from dimension " + std::to_string(h.part[k]) + " to dimension " +
               std::to_string(h.whole[k]) + " has rank " + std::to_string(h.rank[k]);
      }
    }
  }
  return {};
}

}  // namespace ballflow::geometry

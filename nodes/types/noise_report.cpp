#include "types/noise_report.hpp"

namespace ballflow::geometry {

const char* name(NoiseVerdict verdict) {
  switch (verdict) {
    case NoiseVerdict::clean:
      return "clean";
    case NoiseVerdict::sharp_edges:
      return "sharp edges";
    case NoiseVerdict::noisy:
      return "noisy";
    case NoiseVerdict::denoised:
      return "denoised";
    case NoiseVerdict::too_noisy:
      return "too noisy";
    case NoiseVerdict::left:
      return "left as it is";
  }
  return "";
}

std::string broken_invariant(const NoiseReport& report) {
  if (report.verdict > static_cast<std::uint8_t>(NoiseVerdict::left))
    return "there is no verdict " + std::to_string(report.verdict);
  if (!(report.uncertain >= 0 && report.uncertain <= 1)) return "uncertain is no share";
  if (!(report.coarseness >= 0)) return "coarseness is negative";
  if (!(report.level >= 0)) return "level is negative";
  if (report.neighbors < 0 || report.next < 0) return "a number of neighbours is negative";
  return {};
}

}  // namespace ballflow::geometry

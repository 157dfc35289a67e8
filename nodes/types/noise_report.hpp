// How noisy a cloud of points is, and what was done about it.
#pragma once

#include <cstdint>
#include <string>

namespace ballflow::geometry {

enum class NoiseVerdict : std::uint8_t {
  clean,        // the poles know inside from outside
  sharp_edges,  // they do not, but the samples lie on smooth patches: smoothing would not help
  noisy,        // the samples are to be moved
  denoised,     // they were, and the poles know now
  too_noisy,    // they were, and the poles still do not know: what helped most was taken
  left,         // noisy, but nothing was to be done
};
const char* name(NoiseVerdict verdict);

struct NoiseReport {
  double uncertain = 0;   // share of the poles whose label says little
  double coarseness = 0;  // median over the samples: distance to the third neighbour, times 1 / D^
  // The tenth percentile over the samples of the deviation of their neighbours from a quadric, times 1 /
  // distance to the third neighbour; 0 where nobody asked. Of the cloud as it came.
  double level = 0;
  std::int32_t neighbors = 0;  // with so many the samples were denoised; 0: they are as they came
  std::int32_t next = 0;       // with so many they are to be denoised next; 0: nothing is left to do
  std::uint8_t verdict = 0;    // a NoiseVerdict
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const NoiseReport& report);

}  // namespace ballflow::geometry

// A grid of labels in space: segmented images of medicine.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct LabelVolume {
  std::array<std::int64_t, 3> size{};  // voxels along the three axes of the grid, each at least 1
  Vec3 origin;                         // the center of voxel (0, 0, 0), in the units of the file
  std::array<Vec3, 3> steps;           // from a voxel to the next one along each axis; they span space
  std::vector<std::int32_t> labels;    // of voxel (i, j, k) at (k size[1] + j) size[0] + i; 0: nothing

  Vec3 place(Vec3 voxel) const {
    return origin + voxel.x * steps[0] + voxel.y * steps[1] + voxel.z * steps[2];
  }
};

/// Reads NRRD (header and data in one file; encodings raw, gzip and ascii) and NIfTI-1 (.nii, one file), each
/// also packed with gzip or zstd. The content says which one it is. What is taken:
///   - three dimensions; more where their size is 1
///   - integers of 8, 16 and 32 bits of both byte orders, and floating numbers that are whole
///   - NRRD: space directions and space origin, else spacings, else 1. NIfTI: the sform, else the qform, else
///     pixdim; slope and intercept. Coordinates are those that the file means: NIfTI's x points to the right,
///     y to the front and z up; those of NRRD are in its `space`, often left, back and up.
///
/// Throws InputError for other formats (DICOM, MetaImage, Analyze, MINC, NIfTI of two files, NIfTI-2, NRRD
/// with detached data) by their names, for files that are cut off or damaged, axes that span no space,
/// numbers that are no labels, and more than 2^31 - 1 voxels. Memory stays proportional to the size of the
/// unpacked content.
LabelVolume read_label_volume(const std::string& path, Monitor& monitor = no_monitor());
LabelVolume parse_label_volume(std::string_view content, Monitor& monitor = no_monitor());

/// The labels that occur, but for 0, ascending: at most `most` of them.
std::vector<std::int32_t> labels_in(const LabelVolume& volume, std::size_t most);

}  // namespace ballflow::geometry

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

/// The frame that all images are brought to which say where the patient is: x grows to the right of the
/// patient, y to the front, z to the head (RAS+), millimetres.
inline constexpr const char* patient_frame = "right, front, head of the patient";

struct LabelVolume {
  std::array<std::int64_t, 3> size{};  // voxels along the three axes of the grid, each at least 1
  Vec3 origin;                         // the center of voxel (0, 0, 0), millimetres where the unit is known
  std::array<Vec3, 3> steps;           // from a voxel to the next one along each axis; they span space
  // What the axes x, y, z of space are, in words: patient_frame, or why that is not known.
  std::string frame = "the axes of the grid";
  std::vector<std::int32_t> labels;  // of voxel (i, j, k) at (k size[1] + j) size[0] + i; 0: nothing

  Vec3 place(Vec3 voxel) const {
    return origin + voxel.x * steps[0] + voxel.y * steps[1] + voxel.z * steps[2];
  }
};

/// Reads NRRD (header and data in one file; encodings raw, gzip and ascii) and NIfTI-1 (.nii, one file), each
/// also packed with gzip or zstd. The content says which one it is. What is taken:
///   - three dimensions; more where their size is 1
///   - integers of 8, 16 and 32 bits of both byte orders, and floating numbers that are whole
///   - NRRD: space directions and space origin, else spacings, else 1. NIfTI: the sform, else the qform, else
///     pixdim; slope and intercept
///
/// One image in both formats lies in one place, in patient_frame: NRRD images whose `space` is
/// left-posterior-superior or left-anterior-superior are turned, signs of x and y and of x; NIfTI is in that
/// frame by its definition. Metres, centimetres, micrometres and nanometres become millimetres (NRRD `space
/// units`, NIfTI xyzt_units), other and missing units stay. Other spaces of NRRD, and images with spacings
/// alone, keep the axes that they have, and `frame` says so.
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

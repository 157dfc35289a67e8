#include "volume/label_surface.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

/// A ball of radius 7 in a grid of 17 x 17 x 17 voxels, label 1.
LabelVolume ball_volume() {
  constexpr std::int64_t n = 17, r = 7;
  LabelVolume volume;
  volume.size = {n, n, n};
  volume.steps = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::int64_t z = 0; z < n; ++z)
    for (std::int64_t y = 0; y < n; ++y)
      for (std::int64_t x = 0; x < n; ++x) {
        const std::int64_t a = x - n / 2, b = y - n / 2, c = z - n / 2;
        volume.labels.push_back(a * a + b * b + c * c <= r * r ? 1 : 0);
      }
  return volume;
}

struct LabelSurface {
  Out<PointSet> points;
  Out<TriangleMesh> mesh;
  std::string file;
  LabelSurfaceOptions options;

  static void declare(NodeDecl<LabelSurface>& d) {
    d.id("LabelSurface", 2).summary("The closed surface of a label in a segmented image.");
    d.doc(
        "Reads NRRD (header and data in one file) and NIfTI-1 (.nii), also packed with gzip or zstd, and "
        "makes the mesh that separates voxels with the label from the others: closed, manifold, outward "
        "oriented. One image in both formats has one place: x to the right of the patient, y to the front, z "
        "to the head (RAS+), millimetres; NRRD images in another space of patients are turned. Where the "
        "file "
        "does not say where the patient is, its axes stay, and the field frame of the summary tells. "
        "Vertices lie halfway between centers of "
        "voxels; nothing is smoothed. Refuses other formats (DICOM, MetaImage, Analyze, NIfTI-2) by their "
        "names, "
        "damaged files, values that are no whole numbers, and a label that is not there, with those that "
        "are.");
    d.avoid_when("the image has grey values: threshold or segment it before.");
    d.cites("kornberger2010", "6.3.1");
    d.memory(std::uint64_t{256} << 20, 0);
    d.output("points", &LabelSurface::points).doc("the vertices of the mesh");
    d.output("mesh", &LabelSurface::mesh).doc("the surface, in millimetres where the file has a unit");
    d.param("file", &LabelSurface::file)
        .file()
        .scheme("labels:")
        .required()
        .doc("a label image (.nrrd, .nii, .nii.gz), or labels:ball for a generated one");
    d.param("label", &LabelSurface::options, &LabelSurfaceOptions::label)
        .unit("label")
        .doc("the surface of the voxels with this value; 0: of all that are not 0");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (file.starts_with("labels:") && file != "labels:ball") {
      throw InputError("there is no image \"" + file + "\"", "name a file, or labels:ball");
    }
    const LabelVolume volume = file == "labels:ball" ? ball_volume() : read_label_volume(file, monitor);
    TriangleMesh surface = label_surface(volume, options, monitor);
    mesh.summary("frame", volume.frame);
    points = PointSet{surface.vertices, {}};
    mesh = std::move(surface);
  }
};

}  // namespace

const bf_node* label_surface_entry() { return node_entry<LabelSurface>(); }

}  // namespace ballflow::nodes

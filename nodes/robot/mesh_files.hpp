// Where the mesh files of a robot are.
#pragma once

#include <string>
#include <vector>

namespace ballflow::geometry {

struct MeshPlaces {
  std::string folder;                 // of the URDF
  std::vector<std::string> packages;  // folders in which packages are, or which are packages themselves
};

/// Folders in a text, separated by colons.
std::vector<std::string> folders_in(const std::string& text);

/// A mesh file: where it is, and whether that is where its name says.
struct MeshPlace {
  std::string path;  // empty: nowhere
  bool as_named = true;
};

/// Looks for the mesh `name` of a URDF.
///
/// - "package://p/rest" and "model://p/rest": in the folders `packages`, in those above the URDF, then in
/// those of
///   ROS_PACKAGE_PATH and, below share, of AMENT_PREFIX_PATH: folder/p/rest, or folder/rest where the folder
///   is called p.
/// - "file:///path", an absolute path, or one relative to the folder of the URDF.
/// - What is not there is looked for below the folder of the URDF and below `packages` by its file name, also
/// packed
///   (.gz, .zst), then by its name with another ending that is read (stl, obj, dae, ...). Of several that are
/// found the first
///   one, nearest to the top, then by name. At most 20 000 files are looked at.
MeshPlace find_mesh(const std::string& name, const MeshPlaces& places);

}  // namespace ballflow::geometry

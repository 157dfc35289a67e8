// Artifacts as files that other programs read.
//
// clang-format off
//   PointSet           ply xyz csv off vtp npy glb
//   TriangleMesh       ply obj off stl vtp glb
//   Balls              ply csv obj vtp npy glb ma sph yaml urdf svg   svg: as seen from above
//   Ellipsoids         ply csv obj stl vtp npy glb   obj and stl: triangles
//   PoleSet            ply csv vtp npy glb           label: 0 unlabelled, 1 inner, 2 outer
//   LocalFeatureSize   csv ply vtp npy glb           radius: D^, the distance to the nearest pole
//   Growth             csv ply vtp npy glb           grown balls; stop: 0 wish, 1 poles, 2 Gabriel, 3 common
//   SimplicialComplex  ply obj off stl vtp glb ma csv npy
//   MedialAxis         ply obj off stl vtp glb ma csv npy
//   CoverState         json scp lp csv               matrix as OR-Library and LP files, choices as csv
//   SampleAssignment   csv ply vtp glb               vertex (or ball): which one each sample belongs to
//   SurfaceReport      json ply vtp glb              evidence: 0 alpha-shape, 1 closes a gap, 2 a hole,
//                                                    3 contradicted by poles; ply also with colours
//   RobotSpheres       urdf srdf curobo xrdf foam mjcf csv   yml is curobo, xml is mjcf
//   Polygon2           svg geojson wkt poly2d ply obj vtp glb
//   DiscOutline        svg csv                     arcs as they are
//   BallDistance       csv ply obj vtp             the nearest pair, and those below the threshold
//   Path               csv ply obj vtp npy         points with radii; PathBalls reads the csv
//   Way                csv ply obj vtp npy         radius: the clearance of each point
//   MatchedBalls       csv ply vtp npy             partner: 0 none, 1 shared, 2 its own
//   ShapePrior         safetensors csv ply vtp npy   csv: scores of the instances; else the balls of the mean
//   ShapeFit           json csv ply vtp npy       the fitted balls
//   every type         json safetensors              summary and shapes; the artifact, byte for byte
// clang-format on
//
// The first format of a line is the default; it is json where there is no other. formats.hpp says what each
// has room for: only ply, vtp, ma, sph, csv, npy, yaml, urdf and svg keep radii, only ply, obj, vtp, glb and
// ma edges. A SimplicialComplex is written without interior triangles and without sides of triangles, which
// cannot be seen, except in ma.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballflow/artifact.hpp"

namespace ballflow {

/// The formats of an artifact type, the default first. Types of foreign plugins have the generic ones.
std::vector<std::string> export_formats(std::string_view type);
inline std::vector<std::string> export_formats(const Artifact& artifact) {
  return export_formats(artifact.type());
}

/// The types that have formats of their own.
std::vector<std::string> exported_types();

/// The extension of files of a format.
std::string extension_of(std::string_view type, std::string_view format);

std::string default_format(std::string_view type);

/// Writes `artifact` to `path`; a reader sees the whole file or what was there before. An empty `format` is
/// taken from the extension of `path`. Throws Error: usage when the type has no such format, store when the
/// arrays break the type or the file cannot be written.
void export_artifact(const Artifact& artifact, const std::string& path, const std::string& format = {});

}  // namespace ballflow

// Artifacts as files that other programs read.
//
//   PointSet           ply xyz csv off        vertices, normals where there are any (not in off)
//   TriangleMesh       ply obj off stl
//   Balls              ply csv obj            radius as a vertex property (ply) or column (csv); obj: centers
//   PoleSet            ply csv                radius and label (0 unlabelled, 1 inner, 2 outer)
//   CoverState         json scp lp           what is left of the matrix: OR-Library, LP format
//   SimplicialComplex  ply obj off            triangles that are not interior, edges in no triangle (not in
//   off) MedialAxis         ply obj off            polygons, edges that bound none (not in off), radii (ply)
//   every type         json safetensors       type, summary and shapes; the artifact itself, byte for byte
//
// The first format of a line is the default; it is json where there is no other. ply is binary
// little-endian with doubles, stl is binary with floats, text files hold the shortest decimals that give
// the doubles back.
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

std::string default_format(std::string_view type);

/// Writes `artifact` to `path`; a reader sees the whole file or what was there before. An empty `format` is
/// taken from the extension of `path`. Throws Error: usage when the type has no such format, store when the
/// arrays break the type or the file cannot be written.
void export_artifact(const Artifact& artifact, const std::string& path, const std::string& format = {});

}  // namespace ballflow

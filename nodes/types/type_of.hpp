// Which structs of nodes/types are types of artifacts; <type>.type.cpp declares how each one travels on
// edges.
#pragma once

#include <ballflow/sdk/type.hpp>

namespace ballflow::geometry {
struct PointSet;
struct TriangleMesh;
struct PoleSet;
struct Balls;
struct Growth;
struct LocalFeatureSize;
struct CoverState;
struct Bisection;
struct CoverCheck;
struct Comparison;
struct MassProperties;
struct MeshReport;
struct MinkowskiReport;
struct Refinement;
struct SimplicialComplex;
struct SurfaceReport;
struct TopologyCheck;
struct TopologyTable;
struct MedialAxis;
}  // namespace ballflow::geometry

namespace ballflow {

template <>
struct TypeOf<geometry::PointSet> {
  static void declare(TypeDecl<geometry::PointSet>& d);
};

template <>
struct TypeOf<geometry::TriangleMesh> {
  static void declare(TypeDecl<geometry::TriangleMesh>& d);
};

template <>
struct TypeOf<geometry::PoleSet> {
  static void declare(TypeDecl<geometry::PoleSet>& d);
};

template <>
struct TypeOf<geometry::Balls> {
  static void declare(TypeDecl<geometry::Balls>& d);
};

template <>
struct TypeOf<geometry::Growth> {
  static void declare(TypeDecl<geometry::Growth>& d);
};

template <>
struct TypeOf<geometry::LocalFeatureSize> {
  static void declare(TypeDecl<geometry::LocalFeatureSize>& d);
};

template <>
struct TypeOf<geometry::CoverState> {
  static void declare(TypeDecl<geometry::CoverState>& d);
};

template <>
struct TypeOf<geometry::Bisection> {
  static void declare(TypeDecl<geometry::Bisection>& d);
};

template <>
struct TypeOf<geometry::CoverCheck> {
  static void declare(TypeDecl<geometry::CoverCheck>& d);
};

template <>
struct TypeOf<geometry::Comparison> {
  static void declare(TypeDecl<geometry::Comparison>& d);
};

template <>
struct TypeOf<geometry::MassProperties> {
  static void declare(TypeDecl<geometry::MassProperties>& d);
};

template <>
struct TypeOf<geometry::MeshReport> {
  static void declare(TypeDecl<geometry::MeshReport>& d);
};

template <>
struct TypeOf<geometry::MinkowskiReport> {
  static void declare(TypeDecl<geometry::MinkowskiReport>& d);
};

template <>
struct TypeOf<geometry::Refinement> {
  static void declare(TypeDecl<geometry::Refinement>& d);
};

template <>
struct TypeOf<geometry::SimplicialComplex> {
  static void declare(TypeDecl<geometry::SimplicialComplex>& d);
};

template <>
struct TypeOf<geometry::SurfaceReport> {
  static void declare(TypeDecl<geometry::SurfaceReport>& d);
};

template <>
struct TypeOf<geometry::TopologyCheck> {
  static void declare(TypeDecl<geometry::TopologyCheck>& d);
};

template <>
struct TypeOf<geometry::TopologyTable> {
  static void declare(TypeDecl<geometry::TopologyTable>& d);
};

template <>
struct TypeOf<geometry::MedialAxis> {
  static void declare(TypeDecl<geometry::MedialAxis>& d);
};

}  // namespace ballflow

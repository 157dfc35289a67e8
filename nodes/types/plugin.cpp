// Every artifact type of ballflow; the families' own libraries declare nodes only.
#include <ballflow/sdk/library.hpp>

#include "types/ellipsoid_types.hpp"
#include "types/enclosure_fit_type.hpp"
#include "types/enclosure_type.hpp"
#include "types/motion_types.hpp"
#include "types/planar_types.hpp"
#include "types/power_diagram_type.hpp"
#include "types/prior_types.hpp"
#include "types/robot_type.hpp"
#include "types/shape_types.hpp"
#include "types/surface_types.hpp"

using namespace ballflow::geometry;

BALLFLOW_PLUGIN(
    "types", "0.1.0", ballflow::node_entries<>(),
    (ballflow::type_entries<BallCounts, BallDistance, Balls, Bisection, Comparison, CoverCheck, CoverState,
                            DiscOutline, Ellipsoids, Enclosure, EnclosureFit, Growth, LocalFeatureSize,
                            MassProperties, MatchedBalls, MedialAxis, MeshReport, MinkowskiReport,
                            NoiseReport, OutlineComparison, Path, PointSet, PoleSet, Polygon2, PowerDiagram,
                            Refinement, Robot, RobotSpheres, SampleAssignment, Scaling, ShapeFit, ShapePose,
                            ShapePrior, SimplicialComplex, SurfaceBallsReport, SurfaceReport, TopologyCheck,
                            TopologyTable, TriangleMesh, Way>()))

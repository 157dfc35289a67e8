"""The node types, for help()."""
# Written by tools/python/make_stubs from the declarations of nodes and types.

from typing import Any

class NodeType:
    declaration: Any

class Align(NodeType):
    """Where a shape lies on another one of its kind, from samples without labels."""
    ...

class AllocateBalls(NodeType):
    """Hand out a number of balls to several objects, so that together they waste little volume."""
    ...

class AlphaShape(NodeType):
    """The weighted zero alpha-shape of balls: the dual complex of their union."""
    ...

class ApplyScaling(NodeType):
    """Stretch points and a mesh, or bring them back to their own space."""
    ...

class AssessNoise(NodeType):
    """Decide whether a cloud is to be denoised, and with how many neighbours."""
    ...

class AssignSamples(NodeType):
    """Tell which vertex of a surface every sample belongs to."""
    ...

class BallCount(NodeType):
    """The number of balls of one object."""
    ...

class BallMesh(NodeType):
    """A closed triangle mesh of the boundary of a union of balls."""
    ...

class Bisect(NodeType):
    """Search for the growth with which a given number of balls is enough."""
    ...

class BisectError(NodeType):
    """Search for the growth with which the error of balls is what is allowed."""
    ...

class ChooseTemplate(NodeType):
    """Which of several shapes stands for all of them."""
    ...

class Compare(NodeType):
    """Measure how far a union of balls is from a surface."""
    ...

class CompareEllipsoids(NodeType):
    """Measure how far a union of ellipsoids is from a surface."""
    ...

class CompareOutlines(NodeType):
    """The difference of two polygons: areas, and distances of their boundaries."""
    ...

class CoverMatrix(NodeType):
    """Find out which ball covers which sample."""
    ...

class CoverPoints(NodeType):
    """Say what the balls have to cover: the samples, or more of the surface."""
    ...

class Denoise(NodeType):
    """Move noisy samples onto quadrics through their neighbours."""
    ...

class DiscPoles(NodeType):
    """The discs of a polygon: Voronoi vertices of its boundary, inside and outside."""
    ...

class DiscUnionOutline(NodeType):
    """The outline of a union of discs: its arcs, and a polygon in it."""
    ...

class Distance(NodeType):
    """How far two unions of balls are apart, or how deep they overlap."""
    ...

class EllipsoidMatrix(NodeType):
    """Find out which ellipsoid covers which sample."""
    ...

class EncloseBalls(NodeType):
    """A given number of balls that contain a surface and all inside it, with little volume outside."""
    ...

class Enlarge(NodeType):
    """Grow radii so that pruning may drop small features."""
    ...

class FindWay(NodeType):
    """Whether there is a way between two points around a union of balls, and one."""
    ...

class Greedy(NodeType):
    """Choose the ball that covers most of what is left."""
    ...

class IPSolve(NodeType):
    """Solve independent parts of a covering matrix exactly."""
    ...

class InsideBalls(NodeType):
    """A given number of balls inside a solid that cover as much of it as they can."""
    ...

class LabelPoles(NodeType):
    """Tell inner from outer poles: the discrete medial axis transform of a solid."""
    ...

class LabelSurface(NodeType):
    """The closed surface of a label in a segmented image."""
    ...

class LagrangianBound(NodeType):
    """Prove how many balls any cover needs, with a certificate."""
    ...

class LinkBalls(NodeType):
    """The balls of one link of a robot, in the frame of the link."""
    ...

class LoadBalls(NodeType):
    """Reads balls, or a medial axis, that another program or an export wrote."""
    ...

class LoadCover(NodeType):
    """Read a set covering instance of the literature."""
    ...

class LoadRobotSpheres(NodeType):
    """Reads collision spheres that another program made for a robot."""
    ...

class LocalFeatureSize(NodeType):
    """Estimate at every sample how far the medial axis is."""
    ...

class LocalSearch(NodeType):
    """Cover what is left by few balls: greedy, then local search."""
    ...

class Match(NodeType):
    """The balls and surface points of a template, found again on another shape."""
    ...

class MedialAxis(NodeType):
    """The medial axis of a union of balls as a polygon complex."""
    ...

class MinimalUnion(NodeType):
    """Drops balls that others cover: the union stays, and none of the rest can go."""
    ...

class MinkowskiSum(NodeType):
    """The Minkowski sum of two unions of balls: again a union of balls."""
    ...

class MinkowskiSum2(NodeType):
    """The Minkowski sum of two unions of discs: again a union of discs."""
    ...

class Mirror(NodeType):
    """Balls mirrored at the origin: every center c becomes -c."""
    ...

class OneSidedBalls(NodeType):
    """Give balls other radii, so that they lie inside a solid, or contain it."""
    ...

class PathBalls(NodeType):
    """A polyline as balls, so that a Minkowski sum moves something along it."""
    ...

class PolygonMeshes(NodeType):
    """Triangles that tile a polygon, and a prism over it."""
    ...

class PowerDiagram(NodeType):
    """The power diagram of balls, by its dual: made once, for all that look at their union."""
    ...

class PrincipalScaling(NodeType):
    """Axes and factors that make thin directions of an object thick."""
    ...

class ProtrudeBalls(NodeType):
    """A given number of balls that stand out of a solid by no more than a distance, and cover as much as they
      can.
    """
    ...

class ReadPolygon(NodeType):
    """Reads polygons in the plane, with holes and in several parts, or makes them."""
    ...

class ReadRobot(NodeType):
    """Reads a robot from its URDF: links with their surfaces, and joints."""
    ...

class Reduce(NodeType):
    """Remove dominated balls, dominating samples and essential balls; the optimum stays."""
    ...

class Refine(NodeType):
    """Choose samples of a closed surface that are dense where its shape asks for it."""
    ...

class RestoreSamples(NodeType):
    """Put a surface through denoised samples back onto the samples."""
    ...

class RobotLink(NodeType):
    """The surface of one link of a robot, in the frame of the link."""
    ...

class RobotSpheres(NodeType):
    """Puts the balls of the links of a robot together, and lists pairs that need no test."""
    ...

class Sample(NodeType):
    """Reads a model, or makes one, and samples its surface."""
    ...

class SampleMesh(NodeType):
    """Points spread over the surface of a mesh, with normals."""
    ...

class ScaleBack(NodeType):
    """Balls of a stretched object as ellipsoids of the object, enlarged."""
    ...

class SelectBalls(NodeType):
    """Take the balls that a set cover chose."""
    ...

class SelectEllipsoids(NodeType):
    """Take the ellipsoids that a set cover chose."""
    ...

class Shape(NodeType):
    """Makes a model from a formula, smooth or sharp, of known genus."""
    ...

class ShapeFit(NodeType):
    """The most plausible whole shape of a model for an observation of a part of it."""
    ...

class ShapeInstance(NodeType):
    """An instance of a model of a shape, as balls and as surface points."""
    ...

class ShapeMesh(NodeType):
    """The mesh of an instance or a fit of a model, with the template's triangles."""
    ...

class ShapePrior(NodeType):
    """Learns how a shape varies from several instances of it: mean, modes, and how good they are."""
    ...

class ShareBound(NodeType):
    """Bound any cover from below by the shares of the samples that are left."""
    ...

class SimplifyPolygon(NodeType):
    """Polygons with fewer corners, whose boundary hardly moves."""
    ...

class SolidTopology(NodeType):
    """Components, tunnels and cavities of the solid inside a surface."""
    ...

class SplitComponents(NodeType):
    """One connected component of a mesh."""
    ...

class Subtract(NodeType):
    """Balls less other balls: radii so small that none reaches into the others."""
    ...

class SurfaceBalls(NodeType):
    """Balls around samples, as large as the local feature size allows."""
    ...

class SurfaceMesh(NodeType):
    """A closed surface through the kept samples of a cloud of points."""
    ...

class TemplateBalls(NodeType):
    """The balls of a template as they were before they grew, without tiny ones."""
    ...

class Topology(NodeType):
    """Compare components, tunnels and cavities along a pipeline."""
    ...

class TopologyRepair(NodeType):
    """Return balls whose absence changed the topology of the union."""
    ...

class UnionMeasure(NodeType):
    """Volume, area, centre of mass and inertia tensor of a union of balls."""
    ...

class UnionTopology(NodeType):
    """Components, tunnels and cavities of a union of balls."""
    ...

class VerifyCover(NodeType):
    """Check from geometry that every sample lies in a ball, and that no cover has fewer than proved."""
    ...

class VerifyEllipsoids(NodeType):
    """Check from geometry that every sample lies in an ellipsoid, and that no cover has fewer than proved."""
    ...

class VerifyEnclosure(NodeType):
    """Prove that balls contain everything inside a surface, or tell what they miss."""
    ...

class VoronoiPoles(NodeType):
    """The two poles of every sample: far vertices of its Voronoi cell on either side."""
    ...

class Wrap(NodeType):
    """A closed surface around an open one, so that it has an inside."""
    ...

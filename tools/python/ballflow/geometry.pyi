"""Every node as a function."""
# Written by tools/python/make_stubs from the declarations of nodes and types.

from typing import Any, Literal, Mapping, NamedTuple, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import (
    BallCounts, BallDistance, Balls, Bisection, Comparison, CoverCheck, CoverState, DiscOutline, Ellipsoids,
    Enclosure, EnclosureFit, Growth, LocalFeatureSize, MassProperties, MatchedBalls, MedialAxis, MeshReport,
    MinkowskiReport, NoiseReport, OutlineComparison, Path, PointSet, PoleSet, Polygon2, PowerDiagram,
    Refinement, Robot, RobotSpheres, SampleAssignment, Scaling, ShapeFit, ShapePose, ShapePrior,
    SimplicialComplex, SurfaceBallsReport, SurfaceReport, TopologyCheck, TopologyTable, TriangleMesh, Way,
)
from ._run import Progress
from ._session import Cache, PathLike

# What an artifact is made of: its arrays in order, or by name, or an object of another library.
ArtifactLike = Union[ArrayLike, tuple[ArrayLike, ...], Mapping[str, ArrayLike], Any]
FileLike = Union[PathLike, ArrayLike, tuple[ArrayLike, ArrayLike], Any]

def align(
    points: Union[PointSet, ArtifactLike],
    target: Union[PointSet, ArtifactLike],
    *,
    similarity: bool = True,
    reflections: Literal['refuse', 'allow'] = 'refuse',
    extent: Literal['whole', 'part'] = 'whole',
    keep: float = 1.0,
    sure: float = 1.1,
    alike: float = 0.05,
    points_: int = 1000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ShapePose:
    """Where a shape lies on another one of its kind, from samples without labels.

    Principal axes of both, with all sign choices (and permutations where their lengths are nearly equal),
      then iterated closest points both ways; of all optima the one with the smallest residual, and how much
      worse the second best is. Warns where another pose fits nearly as well, and where the shape is not
      like the target. Refuses fewer than 4 samples, samples in one plane, and shapes that fit clearly
      better mirrored.

    When not to use it: points correspond already (Match refines its own pose), or shapes are turned by a
      symmetry of theirs: no alignment can tell.

    Inputs:
        points (PointSet): n samples of the surface that is to be moved, all over it
        target (PointSet): samples of the surface that it is laid on

    Outputs:
        pose (ShapePose): from the coordinates of points to those of target, residuals, second best

    Parameters:
        similarity (boolean, default true): the scale is free, too; else rotation and translation only
        reflections (choice, default "refuse"): what becomes of mirror images
            refuse: a shape that fits clearly better mirrored is an error
            allow: it is mirrored, left ones among right ones say
        extent (choice, default "whole"): what is moved
            whole: both are whole shapes
            part: points are of a part of the target: nothing is asked of what it lacks
        keep (number, default 1.0, share of pairs, >= 0.3, <= 1.0): the nearest pairs that transforms are
          fitted to; below 1 what only one shape has does not pull, nor does a small feature that tells one
          end from the other
        sure (number, default 1.1, ratio of residuals, >= 1.0, <= 100.0): second best by best, below which
          the pose is called ambiguous, and a mirror image is none
        alike (number, default 0.05, share of the diagonal, >= 0.0, <= 10.0): relative residual above which
          the shape is called another kind than the target; of a part, half of it
        points_ (integer, default 1000, points, >= 50, <= 100000): of each shape; more are thinned evenly

    Sources: besl1992, iterated closest points; chetverikov2002, trimmed; horn1987, the transform of
      labelled pairs
    """
    ...


def allocate_balls(
    fits: Sequence[Union[EnclosureFit, ArtifactLike]] = ...,
    *,
    balls: int = 220,
    minimum: int = 1,
    weights: str = '',
    fixed: str = '',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> BallCounts:
    """Hand out a number of balls to several objects, so that together they waste little volume.

    Of all ways to hand them out one with the least volume outside. That volume is known from fits with a
      few numbers of balls for each object; between them it is taken for linear in 1 / sqrt(k), beyond the
      last one for proportional to that, or for constant where that did not use all its balls: what no
      object can use is not handed out. Small objects get few balls then, and a large part of their volume
      outside: minimum and weights help them.

    When not to use it: there is one object.

    Inputs:
        fits (EnclosureFit, several in order): fits of the first object, with more and more balls wanted,
          then those of the next one: an object begins where no more are wanted than before

    Outputs:
        counts (BallCounts): balls of each object, in the order of the fits

    Parameters:
        balls (integer, default 220, balls, >= 1, <= 1000000): of all objects together
        minimum (integer, default 1, balls, >= 1, <= 5000): at least so many for each object
        weights (string, default ""): how much the volume of each object counts, in their order: 1,2.5,1;
          empty: all the same
        fixed (string, default ""): as many balls for each object, 0 where they are to be found: 24,0,8;
          empty: none is fixed

    Sources: bellman1957, one object after another, with every number of balls
    """
    ...


def alpha_shape(
    balls: Optional[Union[Balls, ArtifactLike]] = None,
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    *,
    tolerance: Literal['none', 'polar'] = 'none',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> SimplicialComplex:
    """The weighted zero alpha-shape of balls: the dual complex of their union.

    Simplices of the regular triangulation of the balls whose smallest orthogonal sphere has a squared
      radius <= 0, decided exactly, with their faces. The complex is homotopy equivalent to the union of the
      closed balls; its Betti numbers are those of the union. Accepts any set of balls: none, flat, nested,
      touching or equal ones; of balls with one center the largest counts, the first of equal ones. Refuses
      radii that are negative or whose square overflows.

    When not to use it: the balls are polar balls that were not enlarged and tolerance is none: rounding
      then decides which of the many balls through a sample touch.

    Inputs:
        balls (Balls, optional): n closed balls, model units; needed where no diagram is connected
        diagram (PowerDiagram, optional): their power diagram, instead of the balls (node PowerDiagram):
          nothing is triangulated again

    Outputs:
        complex (SimplicialComplex): the dual complex over the n balls, with classes and Betti numbers

    Parameters:
        tolerance (choice, default "none"): what is added to squared radii before anything is decided; a
          diagram brings its own
            none: the balls are taken as they are: enlarged or other balls in general position
            polar: 2^-36 of the squared longest bounding-box edge is added to every squared radius, so that
              polar balls through one sample overlap whatever rounding says; recorded as delta

    Sources: kornberger2010, 2.6; edelsbrunner1995, the union of balls and its dual shape
    """
    ...


class ApplyScalingOutputs(NamedTuple):
    points: PointSet
    mesh: TriangleMesh

def apply_scaling(
    scaling: Union[Scaling, ArtifactLike],
    points: Optional[Union[PointSet, ArtifactLike]] = None,
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    direction: Literal['forth', 'back'] = 'forth',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ApplyScalingOutputs:
    """Stretch points and a mesh, or bring them back to their own space.

    Forth, coordinates are those along the axes of the scaling, from its origin on, times the factors; back
      is the inverse. Order, triangles and which points are equal stay. Refuses points that rounding makes
      equal.

    When not to use it: balls are to be scaled back: that is ScaleBack.

    Inputs:
        scaling (Scaling): of PrincipalScaling
        points (PointSet, optional): points; normals are mapped as normals
        mesh (TriangleMesh, optional): a mesh

    Outputs:
        points (PointSet): the points, none where none were given
        mesh (TriangleMesh): the mesh, without triangles where none was given

    Parameters:
        direction (choice, default "forth"): which way
            forth: to where the object is stretched
            back: to its own space

    Sources: kornberger2010, 6.4
    """
    ...


def assess_noise(
    points: Union[PointSet, ArtifactLike],
    poles: Union[PoleSet, ArtifactLike],
    size: Union[LocalFeatureSize, ArtifactLike],
    before: Optional[Union[NoiseReport, ArtifactLike]] = None,
    *,
    act: bool = True,
    suspect: float = 0.2,
    level: float = 0.07,
    certain: float = 0.05,
    neighbors: int = 24,
    most_neighbors: int = 192,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> NoiseReport:
    """Decide whether a cloud is to be denoised, and with how many neighbours.

    Noise as large as the spacing makes poles uncertain, and so do sharp edges and thin sheets. Where fewer
      than `suspect` of the poles are, nothing is done. Else the distances of neighbours from quadrics tell
      noise, which all samples have, from edges, which leave smooth patches without any. Noisy samples are
      denoised with `neighbors`, then with twice as many, until fewer than `certain` of the poles are
      uncertain; where more neighbours leave more uncertain, with those before. Where the first number is
      enough and twice as many lie within D^, by the median, as in dense clouds, twice as many are taken
      unless poles are uncertain then. In a loop with Denoise: the summary field `done` ends it. Refuses
      poles that were not labelled by angles, and poles and sizes of other samples.

    When not to use it: there are normals or a mesh: labels then do not depend on noise.

    Inputs:
        points (PointSet): the samples as they are now
        poles (PoleSet): their poles, labelled by method angle
        size (LocalFeatureSize): their D^ and third neighbours
        before (NoiseReport, optional): what was said before the samples were denoised; absent for the cloud
          as it came

    Outputs:
        report (NoiseReport): the verdict, and the number of neighbours to try next

    Parameters:
        act (boolean, default true): false: look, but ask for nothing
        suspect (number, default 0.2, share of the poles, >= 0.0, <= 1.0): with fewer uncertain poles the
          cloud is clean
        level (number, default 0.07, times the distance to the third neighbour, >= 0.0, <= 10.0): where the
          tenth percentile of the noise is below it there are edges, and no noise
        certain (number, default 0.05, share of the poles, >= 0.0, <= 1.0): fewer uncertain poles are good
          enough
        neighbors (integer, default 24, samples, >= 8, <= 1000): the first number of neighbours to try
        most_neighbors (integer, default 192, samples, >= 8, <= 1000): no more are tried

    Sources: amentakolluri2000, labels by angles, which say how certain they are; kornberger2010, 4.9.3:
      noise makes D^ small
    """
    ...


def assign_samples(
    balls: Union[Balls, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    surface: Optional[Union[SurfaceReport, ArtifactLike]] = None,
    original: Optional[Union[PointSet, ArtifactLike]] = None,
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> SampleAssignment:
    """Tell which vertex of a surface every sample belongs to.

    Every sample belongs to the ball to which it has the least power, the squared distance to the centre
      less the squared radius; of several balls, compared exactly, to the one with the lowest index. With
      the report of a surface it belongs to a vertex as well, the one of the ball with the least power among
      those whose centre is on the surface: a few kept balls are not. A vertex that is there several times,
      where sheets touch, has its samples at its first copy. Refuses empty sets of balls and reports of
      other balls.

    When not to use it: the nearest vertex is wanted: power prefers large balls.

    Inputs:
        balls (Balls): the kept surface balls
        points (PointSet): n samples
        surface (SurfaceReport, optional): the report of the surface through the balls; without it samples
          belong to balls only
        original (PointSet, optional): the samples as they came, where they were denoised: listed in place
          of points

    Outputs:
        assignment (SampleAssignment): ball and vertex of each sample, in their order

    Sources: kornberger2010, 4.5.3, the list of pointers from samples to vertices
    """
    ...


def ball_count(
    counts: Union[BallCounts, ArtifactLike],
    *,
    object: int = 0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> BallCounts:
    """The number of balls of one object.

    So that what one object gets depends on its own number only, and stays in the cache when others change.

    When not to use it: a number is known beforehand: the parameter balls of EncloseBalls.

    Inputs:
        counts (BallCounts): of several objects

    Outputs:
        count (BallCounts): of one

    Parameters:
        object (integer, default 0, number, >= 0, <= 1000000): which one, from 0 on

    Sources: bellman1957, where the counts come from
    """
    ...


class BallMeshOutputs(NamedTuple):
    mesh: TriangleMesh
    report: MeshReport

def ball_mesh(
    balls: Union[Balls, ArtifactLike],
    *,
    method: Literal['exact', 'grid', 'skin'] = 'exact',
    error: float = 0.2,
    keep_faces: float = 100.0,
    most_faces: int = 20000000,
    self_intersections: bool = True,
    refine_notches: bool = False,
    shrink: float = 0.5,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> BallMeshOutputs:
    """A closed triangle mesh of the boundary of a union of balls.

    The mesh is a closed manifold whose faces look outwards, with one component for every component and
      every cavity of the union, for any balls: none, nested, equal, disjoint, tiny, touching ones, and
      polar balls as they come. The vertices lie on the boundary, no point of the mesh is farther from it
      than was asked for. It does not depend on the order of the balls. Balls that touch are joined. Refuses
      a single point.

    When not to use it: the surface that the balls stand for is at hand and good: the union is only near it.

    Inputs:
        balls (Balls): n closed balls, model units

    Outputs:
        mesh (TriangleMesh): the boundary of their union
        report (MeshReport): how it was made, distance, topology, self-intersections

    Parameters:
        method (choice, default "exact"): how the mesh is made
            exact: from the power diagram: few triangles, the topology decided exactly. Where rounding would
              decide, radii change by at most 1e-6 of the longest edge; where that does not help there is a
              grid
            grid: tetrahedra on the cells of a grid, refined until distance and topology are right or two
              rounds bring nothing, with vertices in the bottoms of notches: ten times the triangles, of
              which few cross
            skin: the skin surface around the balls (CGAL), smooth where spheres meet, for comparison: it
              contains the balls, its topology is that of balls larger by 1 / sqrt(shrink), and `error` does
              not steer it
        error (number, default 0.2, % of the longest bounding-box edge, >= 0.0001, <= 100.0): how far the
          mesh may be from the boundary of the union
        keep_faces (number, default 100.0, % of the triangles, > 0.0, <= 100.0): how many are left by
          collapsing edges (CGAL, Lindstrom and Turk); the mesh stays a closed manifold of the same
          topology, its distance from the union is measured again and may be above `error`
        most_faces (integer, default 20000000, 1, >= 1, <= 1000000000): a mesh of more faces is refused
        self_intersections (boolean, default true): count the pairs of triangles that cross; takes about as
          long as the mesh
        refine_notches (boolean, default false): method grid: refine where vertices in the bottoms of
          notches do not bring these within the error; otherwise the report says how far they are
        shrink (number, default 0.5, 1, >= 0.05, <= 0.95): method skin: towards 1 the boundary of the union,
          the less the more notches and gaps it fills

    Sources: kornberger2010, 2.8; lindstrom1998, keep_faces; edelsbrunner1999, skin; edelsbrunner1995, the
      union of balls and its dual shape
    """
    ...


def bisect(
    search: Optional[Union[Bisection, ArtifactLike]] = None,
    cover: Optional[Union[CoverState, ArtifactLike]] = None,
    *,
    balls: int = 500,
    tolerance: float = 0.02,
    start: float = 0.3,
    largest: float = 100.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Bisection:
    """Search for the growth with which a given number of balls is enough.

    Without inputs, the state of a search that has tried nothing. In a loop, the state after the growth
      `search.value` was tried and `cover` came out: the next growth to try, until done is 1. Then value is
      the smallest growth known to need at most `balls`. Growth changes by factors of 4 until it is known
      from both sides, then by bisection in ratios. Warns when the number of balls jumps over what was asked
      for, and when no growth at all needs fewer. Refuses a cover that is not finished, and fails when the
      largest growth allowed still needs more balls.

    When not to use it: the error matters more than the number of balls: BisectError, or choose epsilon.

    Inputs:
        search (Bisection, optional): the state before; absent at the beginning
        cover (CoverState, optional): a finished cover made with search.value

    Outputs:
        search (Bisection): the state after it

    Parameters:
        balls (integer, default 500, balls, >= 1): never more balls than this
        tolerance (number, default 0.02, fraction of balls, >= 0.0, < 1.0): good enough are balls (1 -
          tolerance) or more; 0 searches until exactly that number is found
        start (number, default 0.3, unit of the growth that is searched, > 0.0): the growth to try first
        largest (number, default 100.0, unit of the growth that is searched, > 0.0): the largest growth
          allowed

    Sources: kornberger2010, 3.5 and 3.6
    """
    ...


def bisect_error(
    points: Union[PointSet, ArtifactLike],
    search: Optional[Union[Bisection, ArtifactLike]] = None,
    enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    *,
    max_error: float = 0.0,
    share: float = 1.0,
    epsilon: float = 0.5,
    tolerance: float = 0.1,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Bisection:
    """Search for the growth with which the error of balls is what is allowed.

    Without search and enclosure, the state of a search that has tried nothing; with max_error 0 one that is
      done, with the growth epsilon. In a loop, the state after the growth `search.value` was tried and the
      balls that came out had the error that `enclosure` knows: the next growth to try, until done is 1.
      Then value is the largest growth known to keep max_error times share. The error is the larger one of
      gap_at_most and protrusion: no point of the surface is farther from the balls, no point of the balls
      farther from the solid. Fails where balls that do not grow at all have a larger error, and says which
      one is reached. Refuses surfaces that are not closed.

    When not to use it: the number of balls matters more than the error: Bisect.

    Inputs:
        points (PointSet): the sample, of whose box growth is a part
        search (Bisection, optional): the state before; absent at the beginning
        enclosure (Enclosure, optional): of the balls made with search.value and the closed surface they
          stand for

    Outputs:
        search (Bisection): the state after it

    Parameters:
        max_error (number, default 0.0, model units, >= 0.0): the error that all sides together may have; 0:
          no search, epsilon is the growth
        share (number, default 1.0, fraction of max_error, > 0.0, <= 1.0): what is allowed here; two sides
          of a sum have a half each
        epsilon (number, default 0.5, % of the longest bounding-box edge of the sample, >= 0.0): the growth
          where max_error is 0
        tolerance (number, default 0.1, fraction of the error, >= 0.0, < 1.0): good enough are errors of 1 -
          tolerance of what is allowed, or more; 0 searches longest

    Sources: kornberger2010, 3.5 and 5.2
    """
    ...


class ChooseTemplateOutputs(NamedTuple):
    samples: PointSet
    inner: Balls
    points: PointSet
    mesh: TriangleMesh

def choose_template(
    samples: Sequence[Union[PointSet, ArtifactLike]] = ...,
    inner: Sequence[Union[Balls, ArtifactLike]] = ...,
    points: Sequence[Union[PointSet, ArtifactLike]] = ...,
    meshes: Sequence[Union[TriangleMesh, ArtifactLike]] = ...,
    *,
    instance: int = -1,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ChooseTemplateOutputs:
    """Which of several shapes stands for all of them.

    The medoid: the shape on which all others lie best, by the sum of residuals of rough alignments in
      pairs; what belongs to it is handed on. Of more than two dozen shapes those are looked at whose
      distances of pairs of points are spread most usually. As long as the same shape is taken, whatever is
      made of it stays in the cache when shapes are added. Warns of shapes that are there twice. Refuses
      lists that are not equally long, and shapes without extent.

    When not to use it: one shape is known to be the best: the parameter instance.

    Inputs:
        samples (PointSet, several in order): of the surface of each shape, evenly spread
        inner (Balls, several in order): inner balls of each shape, in the same order
        points (PointSet, several in order): the samples that the inner balls are about, likewise
        meshes (TriangleMesh, several in order, optional): surface of each shape, likewise

    Outputs:
        samples (PointSet): those of the template
        inner (Balls): those of the template
        points (PointSet): those of the template
        mesh (TriangleMesh): that of the template; empty without meshes

    Parameters:
        instance (integer, default -1, number, >= -1, <= 1000000): which one, from 0 on; -1: the medoid

    Sources: osada2002, D2: distances of pairs of points; gonzalez1985, points that are evenly chosen
    """
    ...


def compare(
    balls: Union[Balls, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    spacing: float = 0.5,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Comparison:
    """Measure how far a union of balls is from a surface.

    Hausdorff distances both ways between the surface and the boundary of the union, with bounds that hold
      for every point between the samples; mean distances, coverage, protrusion, and volumes, which are not
      sampled: that of the union by the formulas of UnionMeasure, that of a closed mesh with its components
      turned outwards, but for cavities, as in LabelPoles. Without a mesh the points themselves are the
      surface. Accepts any mesh and any balls; refuses an empty set of balls, no surface at all, and a
      spacing that needs more than 30 million samples.

    When not to use it: only the samples matter: VerifyCover is exact and faster.

    Inputs:
        balls (Balls): the balls
        points (PointSet): samples of the surface; used when there is no mesh
        mesh (TriangleMesh, optional): the surface

    Outputs:
        comparison (Comparison): distances and volumes in model units, and what kind of surface it was

    Parameters:
        spacing (number, default 0.5, % of the longest bounding-box edge, > 0.0, <= 100.0): no point of a
          surface is farther from a sample; time grows with its inverse square

    Sources: kornberger2010, 3.5 and 3.9; aspert2002, 2; edelsbrunner1995, the dual complex, from which the
      volume follows
    """
    ...


def compare_ellipsoids(
    ellipsoids: Union[Ellipsoids, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    spacing: float = 0.5,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Comparison:
    """Measure how far a union of ellipsoids is from a surface.

    What Compare measures of balls: Hausdorff distances both ways between the surface and the boundary of
      the union, with bounds that hold for every point between the samples, mean distances, coverage and
      volumes. protrusion bounds how far an ellipsoid with its center inside reaches beyond the surface: the
      least length by which its half-axes have to be shortened so that it does not meet the surface any
      more; no samples are in it. The union's volume is counted along 512 x 512 lines. Looks at triangles
      and ellipsoids alone, in their own space, however they were made. Without a mesh the points are the
      surface. Refuses no ellipsoids, no surface, and a spacing that needs more than 30 million samples.

    When not to use it: only the samples matter: VerifyEllipsoids is exact and faster.

    Inputs:
        ellipsoids (Ellipsoids): the ellipsoids
        points (PointSet): samples of the surface; used when there is no mesh
        mesh (TriangleMesh, optional): the surface

    Outputs:
        comparison (Comparison): distances and volumes in model units, and what kind of surface it was

    Parameters:
        spacing (number, default 0.5, % of the longest bounding-box edge, > 0.0, <= 100.0): no point of a
          surface is farther from a sample; time grows with its inverse square

    Sources: kornberger2010, 6.4; aspert2002, 2
    """
    ...


def compare_outlines(
    a: Union[Polygon2, ArtifactLike],
    b: Union[Polygon2, ArtifactLike],
    *,
    spacing: float = 0.1,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> OutlineComparison:
    """The difference of two polygons: areas, and distances of their boundaries.

    The areas of both, of what is inside one of them alone, from an exact overlay; and how far the boundary
      of each is from that of the other, at least and at most. Accepts polygons with holes and in several
      parts. Where rings of one cross or touch, areas are unknown, and a warning says where. Refuses one
      that is empty where the other is not.

    When not to use it: shapes are solids: Compare measures meshes against balls.

    Inputs:
        a (Polygon2): polygons, model units: what should be there
        b (Polygon2): polygons, model units: what is there

    Outputs:
        comparison (OutlineComparison): areas and distances

    Parameters:
        spacing (number, default 0.1, % of the longest bounding-box edge of a, >= 1e-05, <= 100.0): samples
          on the boundaries are no farther apart; what is between at least and at most shrinks with it

    Sources: kornberger2010, 5.4; fogel2012, Boolean operations of polygons
    """
    ...


class CoverMatrixOutputs(NamedTuple):
    cover: CoverState
    balls: Balls

def cover_matrix(
    balls: Union[Balls, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    patches: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    uncovered: Literal['ball', 'error', 'report'] = 'report',
    full_entries: int = 60000000,
    max_entries: int = 2000000000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverMatrixOutputs:
    """Find out which ball covers which sample.

    Entry (i, j) of the matrix is 1 iff sample j lies in ball i: |c - s|^2 <= r^2 (1 + 2^-30), or the sample
      defines the ball. A matrix of more than `full_entries` entries is not made: a lower bound with a
      certificate comes first, from few samples and all balls, and its prices tell which balls a good cover
      may be made of; these alone are rows, without those inside others, and columns that contain others are
      left out. Accepts any balls, also overlapping, equal or empty ones. Refuses coordinates beyond 1e140
      and defining samples that are not among the points.

    When not to use it: the balls cover each sample thousands of times: thin the sample or enlarge less, the
      matrix grows with the number of (ball, sample) pairs.

    Inputs:
        balls (Balls): candidate balls, the rows
        points (PointSet): samples to be covered, the columns
        patches (TriangleMesh, optional): triangles of the points; where there are any, they are to be
          covered in place of the points, each by one ball that contains its corners

    Outputs:
        cover (CoverState): the matrix, nothing chosen yet
        balls (Balls): the balls of the rows: the input, then one ball of radius 0 per sample in no ball
          (uncovered = ball)

    Parameters:
        uncovered (choice, default "report"): what becomes of a sample that lies in no ball
            ball: the sample gets a ball of radius 0, after all other balls: a component of its own
            error: the node fails and names the sample
            report: the sample is left out and listed in the result
        full_entries (integer, default 60000000, entries of 4 bytes, >= 0): a larger matrix has candidates
          alone as rows, a few dozen million entries; what Reduce and solvers find out then proves nothing,
          the bound that comes with the matrix does
        max_entries (integer, default 2000000000, entries of 4 bytes, >= 0): a larger matrix is refused
          before it is made; 0 refuses every matrix with an entry

    Sources: kornberger2010, 3.6.1
    """
    ...


class CoverPointsOutputs(NamedTuple):
    points: PointSet
    patches: TriangleMesh

def cover_points(
    points: Union[PointSet, ArtifactLike],
    surface: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    balls: Optional[Union[Balls, ArtifactLike]] = None,
    *,
    cover: Literal['auto', 'samples', 'facets', 'edges', 'patches'] = 'auto',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverPointsOutputs:
    """Say what the balls have to cover: the samples, or more of the surface.

    What is covered need not be what was sampled. Where walls are thin a ball reaches few samples, and balls
      that cover all samples leave holes between them: some a repair of the topology closes, but a tenth of
      the surface may stay outside. The centres of the surface's triangles, and of its edges, are points
      that close them from the start, for up to a quarter more balls; thick shapes need more balls for
      nothing. Whole triangles (patches) are a surface and not points: a union that covers them contains the
      triangulation, which takes several times as many balls.

    When not to use it: covers are to be compared with the thesis or with other programs: they cover the
      samples.

    Inputs:
        points (PointSet): the samples
        surface (TriangleMesh, optional): a triangulation of them, from Refine; without triangles only
          samples can be covered
        balls (Balls, optional): the inner balls of the samples, which say how thick the solid is (cover =
          auto)

    Outputs:
        points (PointSet): the samples, then the centres
        patches (TriangleMesh): the triangles to be covered whole (cover = patches), or none

    Parameters:
        cover (choice, default "auto"): what has to be covered
            auto: samples where the largest ball through half of them is at least 1.5 times as large as the
              triangles there have long edges, facets from 1 on, edges where walls are still thinner
            samples: the samples
            facets: the samples and the centres of triangles
            edges: the samples and the centres of triangles and edges
            patches: whole triangles, each by one ball

    Sources: kornberger2010, 3.6.1, the samples
    """
    ...


def denoise(
    points: Union[PointSet, ArtifactLike],
    noise: Optional[Union[NoiseReport, ArtifactLike]] = None,
    *,
    neighbors: int = 48,
    rounds: int = 2,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> PointSet:
    """Move noisy samples onto quadrics through their neighbours.

    Every sample moves to the point above it of a quadric fitted to its neighbours, with weights that fall
      with the distance, in the frame of their principal axes. Curvature stays. It begins with a quarter of
      `neighbors`, at least 16, and takes twice as many as long as they lie about as near the quadric as the
      first do: where a sheet is thin, or there is an edge, they do not, and fewer are used. The number and
      order of samples stay, normals are left out. The summary of `points` adds deviation, the median
      distance of neighbours from their quadric before the last round. Refuses fewer than 8 neighbours.

    When not to use it: the cloud is clean: details smaller than the neighbourhood, and sharp edges, are
      smoothed away.

    Inputs:
        points (PointSet): noisy samples
        noise (NoiseReport, optional): what AssessNoise said: the number of neighbours that it wants next,
          in place of `neighbors`

    Outputs:
        points (PointSet): the same samples, moved, in the same order

    Parameters:
        neighbors (integer, default 48, samples, >= 8, <= 1000): at most so many neighbours, the sample
          among them: more for more noise
        rounds (integer, default 2, 1, >= 1, <= 100): how often all samples are moved

    Sources: levin2003, projection onto local polynomials, here one weighted quadric in one step
    """
    ...


class DiscPolesOutputs(NamedTuple):
    points: PointSet
    inner: Balls
    outer: Balls

def disc_poles(
    polygon: Union[Polygon2, ArtifactLike],
    *,
    spacing: float = 1.0,
    vertices: Literal['all', 'poles'] = 'all',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> DiscPolesOutputs:
    """The discs of a polygon: Voronoi vertices of its boundary, inside and outside.

    Samples the edges, no farther apart than the spacing and closer where edges are near to each other,
      until every piece between samples is an edge of their Delaunay triangulation with no sample in the
      circle over it. Every triangle then is inside or outside, and so is the center of its circle: these
      circles are the discs, balls with z = 0, which all nodes that take balls accept. With vertices = all
      the union of the inner discs contains the polygon, and reaches beyond it by at most half the spacing.
      The summary of `points` adds splits, how many samples are there beyond the spacing. Accepts any
      polygon. Refuses one without components, and edges so near to each other that samples would be closer
      than coordinates can tell.

    When not to use it: the shape is a solid: VoronoiPoles and LabelPoles take meshes and clouds in space.

    Inputs:
        polygon (Polygon2): polygons with holes, model units

    Outputs:
        points (PointSet): the samples along the rings, z = 0
        inner (Balls): discs inside, with the samples that they pass through
        outer (Balls): discs outside, of all triangles between the rings and the convex hull

    Parameters:
        spacing (number, default 1.0, % of the longest bounding-box edge, >= 0.0001, <= 100.0): samples on
          an edge are no farther apart; half of it bounds how far discs reach beyond edges
        vertices (choice, default "all"): which Voronoi vertices become discs
            all: every Voronoi vertex: the inner discs contain the polygon
            poles: the farthest on either side of each sample only (thesis, 3.4)

    Sources: kornberger2010, 5.4 and 3.4; ruppert1995, 3
    """
    ...


class DiscUnionOutlineOutputs(NamedTuple):
    outline: DiscOutline
    polygon: Polygon2

def disc_union_outline(
    balls: Union[Balls, ArtifactLike],
    *,
    error: float = 0.05,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> DiscUnionOutlineOutputs:
    """The outline of a union of discs: its arcs, and a polygon in it.

    The arcs on the boundary of the union, joined to rings, outer ones and holes. Which arcs there are and
      how they join is decided exactly; their ends are rounded, and area and perimeter are by formulas. The
      polygon has its corners on the arcs: it is inside the union, and no point of the outline is farther
      from it than its `error`, which the summary has in model units. Accepts any balls with z = 0: none,
      equal, nested, touching ones, on a line; points have no outline. Refuses another z, and numbers that
      are not 0 and outside [1e-150, 1e150].

    When not to use it: only area or topology is wanted of balls in space: UnionMeasure and UnionTopology
      have those.

    Inputs:
        balls (Balls): discs, model units: balls with z = 0

    Outputs:
        outline (DiscOutline): rings of arcs, the union on the left
        polygon (Polygon2): polygons inside the union, with corners on the arcs

    Parameters:
        error (number, default 0.05, % of the longest bounding-box edge of the union, >= 1e-06, <= 100.0):
          no point of the outline is farther from the polygon

    Sources: kornberger2010, 5.4; edelsbrunner1995, dual complex
    """
    ...


def distance(
    a: Union[Balls, ArtifactLike],
    b: Union[Balls, ArtifactLike],
    a_enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    b_enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    *,
    threshold: float = 0.0,
    most_pairs: int = 1000,
    every_ball: bool = False,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> BallDistance:
    """How far two unions of balls are apart, or how deep they overlap.

    The separation of two balls is |c - c'| - r - r': how far they are apart, or the negative of their
      depth. The smallest one of all pairs is, where it is not negative, the distance of the unions; where
      it is negative, the depth of the deepest pair, and not the translational penetration depth of the
      unions: no shorter translation parts them, but the shortest that does may be longer. With it come the
      two balls, a point on each, the pairs below a threshold, and on request the clearance of every ball.
      Which pairs these are is decided exactly for the doubles given; of equal ones the lowest indices come
      first. With the enclosures of both sides it also says between what bounds the distance of the solids
      is proven to be. Accepts any balls: equal, nested, concentric, of radius 0. Refuses empty sets, and
      coordinates and radii beyond 1e140.

    When not to use it: the translation that parts two overlapping unions is wanted: it ends on the boundary
      of their configuration space (graphs/configuration_space.json).

    Inputs:
        a (Balls): n balls, model units
        b (Balls): m balls, in the same place and unit
        a_enclosure (Enclosure, optional): whether the balls of a contain a solid, and how far they stand
          out of it; without it they are the solid
        b_enclosure (Enclosure, optional): the same of b

    Outputs:
        distance (BallDistance): smallest separation, witnesses, near pairs, clearances

    Parameters:
        threshold (number, default 0.0, model units, >= -1000000000000000.0, <= 1000000000000000.0): pairs
          with at most this separation are listed; 0: those that touch or overlap
        most_pairs (integer, default 1000, pairs, >= 0, <= 1000000): no more pairs are listed: those with
          the smallest separations; 0: none
        every_ball (boolean, default false): also find, for every ball of a and of b, how far the other set
          is

    Sources: quinlan1994, distances by trees of balls, branch and bound
    """
    ...


def ellipsoid_matrix(
    ellipsoids: Union[Ellipsoids, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    patches: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    max_entries: int = 500000000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverState:
    """Find out which ellipsoid covers which sample.

    What CoverMatrix is for balls: entry (i, j) is 1 iff sample j lies in ellipsoid i, up to 2^-30 of the
      squared half-axes. The result goes to every strategy of pruning; its balls are ellipsoids. Samples in
      no ellipsoid are listed and warned about. Accepts ellipsoids with any rotations; refuses half-axes
      below 2^-32 of the coordinates.

    When not to use it: the pieces are balls: CoverMatrix knows matrices that are too large to be made.

    Inputs:
        ellipsoids (Ellipsoids): candidates, the rows
        points (PointSet): samples to be covered, the columns
        patches (TriangleMesh, optional): triangles; where there are any they are covered in place of the
          points, each by one ellipsoid that contains its corners

    Outputs:
        cover (CoverState): the matrix, nothing chosen yet

    Parameters:
        max_entries (integer, default 500000000, entries of 4 bytes, >= 0): a larger matrix is refused

    Sources: kornberger2010, 3.6.1 and 6.4
    """
    ...


class EncloseBallsOutputs(NamedTuple):
    balls: Balls
    fit: EnclosureFit

def enclose_balls(
    mesh: Union[TriangleMesh, ArtifactLike],
    start: Optional[Union[Balls, ArtifactLike]] = None,
    count: Optional[Union[BallCounts, ArtifactLike]] = None,
    *,
    balls: int = 20,
    effort: Literal['low', 'normal', 'high'] = 'normal',
    seed: int = 1,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    progress: Progress = None,
) -> EncloseBallsOutputs:
    """A given number of balls that contain a surface and all inside it, with little volume outside.

    The union of the balls is proven to contain every triangle and everything that the triangles separate
      from infinity (as VerifyEnclosure proves it), and wastes as little volume outside as a local search
      finds. Accepts any mesh: open, doubled, crossing, degenerate triangles, many pieces, either
      orientation. fit tells about how much volume is outside, counted on a lattice; VerifyEnclosure and
      UnionMeasure tell it exactly. Where more balls gain nothing, fewer are returned. Refuses meshes
      without triangles.

    When not to use it: balls must not stand out of the solid: InsideBalls; or only by a given distance:
      ProtrudeBalls.

    Inputs:
        mesh (TriangleMesh): m triangles, model units
        start (Balls, optional): balls to begin the search with, at most as many as wanted
        count (BallCounts, optional): how many balls, in place of the parameter: one count, of AllocateBalls

    Outputs:
        balls (Balls): at most as many balls as wanted; radii are 2e-6, and 2.4e-7 of the longest bounding-
          box edge, larger than found, against rounding
        fit (EnclosureFit): how many they are, and about how much volume is outside

    Parameters:
        balls (integer, default 20, balls, >= 1, <= 5000): no more balls than this
        effort (choice, default "normal"): how long the search goes on; it counts work, not time
            low: no rounds of shifts and swaps: half the time, some percent more outside
            normal: two rounds, one beyond 40 balls
            high: eight rounds: two to three times the time
        seed (integer, default 1, number, >= 0): other seeds find other balls of about the same volume

    Sources: kingma2015, all balls move downhill at once by Adam; ma2012, inner balls that the search starts
      from
    """
    ...


class EnlargeOutputs(NamedTuple):
    balls: Balls
    growth: Growth

def enlarge(
    balls: Union[Balls, ArtifactLike],
    points: Optional[Union[PointSet, ArtifactLike]] = None,
    poles: Optional[Union[PoleSet, ArtifactLike]] = None,
    search: Optional[Union[Bisection, ArtifactLike]] = None,
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    *,
    mode: Literal['additive', 'absolute', 'multiplicative', 'pole_bound', 'power_diagram'] = 'additive',
    epsilon: float = 0.3,
    factor: float = 1.05,
    r: float = 0.08,
    constant: Literal['safe', 'thesis'] = 'safe',
    tolerance: Literal['polar', 'none'] = 'polar',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> EnlargeOutputs:
    """Grow radii so that pruning may drop small features.

    Every ball keeps its center, its place in the order and its defining samples; no radius shrinks. Modes
      additive, absolute and multiplicative grow as asked for, and nothing keeps the union from changing its
      topology when epsilon is larger than a gap of the shape. In modes pole_bound and power_diagram epsilon
      is a wish, and a bound wins; `growth` says for every ball which bound stopped it. pole_bound keeps
      inner balls off the outer medial axis, which is necessary for the topology but not sufficient.
      power_diagram stops balls at the critical Gabriel points of the union, compares the grown union with
      the one before by the map that the inclusion induces in homology over Z/2, and where that is no
      isomorphism stops neighbours of stopped balls too. Accepts any balls. Refuses percent without a
      sample, pole_bound without poles, and radii that leave the range of doubles.

    When not to use it: balls must not grow at all: connect them directly.

    Inputs:
        balls (Balls): n balls, model units
        points (PointSet, optional): the sample the balls were made from; needed by all modes but absolute
          and multiplicative
        poles (PoleSet, optional): the poles of the sample; needed by mode pole_bound
        search (Bisection, optional): a search for epsilon (see Bisect): its value replaces the parameter
        diagram (PowerDiagram, optional): the power diagram of the balls (node PowerDiagram with the
          tolerance set here), which mode power_diagram then need not compute; other modes do not look at it

    Outputs:
        balls (Balls): n balls, same order, radii >= input
        growth (Growth): radii before and after, and what stopped each ball

    Parameters:
        mode (choice, default "additive"): additive growth gives noise the same significance everywhere,
          multiplicative growth spares thin parts
            additive: radius + epsilon % of the longest bounding-box edge of the sample
            absolute: radius + epsilon model units
            multiplicative: radius * factor
            pole_bound: as additive, but off the outer medial axis (Lemma 3.4)
            power_diagram: as additive, but so that the union keeps its topology (3.5.2, verified by the
              inclusion)
        epsilon (number, default 0.3, % of the longest bounding-box edge of the sample, or model units
          (absolute), >= 0.0): how much radii grow in all modes but multiplicative; 0 returns the input
          (power_diagram: with its tolerance added), beyond about 3 % little of the shape remains
        factor (number, default 1.05, 1, >= 1.0): by what radii are multiplied in mode multiplicative; 1
          returns the input
        r (number, default 0.08, fraction of the local feature size, > 0.0, <= 0.08): mode pole_bound: how
          dense the sample is; smaller values let balls grow more
        constant (choice, default "safe"): mode pole_bound: the factor of D^ in Lemma 3.4
            safe: 0.817 - 2.5604 r / (1 - r), which the proof supports
            thesis: 0.817 - 1.2802 r / (1 - r), as printed
        tolerance (choice, default "polar"): mode power_diagram: what is added to squared radii so that
          balls that touch overlap
            polar: for polar balls: 2^-36 L^2, L the longest edge of the box
            none: balls are what their radii say

    Sources: kornberger2010, 3.5, Lemma 3.4, 3.5.2
    """
    ...


def find_way(
    balls: Union[Balls, ArtifactLike],
    diagram: Union[PowerDiagram, ArtifactLike],
    report: Optional[Union[MinkowskiReport, ArtifactLike]] = None,
    *,
    start: str = '0 0 0',
    goal: str = '0 0 0',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Way:
    """Whether there is a way between two points around a union of balls, and one.

    Start and goal can be joined outside of the balls if they are in one component of what the union leaves
      of space; the power diagram has the components, and predicates decide exactly where both are. Where
      there is a way, one goes along edges of the diagram that are outside of the union, short, with corners
      cut off where that keeps its clearance; every segment is checked exactly. A start or goal in a ball or
      on its sphere is named, with the ball. With the report of the sum that the balls are the result says
      what is proven about the solids: of balls that contain the forbidden places a way, of balls that lie
      in them that there is none. Accepts any balls and points. Refuses empty sets, and coordinates beyond
      1e140.

    When not to use it: the robot turns on its way, or the shortest or safest way is asked for: planners do
      that.

    Inputs:
        balls (Balls): n balls: where what moves must not be, model units
        diagram (PowerDiagram): their power diagram, with tolerance none
        report (MinkowskiReport, optional): of the Minkowski sum that the balls are: what it proves about
          the solids

    Outputs:
        way (Way): the answer, components, and a polyline where there is a way

    Parameters:
        start (string, default "0 0 0"): where the way begins: "x y z", model units
        goal (string, default "0 0 0"): where it ends: "x y z", model units

    Sources: kornberger2010, 5.1; edelsbrunner1995, components of the complement by the dual complex;
      lozano1983, obstacles in the space of configurations
    """
    ...


def greedy(
    cover: Union[CoverState, ArtifactLike],
    *,
    mode: Literal['until_covered', 'one_per_component', 'all'] = 'until_covered',
    remove_redundant: bool = False,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverState:
    """Choose the ball that covers most of what is left.

    Ties go to the ball of lowest index. Each pick may cost one ball more than the optimum; the lower bound
      of the result accounts for the picks (Lemma 3.7).

    When not to use it: few balls matter more than time: reduce first, and improve the result by local
      search.

    Inputs:
        cover (CoverState): any state of a set covering computation

    Outputs:
        cover (CoverState): the same instance with the picks chosen

    Parameters:
        mode (choice, default "until_covered"): how many balls are chosen
            until_covered: until every sample is covered
            one_per_component: one longest row of every connected component, once: the step of the hybrid
              loop
            all: every ball is kept: nothing is pruned
        remove_redundant (boolean, default false): drop picks whose samples the other picks cover; mode
          until_covered only

    Sources: kornberger2010, 3.6.3, Listing 3.1 and Lemma 3.7
    """
    ...


def ip_solve(
    cover: Union[CoverState, ArtifactLike],
    known: Optional[Union[CoverState, ArtifactLike]] = None,
    *,
    solver: Literal['lp_solve', 'cbc'] = 'lp_solve',
    max_balls: int = 60,
    node_limit: int = 10000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverState:
    """Solve independent parts of a covering matrix exactly.

    Connected components of at most max_balls rows are solved by integer programming and removed. Every
      answer is checked against the matrix and against the bound that its dual prices prove. A component
      that needs more than node_limit nodes stays in the matrix; with a known cover nothing stays: its balls
      are taken where nothing better is found, and where nothing better exists they are exact.

    When not to use it: the matrix was not reduced: its components are then large; run Reduce first.

    Inputs:
        cover (CoverState): any state of a set covering computation, best after Reduce
        known (CoverState, optional): a whole cover computed from the same matrix: the solver looks for less

    Outputs:
        cover (CoverState): the same instance without the parts that were solved

    Parameters:
        solver (choice, default "lp_solve"): the library that solves integer programs
            lp_solve: branch and bound, as in the thesis: up to some hundred balls
            cbc: branch and cut: up to some thousand balls
        max_balls (integer, default 60, balls, >= 0, <= 2147483647): components of more balls are not given
          to the solver; 0 gives it none. Time explodes beyond 150 with lp_solve, beyond 3000 with cbc
        node_limit (integer, default 10000, branch-and-bound nodes, >= 0): effort per component before it is
          given up; 0 solves only what needs no branching

    Sources: kornberger2010, 3.6.2; lpsolve, branch and bound; forrest2005, 2
    """
    ...


class InsideBallsOutputs(NamedTuple):
    balls: Balls
    fit: EnclosureFit

def inside_balls(
    mesh: Union[TriangleMesh, ArtifactLike],
    count: Optional[Union[BallCounts, ArtifactLike]] = None,
    *,
    balls: int = 20,
    rounds: int = 3,
    seed: int = 1,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    progress: Progress = None,
) -> InsideBallsOutputs:
    """A given number of balls inside a solid that cover as much of it as they can.

    No point of a ball is outside: its centre is inside, and its radius at most the distance to the surface.
      Centres are those of largest inner balls, chosen greedily, then moved and exchanged while that covers
      more. For distances that must not be too large, or balls to be grasped or filled. Refuses meshes that
      are not closed.

    When not to use it: nothing of the solid may be outside of the balls: EncloseBalls.

    Inputs:
        mesh (TriangleMesh): a closed mesh, model units; orientation does not matter
        count (BallCounts, optional): how many balls, in place of the parameter: one count, of AllocateBalls

    Outputs:
        balls (Balls): at most as many balls as wanted
        fit (EnclosureFit): how many they are, and about how much they leave uncovered

    Parameters:
        balls (integer, default 20, balls, >= 1, <= 5000): no more balls than this
        rounds (integer, default 3, rounds, >= 0, <= 1000): of the local search: each moves or exchanges
          every ball once; it ends when nothing changes
        seed (integer, default 1, number, >= 0): other seeds find other balls that cover about as much

    Sources: ma2012, largest inner balls through points of the surface
    """
    ...


class LabelPolesOutputs(NamedTuple):
    poles: PoleSet
    inner: Balls
    outer: Balls

def label_poles(
    poles: Union[PoleSet, ArtifactLike],
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    method: Literal['auto', 'mesh', 'winding', 'angle'] = 'auto',
    outer: Literal['all', 'bounded'] = 'all',
    vertices: Literal['auto', 'poles', 'all'] = 'poles',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> LabelPolesOutputs:
    """Tell inner from outer poles: the discrete medial axis transform of a solid.

    A pole is inner when the winding number of the mesh around it exceeds 1/2. For closed meshes it is an
      integer, counted with exact predicates: right at sharp edges, where the sample is too coarse, with
      cavities and with self-intersections. For open meshes it is the generalized winding number. Triangles
      that face inconsistent ways are turned over; the mesh may be inside out. Without a mesh, for clouds of
      points, labels spread from the unbounded poles, which are outer: two balls through one sample share a
      label where they overlap deeply, and do not where they lie on opposite sides of it, the most certain
      pairs first (method angle). That is right for well sampled smooth surfaces; it fails at sharp edges,
      at noise as large as the spacing, between sheets closer than the spacing, and leaks through holes.
      Where both poles of a sample are on one side, as at sharp edges, the farthest candidate on the other
      side becomes its third pole. The summary of `poles` adds method, uncertain (winding number from 1/4 to
      3/4, or exactly on the surface; for angle, evidence against the label at least half as strong as that
      for it), unlabelled (angle: nothing is known) and turned_triangles. Refuses open surfaces that have no
      inside that could be told (a sheet; method auto), mesh and winding without triangles, and a surface
      with no pole inside, such as an open sheet.

    When not to use it: the mesh is not the surface that was sampled, or has large holes: see `uncertain`.

    Inputs:
        poles (PoleSet): poles of a sample, labelled or not
        mesh (TriangleMesh, optional): triangles of the surface that was sampled, in the same coordinates;
          not for method angle

    Outputs:
        poles (PoleSet): the poles, labelled, with third poles; with vertices = poles without the other
          candidates
        inner (Balls): balls of the inner vertices with the samples they pass through
        outer (Balls): balls of the outer vertices, those of unbounded poles included or not

    Parameters:
        method (choice, default "auto"): how inside and outside are told apart
            auto: mesh when the mesh is closed, angle without triangles, else winding, with a warning
            mesh: exact, for closed meshes; refuses others and says why
            winding: generalized winding number; the same as mesh for closed meshes
            angle: from the polar balls alone, for clouds without a mesh
        outer (choice, default "all"): which balls the output outer has
            all: balls of unbounded poles too; they end at far-away points
            bounded: only balls that samples bound, for the medial axis of the outside
        vertices (choice, default "poles"): which Voronoi vertices become balls
            auto: all with a closed mesh, else poles
            poles: the poles of samples only (thesis, 3.4)
            all: every Voronoi vertex that VoronoiPoles listed; method angle: poles

    Sources: kornberger2010, 3.4; aichholzer2007, labels from a mesh; amentakolluri2000, labels without a
      mesh; jacobson2013, generalized winding number; barill2018, hierarchical evaluation
    """
    ...


class LabelSurfaceOutputs(NamedTuple):
    points: PointSet
    mesh: TriangleMesh

def label_surface(
    *,
    file: FileLike,
    label: int = 0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> LabelSurfaceOutputs:
    """The closed surface of a label in a segmented image.

    Reads NRRD (header and data in one file) and NIfTI-1 (.nii), also packed with gzip or zstd, and makes
      the mesh that separates voxels with the label from the others: closed, manifold, outward oriented. One
      image in both formats has one place: x to the right of the patient, y to the front, z to the head
      (RAS+), millimetres; NRRD images in another space of patients are turned. Where the file does not say
      where the patient is, its axes stay, and the field frame of the summary tells. Vertices lie halfway
      between centers of voxels; nothing is smoothed. Refuses other formats (DICOM, MetaImage, Analyze,
      NIfTI-2) by their names, damaged files, values that are no whole numbers, and a label that is not
      there, with those that are.

    When not to use it: the image has grey values: threshold or segment it before.

    Outputs:
        points (PointSet): the vertices of the mesh
        mesh (TriangleMesh): the surface, in millimetres where the file has a unit

    Parameters:
        file (file, required): a label image (.nrrd, .nii, .nii.gz), or labels:ball for a generated one
        label (integer, default 0, label, >= -2147483648, <= 2147483647): the surface of the voxels with
          this value; 0: of all that are not 0

    Sources: kornberger2010, 6.3.1
    """
    ...


def lagrangian_bound(
    cover: Union[CoverState, ArtifactLike],
    *,
    iterations: int = 1500,
    momentum: float = 0.95,
    patience: int = 30,
    shrink: float = 0.7,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverState:
    """Prove how many balls any cover needs, with a certificate.

    Climbs the Lagrangian relaxation of every connected component by subgradients with momentum; the
      multipliers become integer prices of samples that anybody can check on the original balls. Ends near
      the bound of linear programming. Chooses nothing.

    When not to use it: the matrix was not reduced: every iteration looks at all its entries.

    Inputs:
        cover (CoverState): any state of a set covering computation, best after Reduce

    Outputs:
        cover (CoverState): the same state with a lower bound and its certificate, where they are better

    Parameters:
        iterations (integer, default 1500, iterations, >= 0): at most, for each component; 0 only spreads
          the prices of the share bound
        momentum (number, default 0.95, fraction, >= 0.0, <= 0.999): how much of a direction stays in the
          next one; 0 is the plain subgradient, which stalls
        patience (integer, default 30, iterations, >= 1): iterations without a better bound before the step
          gets shorter
        shrink (number, default 0.7, factor, >= 0.01, <= 0.99): how much shorter; near 1 more iterations are
          used

    Sources: kornberger2010, 3.6.4; caprara1999, the relaxation of set covering and its multipliers
    """
    ...


def link_balls(
    spheres: Union[RobotSpheres, ArtifactLike],
    *,
    link: str,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """The balls of one link of a robot, in the frame of the link.

    Its bytes depend on the balls of this link alone. A link without balls gives none. Refuses names that
      are no link.

    When not to use it: the balls come from a file of their own: LoadBalls.

    Inputs:
        spheres (RobotSpheres): balls of all links

    Outputs:
        balls (Balls): n balls, metres

    Parameters:
        link (string, required): name of the link

    Sources: sundaralingam2023, spheres of links
    """
    ...


class LoadBallsOutputs(NamedTuple):
    balls: Balls
    axis: MedialAxis

def load_balls(
    *,
    file: FileLike,
    scale: str = '1',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> LoadBallsOutputs:
    """Reads balls, or a medial axis, that another program or an export wrote.

    Reads ma (Q-MAT, MATFP, MATTopo), sph, the leaves of sphere trees (levels and branches first), lines of
      x y z r (also CSV, under column names, with decimal commas, or with a v in front), and PLY with a
      radius or diameter, each also packed with gzip or zstd; the content decides. Coordinates and radii
      stay as they are. Leaves out what MATFP marks as deleted. Refuses, with the line, numbers that are not
      finite, negative radii, indices out of range, commas that may separate or be decimal, and files that
      end early or late.

    When not to use it: the balls are to be computed from a model: VoronoiPoles and LabelPoles do that

    Outputs:
        balls (Balls): the balls in the order of the file
        axis (MedialAxis): of ma: the balls as vertices, edges that bound no triangle, triangles; else empty

    Parameters:
        file (file, required): a file, or the balls themselves: "balls:0 0 0 1; 1.5 0 0 1"
        scale (string, default "1"): of centres and radii: a factor, or the unit of the lengths in the file,
          which become metres (um, mm, cm, dm, m, km, mil, in, ft, yd)

    Sources: li2015, file format of the authors' program; wang2022, same; dou2022, lists of candidates
    """
    ...


class LoadCoverOutputs(NamedTuple):
    cover: CoverState
    balls: Balls

def load_cover(
    points: Optional[Union[PointSet, ArtifactLike]] = None,
    *,
    file: FileLike,
    format: Literal['auto', 'scp', 'rail', 'steiner', 'balls'] = 'auto',
    dilation: float = 0.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> LoadCoverOutputs:
    """Read a set covering instance of the literature.

    Reads OR-Library files (scp and rail), Steiner triple systems, and balls of Coverage Axis, each also
      packed with gzip or zstd. Sets become rows, elements become columns. Every set counts 1: other costs
      are ignored with a warning. Refuses, with the line, numbers out of range, repeated entries, and files
      that end early or late.

    When not to use it: balls and samples come from a model: CoverMatrix makes the matrix from them.

    Inputs:
        points (PointSet, optional): samples to be covered by a file of balls

    Outputs:
        cover (CoverState): the instance, nothing chosen yet
        balls (Balls): the balls of the rows, dilated; none for files without balls

    Parameters:
        file (file, required): an instance; or steiner:N for the lines of the affine space of N = 3, 9, 27,
          81, 243 or 729 points
        format (choice, default "auto"): how the file lists the instance
            auto: the one that the file fits
            scp: elements, sets; costs of sets; sets of every element
            rail: elements, sets; cost and elements of every set
            steiner: points, blocks; the three points of every block
            balls: x y z r a line, also with a v before it, or with commas
        dilation (number, default 0.0, model units, >= 0.0): added to every radius of a file of balls; 0
          keeps the radii

    Sources: beasley1990, set covering; fulkerson1974, 2; dou2022, 4
    """
    ...


def load_robot_spheres(
    robot: Union[Robot, ArtifactLike],
    *,
    file: FileLike,
    buffer: float = 0.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> RobotSpheres:
    """Reads collision spheres that another program made for a robot.

    cuRobo's collision_spheres (YAML), XRDF, foam, ballpark and other JSON and YAML by link, URDF whose
      collisions are spheres, SRDF with link_sphere_approximation, CSV with link, x, y, z and radius, each
      also packed; the content decides. Links that the robot does not have, and spheres of radius 0 and
      less, are left out with a warning; buffers that a file asks for are named, not added. Refuses, with
      the line, numbers that are not finite, and files without a sphere for the robot.

    When not to use it: the balls are for one mesh: LoadBalls.

    Inputs:
        robot (Robot): whose links the file names

    Outputs:
        spheres (RobotSpheres): links with the balls of the file; pairs are not looked for

    Parameters:
        file (file, required): the spheres, in the frames of the links, metres; or spheres:arm, some for
          robot:arm
        buffer (number, default 0.0, m, >= 0.0): added to every radius: 0 takes them as they are

    Sources: sundaralingam2023, spheres of links
    """
    ...


def local_feature_size(
    points: Union[PointSet, ArtifactLike],
    poles: Union[PoleSet, ArtifactLike],
    balls: Sequence[Union[Balls, ArtifactLike]] = ...,
    axes: Sequence[Union[MedialAxis, ArtifactLike]] = ...,
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> LocalFeatureSize:
    """Estimate at every sample how far the medial axis is.

    D^ of every sample: the distance to the nearest pole of all samples, inner or outer. For an r-sample
      with r <= 0.08 the distance to the discrete medial axis is from 0.817 D^ to D^, and the local feature
      size is at most 1.2802 D^. Labels do not matter. With medial axes it also gives the distance to them,
      computed and not sampled: with those of the inner and of the outer polar balls the discrete local
      feature size of Definition 4.1, whose quotient by D^ the summary compares with 0.817. With a mesh of
      the surface it bounds the r for which the points are an r-sample of it (Definition 3.2), with the
      distance to the axes, or D^ without them, in place of the local feature size, which cannot be
      computed. Refuses poles of another number of samples.

    When not to use it: the sample is noisy or has sharp edges: D^ is then about the noise or 0 at the edge.

    Inputs:
        points (PointSet): the sample, n points
        poles (PoleSet): its poles, labelled or not
        balls (Balls, several in order, optional): polar balls that were kept, inner and outer: D^ is then
          the distance to the nearest of their centres, and the poles do not count; the bounds above hold
          for all poles only, and the result says that these are fewer
        axes (MedialAxis, several in order, optional): medial axes (node MedialAxis) of the union of the
          inner and of that of the outer balls
        mesh (TriangleMesh, optional): the surface that was sampled, in the same coordinates, for r; without
          triangles as if not connected

    Outputs:
        size (LocalFeatureSize): of the n samples, same order, D^, the distances to their third neighbours
          and to the axes; bounds of r

    Sources: kornberger2010, Definitions 3.2 and 4.1, Lemma 4.8 and Corollary 4.12
    """
    ...


def local_search(
    cover: Union[CoverState, ArtifactLike],
    *,
    effort: Literal['low', 'normal', 'high'] = 'normal',
    steps_per_ball: float = 300.0,
    work_per_ball: float = 15000.0,
    min_steps: int = 200000,
    max_steps: int = 100000000,
    core_steps_per_ball: float = 13000.0,
    target_gap: float = 0.0,
    seed: int = 1,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    progress: Progress = None,
) -> CoverState:
    """Cover what is left by few balls: greedy, then local search.

    Row-weighting local search on every connected component, then once more with the balls of small reduced
      cost where at most 200 balls cover a component. Where more than 600 balls are needed the first half of
      the steps goes to regions of the cover, all at once, the second half to the whole. Ends early where
      the certificate proves that fewer balls are impossible, so run LagrangianBound before. The number of
      steps is limited, not the time: equal input gives equal balls.

    When not to use it: nothing was reduced: the search then spends its steps on dominated balls.

    Inputs:
        cover (CoverState): any state of a set covering computation, best after Reduce

    Outputs:
        cover (CoverState): a cover; lower bound and certificate as before

    Parameters:
        effort (choice, default "normal"): how long is searched; more effort never ends with more balls. The
          summary of high effort adds curve
            low: a quarter of the first search
            normal: both searches
            high: both, and both again from what they found, with 10 times the steps for each ball, 1000
              times min_steps and 100 times those in the core, as far as 6 * 10^9 entries go: up to a minute
        steps_per_ball (number, default 300.0, steps, >= 0.0): steps for each ball that is left in the
          matrix, half of it where regions are searched; a step takes a microsecond or a few
        work_per_ball (number, default 15000.0, matrix entries, >= 0.0): bounds the same in entries visited,
          for dense matrices, where a step takes longer
        min_steps (integer, default 200000, steps, >= 0, <= 2000000000): for the whole matrix, however few
          balls are left
        max_steps (integer, default 100000000, steps, >= 0, <= 2000000000): for the whole matrix; 0 is
          greedy without redundant balls
        core_steps_per_ball (number, default 13000.0, steps, >= 0.0): times the gap: steps of a second
          search with balls of small reduced cost, where covers are small
        target_gap (number, default 0.0, fraction of the lower bound, >= 0.0): stops when the balls exceed
          the lower bound by no more; 0 stops only at the bound
        seed (integer, default 1, number, >= 0): other seeds find other covers of about the same size

    Sources: gao2015, 3
    """
    ...


def match(
    balls: Union[Balls, ArtifactLike],
    target: Union[PointSet, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    inner: Union[Balls, ArtifactLike],
    pose: Union[ShapePose, ArtifactLike],
    *,
    width: float = 2.0,
    stiffness: float = 30.0,
    to: Literal['planes', 'points'] = 'planes',
    outliers: float = 0.1,
    start: float = 0.1,
    reach: float = 0.04,
    centers: int = 0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> MatchedBalls:
    """The balls and surface points of a template, found again on another shape.

    Coherent point drift: samples of both surfaces draw the template along a field that is smooth by a
      Gaussian kernel; it begins where shapes are aligned, not from scratch. Each carried ball is then
      replaced by the nearest of the instance's own inner balls in center and radius, where one is near:
      carried into thin parts it would lie outside. The carried balls go with it: they are without the noise
      of poles. Of every ball it tells how far that was, whether there was one, and whether it was taken
      twice; the pose is found again with the labels. Refuses empty sets, samples without normals, balls of
      radius 0.

    When not to use it: parts of the shapes do not correspond, or they are not aligned to a few degrees: it
      ends in a wrong correspondence, smooth and plausible.

    Inputs:
        balls (Balls): k balls of the template inside its surface: TemplateBalls
        target (PointSet): m samples of the template's surface, with normals
        points (PointSet): n samples of the instance's surface, with normals
        inner (Balls): the instance's own inner balls, before they grow
        pose (ShapePose): from the instance to the template

    Outputs:
        matched (MatchedBalls): k balls and m points, in the instance's coordinates

    Parameters:
        width (number, default 2.0, radii of the template, >= 0.1, <= 20.0): of the kernel: how far a
          displacement reaches; the radius is root mean square, of the samples
        stiffness (number, default 30.0, factor, >= 0.001, <= 1000000.0): how much smoothness counts: small
          values follow the surface closely, to wrong places
        to (choice, default "planes"): what samples are drawn to
            planes: distances along a surface hardly count, so samples of flat faces stay
            points: distances count the same in all directions
        outliers (number, default 0.1, share of the samples, >= 0.0, <= 0.9): that have no counterpart
        start (number, default 0.1, radii of the template, >= 0.001, <= 10.0): deviation of the distances to
          begin with, after alignment
        reach (number, default 0.04, share of the diagonal, >= 0.0, <= 1.0): a carried ball farther than
          this from all balls of the instance has no partner
        centers (integer, default 0, balls, >= 0, <= 10000): of the instance, evenly chosen, that draw the
          balls besides; 0: samples of the surface alone, which is more exact with planes

    Sources: myronenko2010, coherent point drift, low rank; kornberger2010, 6.3.1
    """
    ...


def medial_axis(
    complex: Union[SimplicialComplex, ArtifactLike],
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    *,
    on_mismatch: Literal['warn', 'error'] = 'warn',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> MedialAxis:
    """The medial axis of a union of balls as a polygon complex.

    Simplices of the alpha-shape that belong to no tetrahedron, and inside its tetrahedra the Voronoi
      diagram of the vertices of the union's boundary. The axis is homotopy equivalent to the union; its
      Betti numbers, counted from its own polygons, are compared with those of the alpha-shape. Accepts
      every alpha-shape: empty, flat or nearly flat, with cavities, of several components, of balls on a
      grid. Doubles are tried first; where rounding hides the structure the axis is made again with exact
      decisions, which takes some ten times as long. Polygons are labelled by sheets, the components after
      cutting at edges of three and more polygons, and oriented sheet by sheet; those edges are the seams.

    When not to use it: the alpha-shape is that of polar balls that were not enlarged: many balls then meet
      in one sample, so that everything is decided exactly. 85 000 balls take two minutes.

    Inputs:
        complex (SimplicialComplex): the alpha-shape of the balls (node AlphaShape)
        diagram (PowerDiagram, optional): the power diagram that the alpha-shape was read off: nothing is
          searched in it again

    Outputs:
        axis (MedialAxis): polygons, edges in no polygon and isolated vertices, with the radius of the
          inscribed ball

    Parameters:
        on_mismatch (choice, default "warn"): what happens when the axis and the union differ in components,
          tunnels or cavities: the alpha-shape is then not that of its balls
            warn: say so and go on
            error: fail: nothing that follows sees an axis of another topology

    Sources: amenta2001, the medial axis of a union of balls; kornberger2010, 3.7
    """
    ...


def minimal_union(
    balls: Union[Balls, ArtifactLike],
    *,
    of: Literal['balls', 'discs'] = 'balls',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """Drops balls that others cover: the union stays, and none of the rest can go.

    An inclusion-minimal part of the balls with the same union, decided exactly for the doubles given. First
      go the balls that do not contribute: no point of theirs has a strictly smaller power to them than to
      all others (thesis, 5.1). What contributes may still be covered by several others together: the
      contributing balls are asked one by one, smallest radius first, of equal ones by x, y, z of the
      center, and each goes when those still there cover it. So the result depends on the set of balls
      alone. It is smallest in the sense that nothing can be dropped; another part may have fewer balls. The
      summary has the counts beside each other: contributing, minimal, and touching_boundary, which have a
      piece of their sphere on the boundary of the union and do not represent it alone. Accepts any balls:
      none, one, equal, nested, tangent, flat sets, radius 0. Refuses coordinates and radii that are not 0
      and outside [1e-150, 1e150].

    When not to use it: the union may change a little: Enlarge, CoverMatrix and a strategy need far fewer
      balls. What covers samples rather than the union is pruned there too.

    Inputs:
        balls (Balls): balls, model units

    Outputs:
        balls (Balls): those that are needed, in the order they had, with their defining samples

    Parameters:
        of (choice, default "balls"): what the union is of; a disc may be covered where the ball is not
            balls: the union in space
            discs: the union in the plane, of balls with z = 0

    Sources: kornberger2010, 5.1; aurenhammer1988, Lemma 1; seidel1991, 2
    """
    ...


class MinkowskiSumOutputs(NamedTuple):
    balls: Balls
    report: MinkowskiReport

def minkowski_sum(
    a: Union[Balls, ArtifactLike],
    b: Union[Balls, ArtifactLike],
    a_comparison: Optional[Union[Comparison, ArtifactLike]] = None,
    b_comparison: Optional[Union[Comparison, ArtifactLike]] = None,
    a_enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    b_enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    *,
    algorithm: Literal['filtered', 'time', 'memory', 'hierarchical'] = 'filtered',
    keep: Literal['contributing', 'minimal'] = 'contributing',
    mode: Literal['balanced', 'inner', 'outer'] = 'balanced',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> MinkowskiSumOutputs:
    """The Minkowski sum of two unions of balls: again a union of balls.

    The sums (c + c', r + r') of a ball of either set that contribute to the union of all: those with a
      point in the closed ball to which the power is strictly smaller than to all other sums, decided
      exactly. Their union is the Minkowski sum of the unions. Every algorithm gives the same balls,
      whichever set is a, in an order of their own. Accepts any balls: none, one (the sum is then an
      offset), equal, nested, flat sets, radius 0. Refuses coordinates and radii that are not 0 and outside
      [1e-150, 1e150], and more sums than the memory holds.

    When not to use it: an input is a thin sheet, which needs very many balls for a smooth surface, or both
      are convex polytopes: their sum is exact and quick elsewhere.

    Inputs:
        a (Balls): balls, model units; few: prune them
        b (Balls): balls, model units; one ball at the origin grows the other set by its radius
        a_comparison (Comparison, optional): a and the closed mesh of its solid, compared: gives the error
          bound; without it the solid is the union of a
        b_comparison (Comparison, optional): the same of b
        a_enclosure (Enclosure, optional): what VerifyEnclosure proved of a and the mesh of its solid: gives
          bounds both ways, and with mode inner or outer the proof that the sum is bounded from that side
        b_enclosure (Enclosure, optional): the same of b

    Outputs:
        balls (Balls): the sums that are kept, ascending by x, y, z of the center
        report (MinkowskiReport): numbers of pairs, of balls that contribute, are needed and visible;
          bounding box, error bound

    Parameters:
        algorithm (choice, default "filtered"): how the sums are found; the balls are the same
            filtered: streams the pairs through a grid of large sums and triangulates those inside none of
              them
            time: triangulates all pairs at once: algo_time of the thesis
            memory: inserts a pair only when it contributes so far, and tests what is left again: algo_mem
              of the thesis; the least memory, and some ten times slower
            hierarchical: passes by pairs below nodes of octrees whose balls around all contribute nothing
              (thesis, 5.3.2)
        keep (choice, default "contributing"): which sums are kept; the union is the same
            contributing: all sums that contribute
            minimal: a part of them with the same union, of which no ball can go (see MinimalUnion); takes
              longer
        mode (choice, default "balanced"): which side of the sum of the solids the balls of a and b are made
          for
            balanced: sums are rounded to nearest
            inner: sums are rounded inwards: balls inside give a sum inside
            outer: sums are rounded outwards: balls that enclose give a sum that does

    Sources: kornberger2010, 5.1 to 5.3 and 5.5; aurenhammer1988, Lemma 1; seidel1991, 2
    """
    ...


class MinkowskiSum2Outputs(NamedTuple):
    balls: Balls
    report: MinkowskiReport

def minkowski_sum2(
    a: Union[Balls, ArtifactLike],
    b: Union[Balls, ArtifactLike],
    a_comparison: Optional[Union[OutlineComparison, ArtifactLike]] = None,
    b_comparison: Optional[Union[OutlineComparison, ArtifactLike]] = None,
    a_enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    b_enclosure: Optional[Union[Enclosure, ArtifactLike]] = None,
    *,
    algorithm: Literal['filtered', 'quadratic', 'hierarchical'] = 'filtered',
    keep: Literal['contributing', 'minimal'] = 'contributing',
    mode: Literal['balanced', 'inner', 'outer'] = 'balanced',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> MinkowskiSum2Outputs:
    """The Minkowski sum of two unions of discs: again a union of discs.

    As MinkowskiSum, of balls with z = 0, and the same balls, from a triangulation of the plane: the sums of
      a disc of either set that have a point in the closed disc to which the power is strictly smaller than
      to all other sums, decided exactly. Every algorithm gives the same discs. The summary of `report` adds
      avoided, the pairs that the tree of algorithm hierarchical never looked at. Accepts any discs: none,
      one, equal, nested, on a line, radius 0. Refuses centers with another z, coordinates and radii that
      are not 0 and outside [1e-150, 1e150], and more sums than the memory holds.

    When not to use it: the sum of the polygons themselves is wanted: it is exact and quick with CGAL's
      minkowski_sum_2; discs pay off where shapes are discs already, or round.

    Inputs:
        a (Balls): discs, model units: balls with z = 0
        b (Balls): the same; one disc at the origin grows the other set by its radius
        a_comparison (OutlineComparison, optional): the polygon that a stands for, compared with a polygon
          inside the union of a: gives the error bound; without it a stands for itself
        b_comparison (OutlineComparison, optional): the same of b
        a_enclosure (Enclosure, optional): what VerifyEnclosure proved of a and the meshes of its polygon
          (PolygonMeshes): bounds both ways, and with mode inner or outer the proof that the sum is bounded
          from that side
        b_enclosure (Enclosure, optional): the same of b

    Outputs:
        balls (Balls): the sums that are kept, ascending by x, y of the center, z = 0
        report (MinkowskiReport): numbers of pairs, of discs that contribute, are needed and visible;
          bounding box, error bound

    Parameters:
        algorithm (choice, default "filtered"): how the sums are found; the discs are the same
            filtered: streams the pairs through a grid of large sums and triangulates those inside none of
              them
            quadratic: triangulates all pairs: algo_sq of the thesis
            hierarchical: passes by pairs below nodes of quadtrees whose discs around all contribute
              nothing: algo_h of the thesis, without inserting and removing them
        keep (choice, default "contributing"): which sums are kept; the union is the same
            contributing: all sums that contribute
            minimal: a part of them with the same union in the plane, of which no disc can go (see
              MinimalUnion); takes longer
        mode (choice, default "balanced"): which side of the sum of the polygons the discs of a and b are
          made for
            balanced: sums are rounded to nearest
            inner: sums are rounded inwards: discs inside give a sum inside
            outer: sums are rounded outwards: discs that enclose give a sum that does

    Sources: kornberger2010, 5.3 and 5.4; aurenhammer1988, Lemma 1; seidel1991, 2
    """
    ...


def mirror(
    balls: Union[Balls, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """Balls mirrored at the origin: every center c becomes -c.

    Minkowski sums with mirrored balls tell where something meets something else: p lies in obstacles +
      (-robot) exactly where the robot, moved by p, meets the obstacles. The origin is that of the
      coordinates, whatever the balls are: it is the point of the robot whose places the sum is about.
      Exact; radii and order stay. Accepts any balls, also none.

    When not to use it: the robot is symmetric about its origin: it is its own mirror image.

    Inputs:
        balls (Balls): balls, model units; the origin is what they are placed by

    Outputs:
        balls (Balls): the balls (-c, r), in the same order

    Sources: kornberger2010, 5.1; lozano1983, obstacles in the space of configurations
    """
    ...


def one_sided_balls(
    mesh: Union[TriangleMesh, ArtifactLike],
    balls: Union[Balls, ArtifactLike],
    solid: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    side: Literal['inner', 'outer'] = 'outer',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """Give balls other radii, so that they lie inside a solid, or contain it.

    Keeps the centres. Side inner: every radius becomes the distance of the centre from the surface; centres
      that are not inside are left out. Side outer: radii begin with these, the triangles are cut into
      parts, and every part makes the ball grow that holds it with least growth, those that need most first;
      a void that the balls close off inside gets a ball that touches the surface. VerifyEnclosure proves
      what came out: a protrusion of 0, or that the balls enclose. Inner refuses meshes that are not closed;
      outer takes any, as VerifyEnclosure does. Refuses meshes without triangles.

    When not to use it: a number of balls is given, and centres are free: EncloseBalls, InsideBalls; they
      take longer, and waste less with few balls.

    Inputs:
        mesh (TriangleMesh): m triangles, model units; orientation does not matter
        balls (Balls): n balls of the same model, in the same place and unit
        solid (TriangleMesh, optional): a closed mesh whose inside and surface count in place of the mesh's,
          which is then what has to be covered: for discs the prism of PolygonMeshes

    Outputs:
        balls (Balls): balls with the same centres, in the same order, without those left out; fillings last

    Parameters:
        side (choice, default "outer"): which side of the surface the balls bound it from
            inner: every ball lies inside the solid
            outer: the union contains the solid

    Sources: kornberger2010, 3.4, 3.5 and 5.2
    """
    ...


class PathBallsOutputs(NamedTuple):
    balls: Balls
    path: Path

def path_balls(
    *,
    file: FileLike,
    scale: str = '1',
    width: float = 0.0,
    spacing: str = '0.5%',
    side: Literal['outer', 'inner'] = 'outer',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> PathBallsOutputs:
    """A polyline as balls, so that a Minkowski sum moves something along it.

    Reads points, x y z and perhaps a radius a line, and puts balls around them and between them. Side
      outer: their union contains the path, so that the sum with a tool contains everything that the tool
      sweeps: between two centers at a distance h radii r become sqrt(r^2 + h^2 / 4), half the spacing where
      the path is a line. Side inner: they lie in the path. The path says how far they are off. One point is
      a path: the tool in one place. Points that repeat the one before count once. Refuses a path without
      points, numbers that are not finite, negative radii, and rows that differ in length.

    When not to use it: the tool turns on its way: sums move it without turning.

    Outputs:
        balls (Balls): balls along the path, in its order
        path (Path): the polyline, and how far the balls are from it

    Parameters:
        file (file, required): a file of rows x y z or x y z radius (CSV, blanks, names of columns; also
          .gz), or the points themselves: "path:0 0 0; 1 0 0"
        scale (string, default "1"): of coordinates, radii and width: a factor, or the unit of the lengths
          in the file, which become metres (um, mm, cm, dm, m, km, mil, in, ft, yd)
        width (number, default 0.0, model units before scale, >= 0.0): of the path where the file has no
          radii, twice the radius; 0: a line
        spacing (string, default "0.5%"): centers are no farther apart along the path: a length in model
          units, or a share of the longest edge of its bounding box ("0.5%")
        side (choice, default "outer"): which side of the path the balls bound it from
            outer: the balls contain the path
            inner: the balls lie in the path

    Sources: kornberger2010, 5.1 and 5.2; edelsbrunner1995, balls between two balls
    """
    ...


class PolygonMeshesOutputs(NamedTuple):
    flat: TriangleMesh
    prism: TriangleMesh

def polygon_meshes(
    polygon: Union[Polygon2, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> PolygonMeshesOutputs:
    """Triangles that tile a polygon, and a prism over it.

    So that what nodes prove of meshes in space holds in the plane: balls with z = 0 contain `flat` where
      the discs contain the polygon, and reach out of `prism` where the discs reach out of the polygon. The
      prism is high enough for all discs that are no larger than the polygon. Accepts polygons with holes,
      of several components. Refuses rings that cross or touch.

    When not to use it: a solid is wanted: a prism of a height of one's own is made elsewhere.

    Inputs:
        polygon (Polygon2): polygons, model units

    Outputs:
        flat (TriangleMesh): triangles in the plane z = 0: the polygon, open as a surface
        prism (TriangleMesh): the closed surface of the polygon from z = -2 L to 2 L, L its longest
          bounding-box edge

    Sources: ruppert1995, 1: constrained Delaunay triangulations
    """
    ...


def power_diagram(
    balls: Union[Balls, ArtifactLike],
    *,
    tolerance: Literal['none', 'polar'] = 'none',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> PowerDiagram:
    """The power diagram of balls, by its dual: made once, for all that look at their union.

    The regular triangulation of the balls with the neighbours of every cell, and which cells and facets are
      in the dual complex of the union, decided exactly. AlphaShape, MedialAxis, UnionMeasure, UnionTopology
      and TopologyRepair take it instead of triangulating again. Accepts and refuses what AlphaShape does;
      of balls with one center the largest counts, the first of equal ones.

    When not to use it: only one node looks at the union: it can take the balls themselves.

    Inputs:
        balls (Balls): n closed balls, model units

    Outputs:
        diagram (PowerDiagram): cells, neighbours and flags over the n balls

    Parameters:
        tolerance (choice, default "none"): what is added to squared radii before anything is decided
            none: the balls are taken as they are: enlarged or other balls in general position
            polar: 2^-36 of the squared longest bounding-box edge is added to every squared radius, so that
              polar balls through one sample overlap whatever rounding says; recorded as delta

    Sources: kornberger2010, 2.5 and 2.6; edelsbrunner1995, the union of balls and its dual shape
    """
    ...


def principal_scaling(
    points: Union[PointSet, ArtifactLike],
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    axes: Literal['principal', 'normals', 'coordinates'] = 'principal',
    factors: Literal['chords', 'extents', 'given'] = 'chords',
    stretch: float = 1.0,
    first: float = 1.0,
    second: float = 1.0,
    third: float = 1.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Scaling:
    """Axes and factors that make thin directions of an object thick.

    Balls approximate thin objects badly: a sheet needs one every few thicknesses. Where the object is
      stretched along perpendicular axes until it is about as thick in all directions, balls of it are
      ellipsoids of the object. The axes are the principal ones of the solid, those of its normals, or the
      coordinates'; the factor along each is the largest mean chord over the mean chord along it, a chord
      being a piece of a line in the solid: for a box that is the ratio of its edges, for a bent sheet its
      thickness counts and not how far it is bent. Surfaces that are not closed, and clouds, go by the
      extents of their boxes. The least factor is 1. Warns where there is nothing to win; refuses flat
      objects.

    When not to use it: the object is thin in directions that change a lot (a bowl, a ring of sheet): one
      frame does not fit it.

    Inputs:
        points (PointSet): points of the object; they count where there is no mesh
        mesh (TriangleMesh, optional): its surface, best closed

    Outputs:
        scaling (Scaling): origin, axes and factors; ApplyScaling and ScaleBack use it

    Parameters:
        axes (choice, default "principal"): along which axes the object is stretched
            principal: of the second moments of the solid, the surface or the points
            normals: the third axis is where most of the surface faces
            coordinates: those of the coordinates
        factors (choice, default "chords"): by how much
            chords: by mean chords of the solid; by extents where it is not closed
            extents: by the edges of its box along the axes
            given: first, second and third, divided by the least of them
        stretch (number, default 1.0, 1, >= 0.0, <= 1000.0): factors f of the rule become 1 + stretch (f -
          1): 0 gives balls
        first (number, default 1.0, 1, > 0.0): factors = given: along the axis with the largest moment
        second (number, default 1.0, 1, > 0.0): factors = given: along the second axis
        third (number, default 1.0, 1, > 0.0): factors = given: along the third axis, the thin one

    Sources: kornberger2010, 6.4; bischoff2002, ellipsoids in place of balls
    """
    ...


class ProtrudeBallsOutputs(NamedTuple):
    balls: Balls
    fit: EnclosureFit

def protrude_balls(
    mesh: Union[TriangleMesh, ArtifactLike],
    count: Optional[Union[BallCounts, ArtifactLike]] = None,
    *,
    balls: int = 20,
    rounds: int = 3,
    seed: int = 1,
    within: float = 1.0,
    unit: Literal['percent', 'model'] = 'percent',
    goal: Literal['surface', 'volume'] = 'surface',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    progress: Progress = None,
) -> ProtrudeBallsOutputs:
    """A given number of balls that stand out of a solid by no more than a distance, and cover as much as they
      can.

    No point of a ball is farther than the distance from the solid: its centre is inside, and its radius the
      distance to the surface and that one. Chosen and moved as by InsideBalls. Refuses meshes that are not
      closed.

    When not to use it: nothing of the solid may be outside of the balls: EncloseBalls.

    Inputs:
        mesh (TriangleMesh): a closed mesh, model units; orientation does not matter
        count (BallCounts, optional): how many balls, in place of the parameter: one count, of AllocateBalls

    Outputs:
        balls (Balls): at most as many balls as wanted
        fit (EnclosureFit): how many they are, and about how much they leave uncovered

    Parameters:
        balls (integer, default 20, balls, >= 1, <= 5000): no more balls than this
        rounds (integer, default 3, rounds, >= 0, <= 1000): of the local search: each moves or exchanges
          every ball once; it ends when nothing changes
        seed (integer, default 1, number, >= 0): other seeds find other balls that cover about as much
        within (number, default 1.0, see unit, >= 0.0): how far balls may stand out
        unit (choice, default "percent"): what within is measured in
            percent: % of the longest bounding-box edge
            model: model units
        goal (choice, default "surface"): what they are to cover
            surface: little of the surface is in no ball
            volume: little of the volume is in no ball

    Sources: ma2012, largest inner balls through points of the surface
    """
    ...


def read_polygon(
    *,
    file: FileLike,
    scale: str = '1',
    y: Literal['auto', 'up', 'down'] = 'auto',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Polygon2:
    """Reads polygons in the plane, with holes and in several parts, or makes them.

    Reads .poly2d (numbers of rings and points, then x y), WKT, GeoJSON and the straight shapes of SVG
      (path, polygon, rect, under transforms), each also packed with gzip or zstd; the content decides.
      Rings may run either way: a ring inside an odd number of others is a hole. Repeated points are left
      out. Refuses, with the place, rings that cross or touch themselves or each other, decided exactly,
      rings of fewer than three points or without area, WKT and GeoJSON whose holes are none, curves, and
      coordinates that are not finite. GeoJSON and WKT are taken to be in a plane.

    When not to use it: polygons overlap: make their union first; or coordinates are degrees: project them
      first.

    Outputs:
        polygon (Polygon2): the polygons: outer rings counter-clockwise, holes clockwise

    Parameters:
        file (file, required): a file, or polygon:NAME for a generated one: square, regular, star, gear,
          frames, comb, sqroot, euro (polygon:star?n=7&R=2&r=0.8)
        scale (string, default "1"): of all coordinates: a factor, or the unit of the lengths in the file,
          which become metres (um, mm, cm, dm, m, km, mil, in, ft, yd)
        y (choice, default "auto"): which way the y axis of the file points; that of the polygon points up
            auto: down in SVG, up in other formats
            up: as in mathematics and on maps
            down: as on screens: the shape is turned over

    Sources: kornberger2010, 5.4; shamos1976, intersection of segments; rfc7946, 3.1.6
    """
    ...


def read_robot(
    *,
    file: FileLike,
    geometry: Literal['collision', 'visual'] = 'collision',
    packages: str = '',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Robot:
    """Reads a robot from its URDF: links with their surfaces, and joints.

    Links, joints with origins, axes, limits and mimics, and the collision or visual shapes of every link in
      its frame, in metres: meshes (STL, OBJ, PLY, OFF, also packed, and Collada with its unit, whose up
      axis is not applied), with scale and origin, boxes, cylinders and spheres, several for a link. All
      triangles are kept. Cylinders and spheres become polyhedra around them, which stand out by at most 0.4
      % of the radius, so that what contains the polyhedron contains the shape. Meshes are looked for where
      package://, file:// and relative paths say, then by their names below the folder of the URDF and below
      packages, with a warning; their contents are in the key. Refuses, with the line, what is no tree of
      links, names twice, unknown shapes, a scale of 0, numbers that are not finite, meshes that are
      nowhere, SDF, MJCF, and xacro with the command that expands it.

    When not to use it: one mesh is all there is: Sample reads that.

    Outputs:
        robot (Robot): links with their surfaces in metres, and joints

    Parameters:
        file (file, required): a URDF, also packed; or robot:arm, a small robot of boxes, cylinders and
          spheres
        geometry (choice, default "collision"): which shapes of the links are taken
            collision: the shapes that are meant for collisions
            visual: the shapes that are meant to be seen
        packages (string, default ""): folders, separated by colons, in which ROS packages or meshes are;
          contents of meshes are in the key, places are not

    Sources: quigley2015, the format, chapter 4
    """
    ...


def reduce(
    cover: Union[CoverState, ArtifactLike],
    *,
    subset_test: Literal['inverted_index', 'hash', 'bandwidth'] = 'inverted_index',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverState:
    """Remove dominated balls, dominating samples and essential balls; the optimum stays.

    Applies the three reduction rules of set covering in synchronous passes until none applies. Essential
      balls are chosen. Among equal rows or columns the one of lowest index stays, so every subset_test
      gives the same residual matrix.

    When not to use it: a greedy cover is good enough: Greedy alone is faster on the whole matrix.

    Inputs:
        cover (CoverState): any state of a set covering computation

    Outputs:
        cover (CoverState): the same instance: essential balls chosen, a smaller matrix

    Parameters:
        subset_test (choice, default "inverted_index"): how candidates for an inclusion are found: changes
          the time, not the result
            inverted_index: compares with the sets that share the rarest element
            hash: compares signatures of 64 sections with those of all other sets: quadratic, for comparison
            bandwidth: compares with the sets nearby after a bandwidth-reducing permutation, for comparison

    Sources: kornberger2010, 3.6.1 and 3.8.2; cuthill1969, 2
    """
    ...


class RefineOutputs(NamedTuple):
    points: PointSet
    surface: TriangleMesh
    report: Refinement

def refine(
    mesh: Union[TriangleMesh, ArtifactLike],
    points: Optional[Union[PointSet, ArtifactLike]] = None,
    topology: Optional[Union[TopologyTable, ArtifactLike]] = None,
    *,
    when: Literal['closed', 'always', 'never'] = 'closed',
    delta: float = 0.5,
    floor: float = 0.05,
    lowest_floor: float = 2e-05,
    wall_fraction: float = 0.4,
    sharp: float = 30.0,
    keep_points: bool = False,
    max_samples: int = 500000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> RefineOutputs:
    """Choose samples of a closed surface that are dense where its shape asks for it.

    The vertices of a part say little about its shape: a cube has 8, and they make one ball of twice its
      volume. This node starts from corners, sharp edges and some other points, and inserts points of the
      surface until no ball through four samples reaches farther than delta to the wrong side of it, or
      through a wall or slot that is thin; until the Delaunay cells with their centre inside the solid have
      a surface as their boundary, and the topology of the solid; and until the union of all inner balls has
      it too. Whether it has is in the report, with the places where walls and slots are thinner than the
      floor allows. It needs the balls of all inner Voronoi vertices (VoronoiPoles, vertices = all): with
      poles alone thin walls open. Which side a centre is on is decided exactly. Surfaces that are not
      closed, and clouds, have no inside to follow: their points are returned as they are (when = closed) or
      refused.

    When not to use it: the vertices of a dense scan are wanted as samples: connect them directly.

    Inputs:
        mesh (TriangleMesh): the surface of a solid
        points (PointSet, optional): samples that are returned where nothing is refined, and kept with
          keep_points
        topology (TopologyTable, optional): SolidTopology of the mesh; without it the inner cells say what
          topology the balls should have

    Outputs:
        points (PointSet): n samples on the surface, pairwise distinct
        surface (TriangleMesh): the boundary of the inner Delaunay cells, a triangulation of the samples
          with the topology that the report says; without triangles where nothing was refined
        report (Refinement): what was reached, and where it was not

    Parameters:
        when (choice, default "closed"): which surfaces are refined
            closed: refine closed surfaces, return the points of others
            always: refuse surfaces that are not closed, saying why
            never: return the points that come in
        delta (number, default 0.5, % of the longest bounding-box edge, > 0.0, <= 10.0): how far a ball may
          reach to the wrong side of the surface; half of it takes about twice as many samples on curved
          surfaces
        floor (number, default 0.05, % of the longest bounding-box edge, > 0.0, <= 10.0): balls that reach
          less far are let be whatever lies behind: walls and slots far thinner than this are left to the
          topology
        lowest_floor (number, default 2e-05, % of the longest bounding-box edge, >= 1e-05, <= 10.0): where
          the topology asks for it the floor sinks, to 0.0005 % at first, to this if that fails
        wall_fraction (number, default 0.4, 1, >= 0.05, <= 0.5): a ball may reach into this fraction of the
          wall or slot behind the surface
        sharp (number, default 30.0, degrees, >= 1.0, <= 180.0): edges whose triangles turn by more are
          sampled from the start
        keep_points (boolean, default false): take the points that come in as samples too, before all others
        max_samples (integer, default 500000, samples, >= 1000, <= 100000000): stop there, and say so

    Sources: boissonnat2005, Delaunay refinement of a surface, here of any closed mesh by all its balls;
      kornberger2010, 3.4, the balls it is for
    """
    ...


def restore_samples(
    mesh: Union[TriangleMesh, ArtifactLike],
    report: Union[SurfaceReport, ArtifactLike],
    balls: Union[Balls, ArtifactLike],
    original: Union[PointSet, ArtifactLike],
    *,
    keep: bool = True,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TriangleMesh:
    """Put a surface through denoised samples back onto the samples.

    Every vertex that is the centre of a surface ball moves to the sample of that ball as it came, before
      Denoise; midpoints stay. The triangles stay, so the mesh is closed, oriented and manifold as before,
      but where samples moved farther than triangles are wide some may cross. Without denoising nothing
      changes. With keep = false the mesh is handed on. Refuses reports, balls and samples that do not
      belong to the mesh.

    When not to use it: a smooth surface is wanted: the noise comes back (keep = false).

    Inputs:
        mesh (TriangleMesh): the surface, as SurfaceMesh makes it
        report (SurfaceReport): its report
        balls (Balls): the kept surface balls
        original (PointSet): all samples as they came

    Outputs:
        mesh (TriangleMesh): the surface, its vertices unmoved samples

    Parameters:
        keep (boolean, default true): false: vertices stay where denoising moved them

    Sources: kornberger2010, 4.5.3, whose vertices are samples
    """
    ...


def robot_link(
    robot: Union[Robot, ArtifactLike],
    *,
    link: str,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TriangleMesh:
    """The surface of one link of a robot, in the frame of the link.

    Its bytes depend on the shapes of this link alone: where another link or a joint changes, what is made
      of this mesh stays in the cache. Refuses names that are no link, and links without a surface.

    When not to use it: the robot is a single mesh file: Sample.

    Inputs:
        robot (Robot): links with their surfaces

    Outputs:
        mesh (TriangleMesh): m triangles in the frame of the link, metres

    Parameters:
        link (string, required): name of the link

    Sources: quigley2015, links
    """
    ...


def robot_spheres(
    robot: Union[Robot, ArtifactLike],
    balls: Sequence[Union[Balls, ArtifactLike]] = ...,
    enclosures: Sequence[Union[Enclosure, ArtifactLike]] = ...,
    *,
    links: str = '',
    poses: int = 2000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> RobotSpheres:
    """Puts the balls of the links of a robot together, and lists pairs that need no test.

    Pairs of links that need no test against each other: adjacent ones, pairs whose balls meet in the
      default pose, in every pose, or in none. Poses are sampled, not proven: random values between the
      limits of the joints, always the same ones. Refuses names that are no links, and more or fewer lists
      than links.

    When not to use it: balls belong to no robot: they can be exported as they are.

    Inputs:
        robot (Robot): links and joints
        balls (Balls, several in order): for each link of links, in the frame of the link, metres
        enclosures (Enclosure, several in order, optional): for each link of links, whether its balls
          contain it: points that they leave out go with the balls

    Outputs:
        spheres (RobotSpheres): links with balls, joints, pairs, points that are left out

    Parameters:
        links (string, default ""): names of the links, separated by commas or a JSON list, in the order of
          balls; empty: those with a surface, in that of the robot
        poses (integer, default 2000, poses, >= 0, <= 10000000): that are tried for pairs of links; 0: none
          is looked for

    Sources: coleman2014, pairs of links by sampled poses
    """
    ...


class SampleOutputs(NamedTuple):
    points: PointSet
    mesh: TriangleMesh

def sample(
    *,
    file: FileLike,
    scale: str = '1',
    weld: str = '0',
    strays: Literal['keep', 'drop'] = 'keep',
    mode: Literal['vertices', 'surface'] = 'vertices',
    spread: Literal['poisson', 'random'] = 'poisson',
    count: int = 10000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> SampleOutputs:
    """Reads a model, or makes one, and samples its surface.

    Reads OFF, OBJ, PLY, STL and points as text (XYZ, PTS, PWN, CSV, ASC, also under column names and with
      decimal commas), each also packed with gzip or zstd; content that belies the name of its file is read
      as what it is, with a warning. Welds equal vertices, drops degenerate and repeated faces, also walls
      that are there twice, triangulates polygons inside themselves and, where there are faces, drops
      vertices in none, and says how many. Refuses files that are cut off or damaged, coordinates that are
      not finite, indices out of range, commas that may separate or be decimal, and points in one plane.

    When not to use it: the model needs repair first: holes and self-intersections stay as they are

    Outputs:
        points (PointSet): n samples: the vertices of the model, or points on its faces
        mesh (TriangleMesh): the model; no vertices and no triangles for a cloud of points

    Parameters:
        file (file, required): a model file, or shape:NAME for a generated one
          (shape:torus?R=1&r=0.3&n=20000; see Shape)
        scale (string, default "1"): of all coordinates: a factor, or the unit of the lengths in the file,
          which become metres (um, mm, cm, dm, m, km, mil, in, ft, yd)
        weld (string, default "0"): vertices of the file this near to each other become one: a length in
          model units (after scaling), or a share of the longest edge of the bounding box (0.01%); 0: only
          equal ones. A warning names the tolerance that closes an open mesh whose gaps are small
        strays (choice, default "keep"): the few points of the file (at most a hundredth) that stretch the
          bounding box tenfold or more, and no triangle joins with the others
            keep: they stay, and a warning names them
            drop: they are left out, with a warning
        mode (choice, default "vertices"): what becomes a sample
            vertices: the vertices of the model, in the order of the file
            surface: count points on the faces
        spread (choice, default "poisson"): how points lie on the faces; mode surface only
            poisson: evenly spaced: five times as many random points, thinned out
            random: independent and uniform by area
        count (integer, default 10000, points, >= 4, <= 2000000): number of points; mode surface only

    Sources: kornberger2010, 3.4 and 3.9; yuksel2015, 3
    """
    ...


def sample_mesh(
    mesh: Union[TriangleMesh, ArtifactLike],
    *,
    spread: Literal['poisson', 'random'] = 'poisson',
    count: int = 10000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> PointSet:
    """Points spread over the surface of a mesh, with normals.

    What Sample does with mode surface, for a mesh that another node made. Accepts any triangles, open and
      non-manifold ones too. Refuses a mesh without area.

    When not to use it: the samples are to follow the shape: Refine chooses such.

    Inputs:
        mesh (TriangleMesh): m triangles, model units

    Outputs:
        points (PointSet): n points on the triangles, with their normals

    Parameters:
        spread (choice, default "poisson"): how points lie on the faces
            poisson: evenly spaced: five times as many random points, thinned out
            random: independent and uniform by area
        count (integer, default 10000, points, >= 4, <= 2000000): number of points

    Sources: yuksel2015, 3
    """
    ...


def scale_back(
    balls: Union[Balls, ArtifactLike],
    scaling: Union[Scaling, ArtifactLike],
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    search: Optional[Union[Bisection, ArtifactLike]] = None,
    *,
    growth: Literal['axes', 'scaled'] = 'axes',
    epsilon: float = 0.3,
    max_error: float = 0.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Ellipsoids:
    """Balls of a stretched object as ellipsoids of the object, enlarged.

    The ellipsoid of a ball is its image in the object's own space; there it grows by epsilon, or by
      max_error in model units. No point of it is then farther than that from the image, and with `mesh`,
      the stretched surface, which shortens balls that stand out, no farther from the solid: the error is
      proven in the object's own space, whatever the factors. Growth axes enlarges all three half-axes;
      scaled enlarges the ball before it is scaled back, which covers less, and keeps unions images of
      unions of balls. Every ball becomes an ellipsoid, in the same order, but for those of radius 0 that do
      not grow.

    When not to use it: nothing is stretched: Enlarge grows balls, and knows their topology.

    Inputs:
        balls (Balls): inner balls of the stretched object
        scaling (Scaling): how it was stretched
        mesh (TriangleMesh, optional): the stretched surface: balls reach to it and not beyond
        search (Bisection, optional): a search for epsilon (see Bisect): its value replaces epsilon and
          max_error

    Outputs:
        ellipsoids (Ellipsoids): in the object's own space

    Parameters:
        growth (choice, default "axes"): what grows by e
            axes: half-axes r / f + e: far fewer pieces
            scaled: half-axes (r + e) / f, as in the thesis: images of grown balls
        epsilon (number, default 0.3, % of the longest bounding-box edge of the object, >= 0.0): how much
          the ellipsoids grow, and how far they may be from the solid at most
        max_error (number, default 0.0, model units, >= 0.0): in place of epsilon; 0: epsilon counts

    Sources: kornberger2010, 6.4
    """
    ...


def select_balls(
    cover: Union[CoverState, ArtifactLike],
    balls: Union[Balls, ArtifactLike],
    *,
    allow_unfinished: bool = False,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """Take the balls that a set cover chose.

    The chosen balls in the order of their indices, with their defining samples. Refuses a cover about
      another number of balls, and one that leaves samples to be covered (unless allowed).

    When not to use it: all balls are wanted: connect them directly.

    Inputs:
        cover (CoverState): a finished cover: remaining = 0
        balls (Balls): the balls the covering matrix was made of, row i is ball i

    Outputs:
        balls (Balls): the chosen balls, ascending by index

    Parameters:
        allow_unfinished (boolean, default false): take what is chosen so far although samples remain to be
          covered

    Sources: kornberger2010, 3.6
    """
    ...


def select_ellipsoids(
    cover: Union[CoverState, ArtifactLike],
    ellipsoids: Union[Ellipsoids, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Ellipsoids:
    """Take the ellipsoids that a set cover chose.

    The chosen ellipsoids in the order of their indices. Refuses a cover of another number of ellipsoids,
      and one that leaves samples to be covered.

    When not to use it: all ellipsoids are wanted: connect them directly.

    Inputs:
        cover (CoverState): a finished cover: remaining = 0
        ellipsoids (Ellipsoids): those that the matrix was made of

    Outputs:
        ellipsoids (Ellipsoids): the chosen ones, ascending by index

    Sources: kornberger2010, 3.6 and 6.4
    """
    ...


class ShapeOutputs(NamedTuple):
    points: PointSet
    mesh: TriangleMesh

def shape(
    *,
    shape: Literal['sphere', 'torus', 'doubleTorus', 'torusBalls', '3cross', 'knot', 'sTube', 'box', 'bracket', 'frame', 'bumpBox'] = 'torus',
    n: int = 0,
    R: float = 0.0,
    r: float = 0.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ShapeOutputs:
    """Makes a model from a formula, smooth or sharp, of known genus.

    The mesh is closed, manifold, outward oriented and connected; the vertices of the smooth shapes lie on
      the surface up to rounding and are evenly spaced. The models of Kornberger 2010 that were never
      published have stand-ins of the same names and sizes. Refuses sizes out of range and fewer vertices
      than the features of the shape need.

    When not to use it: the model is in a file: use Sample

    Outputs:
        points (PointSet): the vertices of the mesh
        mesh (TriangleMesh): the surface

    Parameters:
        shape (choice, default "torus"): which model; says what R and r are
            sphere: R: radius; r is not used
            torus: R: radius of the core circle, r: of the tube
            doubleTorus: (x^2 (1 - x^2) - y^2)^2 + (z^2 - r^2) / 2 = 0 times R: r is half its height
            torusBalls: a torus with six balls of radius 2.1 r smoothly joined; R: radius of the core
              circle, r: of the tube
            3cross: three rounded bars of length 2 R and width 2 r, smoothly joined
            knot: a tube of radius r around a trefoil of radius 3 R
            sTube: a tube of radius r with round ends around a sine of length 4 R
            box: a sharp-edged box of 2 R by 2 R by 2 r
            bracket: a sharp-edged L of two plates of length R, width 0.8 R and thickness r, with a square
              hole in one
            frame: a cube of edge 2 R less a ball of radius r above R around its middle: its edges
            bumpBox: a box of 2 R by 0.8 R by 0.6 R with a bump on its top, r from one of its ends: a family
              of shapes that differ in one number
        n (integer, default 0, vertices, >= 0, <= 5000000): about how many vertices; 0 takes the number of
          the thesis' model or 10000 to 40000
        R (number, default 0.0, model units, >= 0.0): the large size of the shape; 0 takes 1
        r (number, default 0.0, model units, >= 0.0): the small size of the shape; 0 takes the shape's own
          proportion to R

    Sources: kornberger2010, 3.9, 4.9 and 5.4; gibson1998, 2
    """
    ...


class ShapeFitOutputs(NamedTuple):
    fit: ShapeFit
    balls: Balls
    points: PointSet

def shape_fit(
    prior: Union[ShapePrior, ArtifactLike],
    points: Optional[Union[PointSet, ArtifactLike]] = None,
    balls: Optional[Union[Balls, ArtifactLike]] = None,
    pose: Optional[Union[ShapePose, ArtifactLike]] = None,
    *,
    effective: float = 30.0,
    width: float = 10.0,
    scale: bool = False,
    modes: int = 0,
    points_: int = 2000,
    iterations: int = 100,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ShapeFitOutputs:
    """The most plausible whole shape of a model for an observation of a part of it.

    Scores and pose of the model given points on the surface, or balls, of a part: posterior mean and
      covariance. Every point comes from a Gaussian around a part of the shape or, as an outlier, from
      anywhere; parts that nobody has seen are drawn nowhere. Points of one surface do not err
      independently, so all of them count as `effective` independent ones. Says how far the observation is
      from the model: its distance from the shape against that of unknown instances from models without
      them, how much of it no part explains, how unusual the scores are; each is a warning where it is
      large. Refuses fewer than 4 points, and an observation that lies nowhere near the model.

    When not to use it: the observation shows all of the shape: Match keeps what the model does not know;
      and where the mean alone is wanted (modes = 1 comes near it, ShapeInstance without scores is it).

    Inputs:
        prior (ShapePrior): mean and modes
        points (PointSet, optional): on a part of the surface; normals are used where given
        balls (Balls, optional): of a part of the shape, where there are no points
        pose (ShapePose, optional): from the observation to the coordinates of the model, about 10 degrees
          right; else it lies there already

    Outputs:
        fit (ShapeFit): scores with covariance, pose, distances
        balls (Balls): the fitted shape, in the coordinates of the observation
        points (PointSet): its surface points, without normals

    Parameters:
        effective (number, default 30.0, observations, > 0.0, <= 1000000.0): as many independent ones are
          all points together: fewer stay nearer to the mean; 10 to 50
        width (number, default 10.0, % of the root mean square radius of the model, > 0.0, <= 1000.0): how
          far correspondences are looked for at the beginning
        scale (boolean, default false): the shape may be scaled, too: for models of scaled instances
        modes (integer, default 0, modes, >= 0, <= 10000): at most; 0: all of the model
        points_ (integer, default 2000, points, >= 4, <= 1000000): of the observation that are used, at most
        iterations (integer, default 100, steps, >= 1, <= 10000): at most

    Sources: myronenko2010, points as a mixture of Gaussians around a shape; cootes1995, shapes by their
      scores; kornberger2010, 6.3.1
    """
    ...


class ShapeInstanceOutputs(NamedTuple):
    balls: Balls
    points: PointSet

def shape_instance(
    prior: Union[ShapePrior, ArtifactLike],
    *,
    modes: str = '',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ShapeInstanceOutputs:
    """An instance of a model of a shape, as balls and as surface points.

    The mean plus so many standard deviations of each mode; radii by their logarithms, so that they stay
      positive. 0 is the mean, between -2 and 2 lie most instances; beyond 3 in a mode is an extrapolation,
      and a warning says so. Refuses more scores than modes.

    When not to use it: the shape is to go through given points or balls: ShapeFit finds the scores.

    Inputs:
        prior (ShapePrior): mean and modes

    Outputs:
        balls (Balls): k balls, in the coordinates of the model
        points (PointSet): m points on the surface, without normals

    Parameters:
        modes (string, default ""): standard deviations of the first modes, 2,-1 or a JSON list; the others
          are 0; empty: the mean

    Sources: cootes1995, a shape from its parameters
    """
    ...


def shape_mesh(
    prior: Union[ShapePrior, ArtifactLike],
    fit: Optional[Union[ShapeFit, ArtifactLike]] = None,
    *,
    modes: str = '',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TriangleMesh:
    """The mesh of an instance or a fit of a model, with the template's triangles.

    The surface of the shape that the model's template is made of, its vertices drawn along a smooth map
      (polyharmonic spline) from the mean's surface points to those of the instance. The triangles are the
      template's own, and so are genus and number of pieces: a thin blade stays in one piece where its balls
      do not touch. What such a mesh can do is fold, and that is looked for: the summary says how many
      triangles are turned inside out, how many pairs cross and how many of these the mean has already, the
      volume, and how far the vertices are from the union of the balls; a warning says it in words. Of a
      model without a mesh it makes an empty one, with a warning.

    When not to use it: a surface of the balls themselves is wanted, within a bound: BallMesh, which says so
      and whose pieces are those of the union.

    Inputs:
        prior (ShapePrior): mean and modes, with a mesh of the mean
        fit (ShapeFit, optional): whose scores and pose are taken; then no modes

    Outputs:
        mesh (TriangleMesh): in the coordinates of the model, or of what was fitted; the triangles of the
          template

    Parameters:
        modes (string, default ""): standard deviations of the first modes, 2,-1 or a JSON list; the others
          are 0; empty: the mean

    Sources: cootes1995, shapes by their scores; duchon1977, the interpolant
    """
    ...


def shape_prior(
    instances: Sequence[Union[MatchedBalls, ArtifactLike]] = ...,
    meshes: Sequence[Union[TriangleMesh, ArtifactLike]] = ...,
    surface: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    surface_points: Optional[Union[PointSet, ArtifactLike]] = None,
    *,
    balls: Literal['carried', 'replaced'] = 'carried',
    scale: bool = False,
    radius_weight: float = 1.0,
    point_share: float = 0.5,
    along: float = 0.1,
    modes: int = 0,
    draws: int = 200,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> ShapePrior:
    """Learns how a shape varies from several instances of it: mean, modes, and how good they are.

    Superimposes all instances on their mean (generalized Procrustes analysis, no instance is privileged)
      and takes the principal components of balls and surface points. The metric is a mean squared
      displacement: of a point that off the surface and a part of that along it, of a ball dx^2 + dy^2 +
      dz^2 + (w d log r)^2, where w is the mean radius, so that a radius counts as the length by which it
      changes. The model lies in the coordinates of the instance that is most like the mean. Generalization
      leaves one instance out after the other, specificity draws random shapes; both with their standard
      deviations. The order of the instances changes the order of the scores only. Refuses one instance,
      instances without any difference, and such as were matched to different templates; warns of equal
      ones, of mirror images, and of one that is far from all others.

    When not to use it: there are two or three instances, which have one or two modes: enough to try, not to
      know how a shape varies; and for shapes that bend at joints, which no linear modes describe.

    Inputs:
        instances (MatchedBalls, several in order): matched to one template, as many balls and points each
        meshes (TriangleMesh, several in order, optional): surfaces of the instances in their order, for
          distances of the evaluation; else these are measured to tangent planes
        surface (TriangleMesh, optional): the template's own: it goes with the model, so that instances have
          meshes with its triangles; see ShapeMesh
        surface_points (PointSet, optional): the template's, which all instances were matched with: they
          tell where its surface goes

    Outputs:
        prior (ShapePrior): mean, modes, scores of the instances, evaluation

    Parameters:
        balls (choice, default "carried"): which balls of the matches the model is made of
            carried: as the match carried them: smooth in what differs between instances, but some may stand
              out of thin parts
            replaced: the instances' own balls: inside, with the noise of which ball was near
        scale (boolean, default false): scale the instances to one size: the model then says how shapes
          vary, and nothing of size
        radius_weight (number, default 1.0, mean radii, >= 0.0, <= 100.0): how much logarithms of radii
          count; 0: modes that live in radii alone are lost
        point_share (number, default 0.5, 1, >= 0.0, <= 1.0): weight of the surface points, the rest is that
          of the balls. 1: the surface decides and balls follow, right where they are replaced ones with
          their noise; 0: balls decide
        along (number, default 0.1, 1, >= 0.0, <= 1.0): weight of what moves points along the surface,
          against what moves them off it: where flat faces are matched, points slide without a change of
          shape
        modes (integer, default 0, modes, >= 0, <= 10000): at most; 0: all, one less than instances
        draws (integer, default 200, shapes, >= 0, <= 100000): random shapes for the specificity; 0: no
          evaluation at all

    Sources: kornberger2010, 6.3.1; cootes1995, point distribution models; gower1975, superposition on the
      mean; davies2002, generalization and specificity
    """
    ...


def share_bound(
    cover: Union[CoverState, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverState:
    """Bound any cover from below by the shares of the samples that are left.

    A sample contributes 1 / (samples of the largest ball that contains it), rounded up component by
      component. Chooses nothing. Place it after the reductions and before the first greedy pick.

    When not to use it: the bound should be good: LagrangianBound is far better and takes seconds.

    Inputs:
        cover (CoverState): any state of a set covering computation, best after Reduce

    Outputs:
        cover (CoverState): the same state with a lower bound and its certificate, where they are better

    Sources: kornberger2010, 3.6.4 and Theorem 3.8
    """
    ...


def simplify_polygon(
    polygon: Union[Polygon2, ArtifactLike],
    *,
    tolerance: float = 0.001,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Polygon2:
    """Polygons with fewer corners, whose boundary hardly moves.

    Leaves corners out, along each ring as many at once as an edge can replace: neither the old boundary nor
      the new one is farther from the other than the tolerance. Coast lines and traced outlines have a
      hundred corners where their discs need one. No rings cross or touch afterwards, and each lies in the
      ones it lay in, decided exactly; where they would not, the tolerance is halved, and a warning says so.
      The summary of `simplified` adds corners, how many there were, and moved_at_most, model units. What is
      proven of discs should be proven for the polygon as it was read (PolygonMeshes).

    When not to use it: every corner counts, as in a polygon drawn by hand: with tolerance 0 it stays as it
      is.

    Inputs:
        polygon (Polygon2): polygons with holes whose rings do not touch, model units

    Outputs:
        simplified (Polygon2): the same rings with fewer corners, all of them corners of the input

    Parameters:
        tolerance (number, default 0.001, % of the longest bounding-box edge, >= 0.0, <= 100.0): how far the
          boundary may move; 0: not at all

    Sources: zhao1997, sleeve fitting
    """
    ...


def solid_topology(
    mesh: Union[TriangleMesh, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TopologyTable:
    """Components, tunnels and cavities of the solid inside a surface.

    One row of a topology table. A surface that is open, not manifold, not orientable or intersects itself
      bounds no solid: its row is unknown, and a warning says why. A mesh without triangles (a cloud of
      points) has no row.

    When not to use it: the surface is known to be open.

    Inputs:
        mesh (TriangleMesh): the surface of the solid

    Outputs:
        topology (TopologyTable): the row `surface`, or none

    Sources: kornberger2010, 3.5
    """
    ...


def split_components(
    mesh: Union[TriangleMesh, ArtifactLike],
    *,
    component: int = 0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TriangleMesh:
    """One connected component of a mesh.

    Several objects in one file become one mesh each, by a map over their numbers. Triangles hang together
      by common vertices. Accepts any triangles. Refuses a mesh without any, and numbers beyond the last
      component.

    When not to use it: components bound one solid together: a cavity is a component of its own.

    Inputs:
        mesh (TriangleMesh): any triangles, equal vertices welded

    Outputs:
        mesh (TriangleMesh): triangles and vertices of the component, in their order

    Parameters:
        component (integer, default 0, number, >= 0, <= 1000000000): which one, from 0 on: by area, the
          largest first

    Sources: cormen2009, connected components by disjoint sets
    """
    ...


def subtract(
    a: Union[Balls, ArtifactLike],
    b: Union[Balls, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """Balls less other balls: radii so small that none reaches into the others.

    Every radius of a becomes the distance of its center from the union of b, rounded downwards, where that
      is less; centers in a ball of b go. The union of the result lies in that of a, and has no point inside
      a ball of b. With balls of a inside a workpiece, and balls of b that contain what a tool sweeps, it is
      material that surely stays. It is no more than what balls around the centers of a can hold: more
      centers hold more. Accepts any balls, also none. Refuses coordinates and radii beyond 1e140.

    When not to use it: all of the difference is wanted as a surface: Boolean operations on meshes give
      that.

    Inputs:
        a (Balls): balls to be made smaller, many of them, model units
        b (Balls): balls that they must not reach into, in the same place and unit

    Outputs:
        balls (Balls): the balls of a that are left, in their order

    Sources: kornberger2010, 5.2; quinlan1994, distances by trees of balls, branch and bound
    """
    ...


class SurfaceBallsOutputs(NamedTuple):
    balls: Balls
    shrunk: Balls
    points: PointSet
    report: SurfaceBallsReport

def surface_balls(
    size: Union[LocalFeatureSize, ArtifactLike],
    *,
    radius: float = 0.0,
    shrink: float = 0.3,
    floor: float = 0.7,
    uneven_floor: float = 0.9,
    smallest: float = 0.0,
    by_place: bool = False,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> SurfaceBallsOutputs:
    """Balls around samples, as large as the local feature size allows.

    Every sample has a ball around it of radius rho D^, where D^ is the distance to the nearest pole, but at
      least floor times the distance to the third neighbour: where the spacing is as large as the feature
      size, balls of radius rho D^ do not meet. Pruning covers the samples by shrunken copies (output
      shrunk) and keeps the balls themselves (output balls). Larger copies keep fewer balls. The node says
      on which ground the union of the kept balls has the topology of the surface: proven for very small
      copies of dense samples, supported by what the thesis reports, or experience (heuristic), as when
      balls were raised to the floor or D^ is from fewer poles than all.

    When not to use it: the inside of a solid is wanted: these balls follow the surface.

    Inputs:
        size (LocalFeatureSize): D^ of n samples and the distances to their third neighbours

    Outputs:
        balls (Balls): n balls, each defined by its sample
        shrunk (Balls): n shrunken copies, which have to cover the samples
        points (PointSet): n samples, in the order of the balls: what the copies have to cover
        report (SurfaceBallsReport): rho, rho_bar, and the ground on which the union has the topology of the
          surface

    Parameters:
        radius (number, default 0.0, times the distance to the nearest pole, >= 0.0, <= 2.0): rho; 0 chooses
          .56 for shrink up to .3, .8 from .6 on, and between them in proportion
        shrink (number, default 0.3, times the distance to the nearest pole, >= 0.0, <= 2.0): rho_bar, at
          most radius: the larger, the fewer balls are kept; 0 keeps all
        floor (number, default 0.7, times the distance to the third neighbour, >= 0.0, <= 10.0): no ball is
          smaller; 1.5 for noise as large as the spacing, larger ones bridge gaps
        uneven_floor (number, default 0.9, times the distance to the third neighbour, >= 0.0, <= 10.0): at
          least this floor where part of the cloud is too coarse: where at 2 % of the samples the third
          neighbour is farther than .8 D^ and twice as far as at half of the samples, and at no more than
          half of the samples farther than .8 D^
        smallest (number, default 0.0, model units, >= 0.0): no ball is smaller
        by_place (boolean, default false): balls in an order of their places, not of the samples: pruning,
          which breaks ties by number, then keeps the same ones of permuted and of mirrored samples

    Sources: kornberger2010, 4.5, 4.7 and 4.9.3; Theorem 4.14; aichholzer2009, surface balls
    """
    ...


class SurfaceMeshOutputs(NamedTuple):
    mesh: TriangleMesh
    report: SurfaceReport

def surface_mesh(
    diagram: Union[PowerDiagram, ArtifactLike],
    poles: Union[PoleSet, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    *,
    most_overruled: float = 0.05,
    most_filled: float = 0.7,
    most_holes: float = 0.1,
    hole: float = 1.4,
    open: bool = False,
    smallest_hole: float = 0.001,
    most_left_out: float = 0.05,
    smallest_component: float = 0.01,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> SurfaceMeshOutputs:
    """A closed surface through the kept samples of a cloud of points.

    The triangles of the zero alpha-shape of surface balls have holes and edges of many triangles on real
      clouds. This node tells the cells of the regular triangulation inside from outside: poles vote in the
      cells where they lie, cells that hang together through gaps of the alpha-shape have one label, and
      where votes disagree, because the alpha-shape leaks, they are cut apart where that takes the least
      area (a minimum cut). The surface between inside and outside is closed, oriented and a 2-manifold,
      whatever the alpha-shape was; its vertices are samples, unmoved. Refuses clouds that do not look like
      the surface of a solid, with the reason: open scans, parts with sharp edges, sheets thinner than the
      spacing. With open = true holes stay open: what closes gaps wider than the balls around them is taken
      out again, and the surface has boundary loops. Scans of one side whose poles do not tell an inside are
      refused all the same.

    When not to use it: the cloud is clean and dense and every sample should be a vertex: CGAL's advancing
      front is as good.

    Inputs:
        diagram (PowerDiagram): the power diagram of the kept surface balls
        poles (PoleSet): labelled poles of all samples
        points (PointSet): all samples

    Outputs:
        mesh (TriangleMesh): an oriented 2-manifold, closed but with open = true
        report (SurfaceReport): genus, what was filled, what the poles say against it, and what it passes by

    Parameters:
        most_overruled (number, default 0.05, share of the votes, >= 0.0, <= 1.0): a surface that
          contradicts more of what the poles say is refused
        most_filled (number, default 0.7, share of the area, >= 0.0, <= 1.0): a closed surface that closes
          more gaps between balls is refused
        most_holes (number, default 0.1, share of the area, >= 0.0, <= 1.0): a closed surface that closes
          more holes is refused
        hole (number, default 1.4, times the balls around, and the distance to the third neighbour, >= 0.0,
          <= 1000.0): a gap that is larger is a hole
        open (boolean, default false): leave holes open: a surface with boundary loops, of which no gap is
          refused
        smallest_hole (number, default 0.001, share of the area, >= 0.0, <= 1.0): open: smaller holes are
          closed all the same
        most_left_out (number, default 0.05, share of the squared radii, >= 0.0, <= 1.0): a surface that
          passes by more of the kept balls, farther than their radius, is refused
        smallest_component (number, default 0.01, share of the area of the largest component, >= 0.0, <=
          1.0): smaller components are left out

    Sources: kornberger2010, 4.5.3; kolluri2004, labels of cells by a cut; boykov2004, how it is found
    """
    ...


def template_balls(
    balls: Union[Balls, ArtifactLike],
    inner: Union[Balls, ArtifactLike],
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Balls:
    """The balls of a template as they were before they grew, without tiny ones.

    Few balls of a surface have grown, each by another length; for a match every ball has the center and
      radius of the inner ball that it was. Balls with less than a twentieth of the median radius are left
      out: pruning puts balls of radius 0 where no other covers a sample. Refuses empty sets.

    When not to use it: balls are to cover the surface: these lie inside.

    Inputs:
        balls (Balls): k balls of the template, grown or not
        inner (Balls): its inner balls before they grew

    Outputs:
        balls (Balls): at most k of the inner balls, in the order of balls

    Sources: kornberger2010, 6.3.1; fine2001, Cholesky with pivots
    """
    ...


def topology(
    surface: Optional[Union[TopologyTable, ArtifactLike]] = None,
    inner: Optional[Union[TopologyTable, ArtifactLike]] = None,
    enlarged: Optional[Union[TopologyTable, ArtifactLike]] = None,
    kept: Optional[Union[TopologyTable, ArtifactLike]] = None,
    complex: Optional[Union[SimplicialComplex, ArtifactLike]] = None,
    axis: Optional[Union[MedialAxis, ArtifactLike]] = None,
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TopologyTable:
    """Compare components, tunnels and cavities along a pipeline.

    One row per connected input: Euler characteristic and Betti numbers of the solid inside the surface
      (SolidTopology), of unions of balls (UnionTopology), of an alpha-shape, and of a medial axis from its
      own polygons. What differs from one row to the next is said in words, as a warning and in the summary.
      Equal numbers do not prove that two shapes have the same topology; TopologyRepair does. Refuses to run
      with nothing connected.

    When not to use it: a proof is needed that pruning kept the topology: TopologyRepair compares loop by
      loop.

    Inputs:
        surface (TopologyTable, optional): SolidTopology of the surface
        inner (TopologyTable, optional): UnionTopology of the inner polar balls, stage inner
        enlarged (TopologyTable, optional): UnionTopology of the balls before pruning, stage enlarged
        kept (TopologyTable, optional): UnionTopology of the balls after pruning, stage kept; leave it out
          where complex is their alpha-shape
        complex (SimplicialComplex, optional): the alpha-shape of the balls after pruning
        axis (MedialAxis, optional): the medial axis of their union

    Outputs:
        topology (TopologyTable): one row per connected input

    Sources: kornberger2010, 3.5 and 3.6.5
    """
    ...


class TopologyRepairOutputs(NamedTuple):
    cover: CoverState
    check: TopologyCheck

def topology_repair(
    cover: Union[CoverState, ArtifactLike],
    balls: Union[Balls, ArtifactLike],
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    *,
    method: Literal['localised', 'literal'] = 'localised',
    most_defects: int = 2000,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TopologyRepairOutputs:
    """Return balls whose absence changed the topology of the union.

    Compares the union of the chosen balls with that of all balls, component by component, loop by loop and
      cavity by cavity, and returns balls until the inclusion induces isomorphisms of homology over Z/2.
      That is checked in the end, whatever the method did, with exact decisions for the balls as they are.
      Nothing is returned where nothing is wrong; in the worst case everything is, and the check says so.
      Where more than most_defects is wrong, only components are joined, and a warning says so. Refuses a
      cover about another number of balls.

    When not to use it: the balls were not enlarged: where polar balls of one sample touch, rounding decides
      what their union looks like.

    Inputs:
        cover (CoverState): a finished cover
        balls (Balls): the balls the covering matrix was made of, row i is ball i
        diagram (PowerDiagram, optional): their power diagram, with tolerance none: they are not
          triangulated again

    Outputs:
        cover (CoverState): the cover, and the balls that were returned
        check (TopologyCheck): what the inclusion does to homology before and after, and what the repair
          cost

    Parameters:
        method (choice, default "localised"): how balls to be returned are found
            localised: few balls: shortest paths for what is apart or lost, balls around the place for what
              is not filled
            literal: the algorithm of the thesis, one alpha-shape per ball; for at most 2000 balls
        most_defects (integer, default 2000, components, tunnels and cavities, >= 0): where more of them are
          lost or extra only components are joined, and a warning says so: the surface crosses itself, or
          the sample is far too coarse, and minutes would go by; a hundred defects cost seconds

    Sources: kornberger2010, 3.6.5, Listing 3.2
    """
    ...


def union_measure(
    complex: Union[SimplicialComplex, ArtifactLike],
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    tolerance: float = 5.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> MassProperties:
    """Volume, area, centre of mass and inertia tensor of a union of balls.

    By formulas on the patches, arcs and corners of the boundary, which the alpha-shape names: nothing is
      sampled. Accepts every alpha-shape: empty, flat, of touching balls, with cavities, of several
      components.

    When not to use it: the volume of the solid itself is wanted: the union of few balls deviates; see
      Compare.

    Inputs:
        complex (SimplicialComplex): the alpha-shape of the balls (node AlphaShape)
        diagram (PowerDiagram, optional): the power diagram that the alpha-shape was read off: nothing is
          searched in it again
        mesh (TriangleMesh, optional): the solid that the union stands for: where it is closed its exact
          volume is compared with

    Outputs:
        measure (MassProperties): at density 1, in powers of model units; with a closed mesh the summary
          adds solid_volume, volume_error, (union - solid) / solid, and solid_volume_exact: false where the
          surface crosses itself, or has triangles twice, so that the volume is counted on lines, to about a
          thousandth

    Parameters:
        tolerance (number, default 5.0, % of the volume of the solid, >= 0.0): a union whose volume is
          farther off is a warning

    Sources: edelsbrunner1995, the dual complex of a union of balls
    """
    ...


def union_topology(
    balls: Optional[Union[Balls, ArtifactLike]] = None,
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    *,
    stage: Literal['inner', 'enlarged', 'kept'] = 'kept',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TopologyTable:
    """Components, tunnels and cavities of a union of balls.

    One row of a topology table: simplices of the dual complex of the union are counted, none is listed.
      Depends on one set of balls only, so that it runs beside whatever comes after, and is found in the
      cache when a later stage changes. Accepts and refuses what AlphaShape does.

    When not to use it: the alpha-shape of the balls is made anyway: Topology takes its Betti numbers.

    Inputs:
        balls (Balls, optional): n closed balls, model units; needed where no diagram is connected
        diagram (PowerDiagram, optional): their power diagram, instead of the balls (node PowerDiagram)

    Outputs:
        topology (TopologyTable): the row of the stage

    Parameters:
        stage (choice, default "kept"): which stage of a pipeline the balls are: the name of the row, and
          the tolerance
            inner: inner polar balls as they come from LabelPoles, taken with the tolerance polar of
              PowerDiagram
            enlarged: the balls before pruning, taken as they are
            kept: the balls after pruning, taken as they are

    Sources: edelsbrunner1995, the union of balls and its dual shape; kornberger2010, 2.6
    """
    ...


def verify_cover(
    balls: Union[Balls, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    cover: Optional[Union[CoverState, ArtifactLike]] = None,
    candidates: Optional[Union[Balls, ArtifactLike]] = None,
    patches: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    on_uncovered: Literal['error', 'report'] = 'error',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverCheck:
    """Check from geometry that every sample lies in a ball, and that no cover has fewer than proved.

    Uses nothing of the covering matrix but the definition of its entries, so it also checks balls of other
      origin. With the cover and the balls of its covering matrix it also checks the certificate of the
      lower bound: no ball may contain samples that cost more than 1 or belong to two groups, and every
      sample that has a price must lie in a ball. A certificate that breaks this is refused. Covering the
      samples is not covering the surface between them. Samples that the cover lists because no candidate
      contains them are checked to be so, listed, and no error.

    When not to use it: the error between samples is asked: it looks at the samples alone

    Inputs:
        balls (Balls): the selected balls
        points (PointSet): samples that should be covered
        cover (CoverState, optional): how they were chosen, with the certificate to be checked
        candidates (Balls, optional): the balls of the covering matrix, among which they were chosen; goes
          with cover
        patches (TriangleMesh, optional): triangles of the points; where there are any, they should be
          covered in place of the points

    Outputs:
        check (CoverCheck): the samples in no ball, and the bound that the certificate proves

    Parameters:
        on_uncovered (choice, default "error"): what a sample in no ball means
            error: the node fails and names the first sample
            report: the samples are listed in the result

    Sources: kornberger2010, 3.6.1
    """
    ...


def verify_ellipsoids(
    ellipsoids: Union[Ellipsoids, ArtifactLike],
    points: Union[PointSet, ArtifactLike],
    patches: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    cover: Optional[Union[CoverState, ArtifactLike]] = None,
    candidates: Optional[Union[Ellipsoids, ArtifactLike]] = None,
    *,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> CoverCheck:
    """Check from geometry that every sample lies in an ellipsoid, and that no cover has fewer than proved.

    What VerifyCover is for balls. It uses nothing of the matrix but the definition of its entries. With the
      cover and the ellipsoids of its matrix it also checks the certificate of the lower bound, and that
      what the cover lists as uncovered has no candidate; that is no error. Refuses a sample in no
      ellipsoid, and a certificate that proves nothing.

    When not to use it: the error between samples is asked: that is CompareEllipsoids.

    Inputs:
        ellipsoids (Ellipsoids): the selected ones
        points (PointSet): samples that should be covered
        patches (TriangleMesh, optional): triangles that should be, in place of the points, where there are
          any
        cover (CoverState, optional): how they were chosen, with the certificate
        candidates (Ellipsoids, optional): among which they were chosen; goes with cover

    Outputs:
        check (CoverCheck): the samples in no ellipsoid, and the bound that the certificate proves

    Sources: kornberger2010, 3.6.1 and 6.4
    """
    ...


def verify_enclosure(
    mesh: Union[TriangleMesh, ArtifactLike],
    balls: Union[Balls, ArtifactLike],
    diagram: Optional[Union[PowerDiagram, ArtifactLike]] = None,
    solid: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    on_open: Literal['error', 'report', 'expect'] = 'error',
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> Enclosure:
    """Prove that balls contain everything inside a surface, or tell what they miss.

    The union of the balls contains every triangle, and everything that the triangles separate from
      infinity, if every triangle lies in it and it leaves no void. Triangles are bisected until every part
      lies in one ball; that and the voids are decided exactly, nothing is sampled. Accepts any mesh: open,
      doubled, crossing triangles of either orientation; and balls of any origin. What is not covered is
      listed with a point of each triangle, about which share of the surface it is, and how far away.
      protrusion bounds how far the balls stand out. Refuses meshes without triangles, but with on_open
      expect: then nothing is proven.

    When not to use it: samples have to be covered, not the surface between them: VerifyCover.

    Inputs:
        mesh (TriangleMesh): m triangles, model units
        balls (Balls): n closed balls, in the same place and unit
        diagram (PowerDiagram, optional): their power diagram, with tolerance none: they are not
          triangulated again
        solid (TriangleMesh, optional): a closed mesh whose inside counts in place of the mesh's for voids
          and the protrusion: for discs the prism of PolygonMeshes

    Outputs:
        enclosure (Enclosure): the verdict, and every place where it fails

    Parameters:
        on_open (choice, default "error"): what it means when not everything is enclosed
            error: the node fails and names the first place
            report: the places are listed in the result, and a warning says so
            expect: the places are listed; balls inside, or of bounded protrusion, have them

    Sources: edelsbrunner1995, voids by the dual complex
    """
    ...


def voronoi_poles(
    points: Union[PointSet, ArtifactLike],
    mesh: Optional[Union[TriangleMesh, ArtifactLike]] = None,
    *,
    vertices: Literal['auto', 'poles', 'all'] = 'poles',
    bounding_distance: float = 10.0,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> PoleSet:
    """The two poles of every sample: far vertices of its Voronoi cell on either side.

    The first pole of a sample is the vertex of its Voronoi cell farthest from it, the second the farthest
      behind that. Where they are less than 138.6 degrees apart, as at sharp edges, both may be on one side
      of the surface: all bounded vertices behind the first are kept as candidates, among which LabelPoles
      finds a third pole on the other side. With vertices = all every bounded vertex is in the result: the
      balls of all inner ones have no holes inside, however thin the solid. Far-away points around the
      sample bound all cells; Voronoi vertices that depend on them lie well outside the bounding box and are
      marked unbounded. Vertices that coincide exactly (five and more cospherical samples) are one. Accepts
      any distinct points that are not all in one plane; refuses fewer than 4 points, equal points and
      coplanar points.

    When not to use it: the points do not sample a surface: poles of points that fill a volume or follow
      curves mean nothing.

    Inputs:
        points (PointSet): n points on a surface, model units
        mesh (TriangleMesh, optional): the surface that was sampled; only whether it is closed matters, to
          vertices = auto

    Outputs:
        poles (PoleSet): the distinct poles and the candidates, not labelled, and the two poles of every
          sample

    Parameters:
        vertices (choice, default "poles"): which Voronoi vertices are in the result
            auto: all with a closed mesh, else poles
            poles: poles, and candidates where both may be on one side (thesis, 3.4)
            all: poles and all bounded vertices: about seven for a sample, both sides
        bounding_distance (number, default 10.0, longest bounding-box edges, >= 4.0, <= 1000000.0): distance
          of the far-away points; it matters only to unbounded poles: larger values move them farther away

    Sources: amenta1999, section 4, poles; kornberger2010, 3.3, 3.4
    """
    ...


def wrap(
    mesh: Union[TriangleMesh, ArtifactLike],
    *,
    alpha: float = 2.0,
    offset: float = 0.2,
    cache: Cache = False,
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    progress: Progress = None,
) -> TriangleMesh:
    """A closed surface around an open one, so that it has an inside.

    The alpha wrap of the triangles: closed, manifold, free of self-intersections, and about `offset`
      outside of them. Holes narrower than `alpha` are closed; through wider ones the wrap enters, so that
      an open sheet becomes a shell around it. Accepts any triangles.

    When not to use it: the surface is closed already: the wrap is farther out and has rounded corners.

    Inputs:
        mesh (TriangleMesh): any triangles, model units

    Outputs:
        mesh (TriangleMesh): the surface around them, outwards

    Parameters:
        alpha (number, default 2.0, % of the longest bounding-box edge, >= 0.01, <= 50.0): holes narrower
          than this are closed
        offset (number, default 0.2, % of the longest bounding-box edge, >= 0.01, <= 50.0): how far outside
          the result lies

    Sources: portaneri2022, alpha wrapping
    """
    ...

"""ballflow: graphs of nodes around unions of balls."""
# Written by tools/python/make_stubs from the declarations of nodes and types.

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core as _core, geometry as geometry, nodes as nodes
from ._artifact import Artifact as Artifact
from ._errors import (
    BallflowError as BallflowError,
    BallflowWarning as BallflowWarning,
    Cancelled as Cancelled,
    GraphError as GraphError,
    NodeFailed as NodeFailed,
    PluginError as PluginError,
    StoreError as StoreError,
    UsageError as UsageError,
)
from ._graph import Graph as Graph
from ._node import Context as Context, Range as Range, Unit as Unit, node as node
from ._results import NodeResult as NodeResult, Run as Run
from ._run import run as run
from ._session import PathLike
from ._sweep import Sweep as Sweep, sweep as sweep

__version__: str

def graphs() -> dict[str, str]: ...
def load(path: PathLike) -> Artifact: ...

class BallCounts(Artifact):
    """How many balls each of several objects gets.

    Arrays (attributes, in this order arguments of the constructor):

        counts: n i32: balls, at least one
        outside: n f64: volume outside that is expected with them, cubed model units

    Summary:

        objects: objects
        balls: all balls
        outside: volume outside that is expected
    """
    def __init__(self, counts: ArrayLike, outside: ArrayLike) -> None: ...
    @property
    def counts(self) -> NDArray[np.int32]: ...
    @property
    def outside(self) -> NDArray[np.float64]: ...


class BallDistance(Artifact):
    """How far two sets of balls are apart: witnesses, near pairs, clearances.

    Arrays (attributes, in this order arguments of the constructor):

        balls_a: one number i64: number of balls of a
        balls_b: one number i64: number of balls of b
        a: one number i32: ball of a in the pair with the smallest separation
        b: one number i32: ball of b in that pair
        separation: one number f64: of that pair: |c - c'| - r - r', model units
        point_a: 3 f64: on its sphere of a, next to b or deepest in it, model units
        point_b: 3 f64: on its sphere of b
        threshold: one number f64: pairs with at most this separation are listed, model units
        cut: one number u8: 1 where there are more pairs than are listed
        pairs: p x 2 i32: ball of a, ball of b; ascending by separation, a, b
        separations: p f64: of the pairs, model units
        pair_points_a: p x 3 f64: as point_a, of the pairs
        pair_points_b: p x 3 f64: as point_b, of the pairs
        centers_a: n x 3 f64, optional: the balls of a, model units
        radii_a: n f64, optional: model units
        clearances_a: n f64, optional: separation from the nearest ball of b
        nearest_a: n i32, optional: that ball
        centers_b: m x 3 f64, optional: the balls of b, model units
        radii_b: m f64, optional: model units
        clearances_b: m f64, optional: separation from the nearest ball of a
        nearest_b: m i32, optional: that ball
        solids_at_least: one number f64: the solids are so far apart: proven; model units
        solids_at_most: one number f64: and no farther; -1: unknown
        a_solid: one number u8: the balls of a: 0 are the solid, 1 enclose it, 2 are near it, 3 nothing is
          known
        b_solid: one number u8: the same of b

    Summary:

        separation: smallest |c - c'| - r - r' of all pairs, model units; negative: they overlap
        balls: [of a, of b] with this separation
        points: [on a, on b]: where, model units
        pairs: number of pairs that are listed
        threshold: their largest separation
        cut: whether there are more pairs than are listed
        solids: [at least, at most]: the distance of the solids, model units: proven; null: unknown
        words: the distance in words
        solids_words: what is proven about the solids; or null
    """
    def __init__(self, *, balls_a: ArrayLike, balls_b: ArrayLike, a: ArrayLike, b: ArrayLike, separation: ArrayLike, point_a: ArrayLike, point_b: ArrayLike, threshold: ArrayLike, cut: ArrayLike, pairs: ArrayLike, separations: ArrayLike, pair_points_a: ArrayLike, pair_points_b: ArrayLike, centers_a: Optional[ArrayLike] = None, radii_a: Optional[ArrayLike] = None, clearances_a: Optional[ArrayLike] = None, nearest_a: Optional[ArrayLike] = None, centers_b: Optional[ArrayLike] = None, radii_b: Optional[ArrayLike] = None, clearances_b: Optional[ArrayLike] = None, nearest_b: Optional[ArrayLike] = None, solids_at_least: ArrayLike, solids_at_most: ArrayLike, a_solid: ArrayLike, b_solid: ArrayLike) -> None: ...
    @property
    def balls_a(self) -> NDArray[np.int64]: ...
    @property
    def balls_b(self) -> NDArray[np.int64]: ...
    @property
    def a(self) -> NDArray[np.int32]: ...
    @property
    def b(self) -> NDArray[np.int32]: ...
    @property
    def separation(self) -> NDArray[np.float64]: ...
    @property
    def point_a(self) -> NDArray[np.float64]: ...
    @property
    def point_b(self) -> NDArray[np.float64]: ...
    @property
    def threshold(self) -> NDArray[np.float64]: ...
    @property
    def cut(self) -> NDArray[np.uint8]: ...
    @property
    def pairs(self) -> NDArray[np.int32]: ...
    @property
    def separations(self) -> NDArray[np.float64]: ...
    @property
    def pair_points_a(self) -> NDArray[np.float64]: ...
    @property
    def pair_points_b(self) -> NDArray[np.float64]: ...
    @property
    def centers_a(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def radii_a(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def clearances_a(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def nearest_a(self) -> Optional[NDArray[np.int32]]: ...
    @property
    def centers_b(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def radii_b(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def clearances_b(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def nearest_b(self) -> Optional[NDArray[np.int32]]: ...
    @property
    def solids_at_least(self) -> NDArray[np.float64]: ...
    @property
    def solids_at_most(self) -> NDArray[np.float64]: ...
    @property
    def a_solid(self) -> NDArray[np.uint8]: ...
    @property
    def b_solid(self) -> NDArray[np.uint8]: ...


class Balls(Artifact):
    """A set of closed balls.

    Arrays (attributes, in this order arguments of the constructor):

        centers: n x 3 f64: model units
        radii: n f64: model units, >= 0
        defining_offsets: n+1 i64, optional: where the samples of a ball begin
        defining_samples: d i32, optional: samples each ball passes through

    Summary:

        count: number of balls
        bbox: bounding box of the union, model units
        min_radius: model units
        max_radius: model units
    """
    def __init__(self, centers: ArrayLike, radii: ArrayLike, defining_offsets: Optional[ArrayLike] = None, defining_samples: Optional[ArrayLike] = None) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def defining_offsets(self) -> Optional[NDArray[np.int64]]: ...
    @property
    def defining_samples(self) -> Optional[NDArray[np.int32]]: ...


class Bisection(Artifact):
    """A search for a growth with which few enough balls cover a sample, or the error is allowed.

    Arrays (attributes, in this order arguments of the constructor):

        value: one number f64: to be tried next; once done, the answer
        too_small: one number f64: largest value known to need too many balls; -1 for none
        large_enough: one number f64: smallest value known to need few enough; -1 for none
        balls: one number i64: what large_enough needs; -1 while unknown
        balls_before: one number i64: what too_small needs; -1 while unknown
        within: one number f64: largest value known to have an error that is allowed; -1 for none
        beyond: one number f64: smallest value known to have a larger error; -1 for none
        error: one number f64: of `within`, model units; -1 while unknown
        error_before: one number f64: of `beyond`, model units; -1 while unknown
        tried: one number i64: values that were tried
        done: one number i64: 1 at the end

    Summary:

        value: to be tried next; once done, the answer
        done: 1 at the end
        balls: what the smallest sufficient value needs; null while there is none
        balls_before: what the largest insufficient value needs; null while there is none
        error: of the largest value with an error that is allowed, model units; null while there is none
        tried: values that were tried
    """
    def __init__(self, value: ArrayLike, too_small: ArrayLike, large_enough: ArrayLike, balls: ArrayLike, balls_before: ArrayLike, within: ArrayLike, beyond: ArrayLike, error: ArrayLike, error_before: ArrayLike, tried: ArrayLike, done: ArrayLike) -> None: ...
    @property
    def value(self) -> NDArray[np.float64]: ...
    @property
    def too_small(self) -> NDArray[np.float64]: ...
    @property
    def large_enough(self) -> NDArray[np.float64]: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def balls_before(self) -> NDArray[np.int64]: ...
    @property
    def within(self) -> NDArray[np.float64]: ...
    @property
    def beyond(self) -> NDArray[np.float64]: ...
    @property
    def error(self) -> NDArray[np.float64]: ...
    @property
    def error_before(self) -> NDArray[np.float64]: ...
    @property
    def tried(self) -> NDArray[np.int64]: ...
    @property
    def done(self) -> NDArray[np.int64]: ...


class Comparison(Artifact):
    """How far the boundary of a union of balls is from a surface; lengths in model units.

    Arrays (attributes, in this order arguments of the constructor):

        compared_with: one number u8: the surface: 1 points, 2 an open mesh, 3 a closed mesh
        surface_samples: one number i64: number of samples of the surface
        union_samples: one number i64: number of samples of the boundary of the union
        spacing: one number f64: no point of either is farther from a sample
        surface_to_union: 4 f64: one-sided distance from the surface to the boundary: at least, value, at
          most; mean
        union_to_surface: 4 f64: the same from the boundary to the surface
        coverage: one number f64: part of the area of the surface that lies in the union
        uncovered: one number f64: largest distance of a sample of the surface from the union
        protrusion: one number f64: largest radius minus distance of the centre from the surface
        union_volume: one number f64: volume of the union
        surface_volume: one number f64: volume that the surface encloses
        surface_encloses: one number u8: 1 when the surface is a closed mesh

    Summary:

        compared_with: the surface: a closed mesh, an open mesh, or a cloud of points
        hausdorff: the larger one of the two one-sided distances, from samples
        hausdorff_at_most: upper bound of it
        surface_to_union: one-sided distance from the surface to the boundary of the union
        union_to_surface: one-sided distance back
        chamfer: mean of the two mean distances
        coverage: part of the surface that lies in the union, in [0, 1]
        uncovered: largest distance of a sample of the surface from the union
        protrusion: no ball with its centre inside reaches farther beyond the surface
        volume: of the union
        volume_error: (volume of the union - of the solid) / of the solid; null unless it is closed
        spacing: no point of a surface is farther from a sample
    """
    def __init__(self, compared_with: ArrayLike, surface_samples: ArrayLike, union_samples: ArrayLike, spacing: ArrayLike, surface_to_union: ArrayLike, union_to_surface: ArrayLike, coverage: ArrayLike, uncovered: ArrayLike, protrusion: ArrayLike, union_volume: ArrayLike, surface_volume: ArrayLike, surface_encloses: ArrayLike) -> None: ...
    @property
    def compared_with(self) -> NDArray[np.uint8]: ...
    @property
    def surface_samples(self) -> NDArray[np.int64]: ...
    @property
    def union_samples(self) -> NDArray[np.int64]: ...
    @property
    def spacing(self) -> NDArray[np.float64]: ...
    @property
    def surface_to_union(self) -> NDArray[np.float64]: ...
    @property
    def union_to_surface(self) -> NDArray[np.float64]: ...
    @property
    def coverage(self) -> NDArray[np.float64]: ...
    @property
    def uncovered(self) -> NDArray[np.float64]: ...
    @property
    def protrusion(self) -> NDArray[np.float64]: ...
    @property
    def union_volume(self) -> NDArray[np.float64]: ...
    @property
    def surface_volume(self) -> NDArray[np.float64]: ...
    @property
    def surface_encloses(self) -> NDArray[np.uint8]: ...


class CoverCheck(Artifact):
    """The outcome of checking from geometry that balls cover samples.

    Arrays (attributes, in this order arguments of the constructor):

        balls: one number i64: number of balls
        samples: one number i64: number of samples
        uncovered: u i32: samples in no ball, ascending
        certified_bound: one number i64: no cover has fewer balls: a checked certificate proves it; -1
          without one

    Summary:

        certified_bound: the same, null without a certificate
        balls: number of balls
        samples: number of samples
        covered: samples in at least one ball
        uncovered: samples in none
    """
    def __init__(self, balls: ArrayLike, samples: ArrayLike, uncovered: ArrayLike, certified_bound: ArrayLike) -> None: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def samples(self) -> NDArray[np.int64]: ...
    @property
    def uncovered(self) -> NDArray[np.int32]: ...
    @property
    def certified_bound(self) -> NDArray[np.int64]: ...


class CoverState(Artifact):
    """A set covering instance on its way to a solution: residual matrix, choices, bounds.

    Arrays (attributes, in this order arguments of the constructor):

        balls: one number i64: number of balls of the original instance
        samples: one number i64: number of samples of the original instance
        left_out: one number i64: balls that are no row because the matrix would be too large: candidates
          alone are rows
        row_offsets: r+1 i64: where the columns of a row begin
        columns: nnz i32: column indices of the residual matrix, rows ascending
        row_ids: r i32: ball of each row
        column_ids: c i32: sample of each column
        chosen: k i32: chosen balls in order of choice
        chosen_how: k u8: 0 essential, 1 exact, 2 greedy, 3 trusted, 4 all, 5 searched, 6 returned to keep
          the topology
        uncovered: u i32: samples that no ball covers
        lower_bound: one number i64: proven lower bound on any cover, -1 while nothing is known
        lower_bound_how: one number u8: 0 unknown, 1 solver, 2 Lemma 3.7, 3 share bound, 4 certified
        certificate_samples: l i32: samples with a price, by group
        certificate_prices: l i32: price of the sample, in 2^-20 balls
        certificate_groups: l i32: group of the sample, ascending from 0
        settled_groups: one number i64: the first groups of the certificate, about what has left the matrix

    Summary:

        rows: balls left in the matrix
        cols: samples left in the matrix
        nnz: entries of the matrix
        chosen: balls chosen so far
        remaining: samples that no chosen ball covers yet
        lower_bound: no cover has fewer balls; null while nothing is known
        lower_bound_how: its ground: certified, share, lemma_3_7, solver, or unknown
        certified_bound: what the certificate of the state proves, 0 without one
        upper_bound: chosen balls once nothing remains, else null
        gap: (upper - lower) / lower, a fraction; null while a bound is unknown
        essential: chosen as the only ball of a sample
        exact: chosen by exact optimisation
        greedy: chosen greedily: each may cost one ball more than the optimum
        trusted: from a solver that stopped before it proved optimality
        searched: kept by local search, or needed by a matrix that leaves balls out
        left_out: balls that are no row because the matrix would be too large
        returned: returned by TopologyRepair, in its output only
        uncovered: samples that no ball covers
    """
    def __init__(self, balls: ArrayLike, samples: ArrayLike, left_out: ArrayLike, row_offsets: ArrayLike, columns: ArrayLike, row_ids: ArrayLike, column_ids: ArrayLike, chosen: ArrayLike, chosen_how: ArrayLike, uncovered: ArrayLike, lower_bound: ArrayLike, lower_bound_how: ArrayLike, certificate_samples: ArrayLike, certificate_prices: ArrayLike, certificate_groups: ArrayLike, settled_groups: ArrayLike) -> None: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def samples(self) -> NDArray[np.int64]: ...
    @property
    def left_out(self) -> NDArray[np.int64]: ...
    @property
    def row_offsets(self) -> NDArray[np.int64]: ...
    @property
    def columns(self) -> NDArray[np.int32]: ...
    @property
    def row_ids(self) -> NDArray[np.int32]: ...
    @property
    def column_ids(self) -> NDArray[np.int32]: ...
    @property
    def chosen(self) -> NDArray[np.int32]: ...
    @property
    def chosen_how(self) -> NDArray[np.uint8]: ...
    @property
    def uncovered(self) -> NDArray[np.int32]: ...
    @property
    def lower_bound(self) -> NDArray[np.int64]: ...
    @property
    def lower_bound_how(self) -> NDArray[np.uint8]: ...
    @property
    def certificate_samples(self) -> NDArray[np.int32]: ...
    @property
    def certificate_prices(self) -> NDArray[np.int32]: ...
    @property
    def certificate_groups(self) -> NDArray[np.int32]: ...
    @property
    def settled_groups(self) -> NDArray[np.int64]: ...


class DiscOutline(Artifact):
    """The boundary of a union of discs: rings of arcs, the union on the left.

    Arrays (attributes, in this order arguments of the constructor):

        centers: n x 2 f64: of the discs that have an arc, model units
        radii: n f64: model units
        discs: n i32: their numbers among the discs whose union it is
        arc_discs: a i32: the disc of each arc, an index into centers
        arc_begins: a x 2 f64: where each arc begins; it ends where the next begins
        arc_angles: a f64: how far it goes counter-clockwise, radians
        ring_offsets: r+1 i64: where the arcs of a ring begin
        component_offsets: c+1 i64: where the rings of a component begin: the outer one, then holes

    Summary:

        arcs: number of arcs
        components: number of outer rings
        holes: number of holes
        area: of the union, squared model units
        perimeter: of all rings, model units
        bbox: bounding box in the plane z = 0, model units; null when it is empty
    """
    def __init__(self, centers: ArrayLike, radii: ArrayLike, discs: ArrayLike, arc_discs: ArrayLike, arc_begins: ArrayLike, arc_angles: ArrayLike, ring_offsets: ArrayLike, component_offsets: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def discs(self) -> NDArray[np.int32]: ...
    @property
    def arc_discs(self) -> NDArray[np.int32]: ...
    @property
    def arc_begins(self) -> NDArray[np.float64]: ...
    @property
    def arc_angles(self) -> NDArray[np.float64]: ...
    @property
    def ring_offsets(self) -> NDArray[np.int64]: ...
    @property
    def component_offsets(self) -> NDArray[np.int64]: ...


class Ellipsoids(Artifact):
    """A set of closed ellipsoids, each with three half-axes and a rotation.

    Arrays (attributes, in this order arguments of the constructor):

        centers: n x 3 f64: model units
        radii: n x 3 f64: half-axes along the three axes of the rotation, model units, > 0
        rotations: n x 4 f64: unit quaternions w x y z, w >= 0: from the axes of the coordinates to those of
          the ellipsoid

    Summary:

        count: number of ellipsoids
        bbox: bounding box of the union, model units
        min_radius: the shortest half-axis of all, model units
        max_radius: the longest half-axis of all, model units
        max_ratio: the longest half-axis over the shortest of one ellipsoid, the largest of all
    """
    def __init__(self, centers: ArrayLike, radii: ArrayLike, rotations: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def rotations(self) -> NDArray[np.float64]: ...


class Enclosure(Artifact):
    """Whether a union of balls contains everything inside a surface.

    Arrays (attributes, in this order arguments of the constructor):

        balls: one number i64: number of balls
        triangles: one number i64: triangles of the mesh
        pieces: one number i64: parts of the triangles that lie in one ball each
        meant: one number u8: 0 where the balls are not meant to enclose
        closed: one number u8: 1 where the mesh is closed, so that it has a solid inside
        open_triangles: u i32: triangles not proven to be covered
        open_points: u x 3 f64: a point of each, model units
        open_why: u u8: 0 the point is in no ball, 1 balls meet there without overlap
        area: one number f64: of the triangles, squared model units
        open_area: one number f64: about how much of it is in no ball
        gap: one number f64: farthest of the looked-at points of the mesh from the balls, model units
        gap_at_most: one number f64: no point of the mesh is farther from the balls, model units; -1: not
          known
        void_points: v x 3 f64: a point in every void of the union
        void_places: v u8: 0 outside the solid, 1 inside, 2 not known
        protrusion: one number f64: no point of the balls is farther from the solid, or from an open mesh;
          model units

    Summary:

        encloses: everything that the mesh separates from infinity is in the balls: proven
        meant: whether the balls are meant to enclose
        words: the same in words, or what is not
        balls: number of balls
        triangles: triangles of the mesh
        open_triangles: those not proven to be covered
        open_share: about which part of the surface is in no ball
        gap: farthest point of the mesh from the balls that was met, model units
        gap_at_most: no point of the mesh is farther from the balls, model units; null without balls or
          triangles
        voids: voids inside the solid
        closed: whether the mesh is closed
        protrusion: no point of the balls is farther from the solid; model units
        pieces: parts of the triangles that lie in one ball each
    """
    def __init__(self, balls: ArrayLike, triangles: ArrayLike, pieces: ArrayLike, meant: ArrayLike, closed: ArrayLike, open_triangles: ArrayLike, open_points: ArrayLike, open_why: ArrayLike, area: ArrayLike, open_area: ArrayLike, gap: ArrayLike, gap_at_most: ArrayLike, void_points: ArrayLike, void_places: ArrayLike, protrusion: ArrayLike) -> None: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def triangles(self) -> NDArray[np.int64]: ...
    @property
    def pieces(self) -> NDArray[np.int64]: ...
    @property
    def meant(self) -> NDArray[np.uint8]: ...
    @property
    def closed(self) -> NDArray[np.uint8]: ...
    @property
    def open_triangles(self) -> NDArray[np.int32]: ...
    @property
    def open_points(self) -> NDArray[np.float64]: ...
    @property
    def open_why(self) -> NDArray[np.uint8]: ...
    @property
    def area(self) -> NDArray[np.float64]: ...
    @property
    def open_area(self) -> NDArray[np.float64]: ...
    @property
    def gap(self) -> NDArray[np.float64]: ...
    @property
    def gap_at_most(self) -> NDArray[np.float64]: ...
    @property
    def void_points(self) -> NDArray[np.float64]: ...
    @property
    def void_places(self) -> NDArray[np.uint8]: ...
    @property
    def protrusion(self) -> NDArray[np.float64]: ...


class EnclosureFit(Artifact):
    """How well balls fit around a solid.

    Arrays (attributes, in this order arguments of the constructor):

        wanted: one number i64: balls at most
        balls: one number i64: balls that are used
        solid: one number f64: volume of the solid, counted on a lattice, cubed model units; 0 for sheets
        outside: one number f64: volume of the union outside of it, likewise
        area: one number f64: of the triangles, squared model units
        loss: one number f64: what the search made small, by its kind
        kind: one number u8: 0 volume outside, 1 volume of the solid in no ball, 2 area of the surface in no
          ball
        filled_voids: one number i64: voids of the first result that were filled

    Summary:

        loss_share: what the search made small, as a part of the solid's volume or of the surface; null
          without one
        wanted: balls at most
        balls: balls that are used
        outside_share: about what the balls waste, as a part of the solid's volume; null for sheets
        words: the same in words
        solid: volume of the solid, about; cubed model units
        outside: volume of the union outside of it, about
        filled_voids: voids that were filled
    """
    def __init__(self, wanted: ArrayLike, balls: ArrayLike, solid: ArrayLike, outside: ArrayLike, area: ArrayLike, loss: ArrayLike, kind: ArrayLike, filled_voids: ArrayLike) -> None: ...
    @property
    def wanted(self) -> NDArray[np.int64]: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def solid(self) -> NDArray[np.float64]: ...
    @property
    def outside(self) -> NDArray[np.float64]: ...
    @property
    def area(self) -> NDArray[np.float64]: ...
    @property
    def loss(self) -> NDArray[np.float64]: ...
    @property
    def kind(self) -> NDArray[np.uint8]: ...
    @property
    def filled_voids(self) -> NDArray[np.int64]: ...


class Growth(Artifact):
    """How far balls have grown, and what stopped each of them.

    Arrays (attributes, in this order arguments of the constructor):

        centers: n x 3 f64: centres of the balls, model units
        radii: n f64: radii before, model units
        grown_radii: n f64: radii after, model units
        limits: n f64: largest radius allowed whatever is asked for, or infinity
        stops: n u8: 0 grown as far as asked for, 1 pole bound, 2 critical Gabriel point, 3 neighbour
        betti_before: 3 i64: components, tunnels, cavities of the union; -1 if unknown
        betti_after: 3 i64: those of the grown union

    Summary:

        balls: number of balls
        stopped: balls smaller than asked for
        stopped_by_poles: they might reach the outer medial axis (Lemma 3.4)
        stopped_by_gabriel: they would reach a critical Gabriel point
        stopped_by_neighbour: a ball near them has stopped, and the topology would change
        mean_growth: of the radii, model units; null without balls
        max_growth: of the radii, model units; null without balls
        betti_before: [components, tunnels, cavities] of the union, null where nobody has looked
        betti_after: those of the grown union
    """
    def __init__(self, centers: ArrayLike, radii: ArrayLike, grown_radii: ArrayLike, limits: ArrayLike, stops: ArrayLike, betti_before: ArrayLike, betti_after: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def grown_radii(self) -> NDArray[np.float64]: ...
    @property
    def limits(self) -> NDArray[np.float64]: ...
    @property
    def stops(self) -> NDArray[np.uint8]: ...
    @property
    def betti_before(self) -> NDArray[np.int64]: ...
    @property
    def betti_after(self) -> NDArray[np.int64]: ...


class LocalFeatureSize(Artifact):
    """D^, the distance of every sample to the nearest pole: an estimate of the local feature size.

    Arrays (attributes, in this order arguments of the constructor):

        points: n x 3 f64: the sample, model units
        pole_distances: n f64: D^, model units. For r-samples, r <= 0.08: distance to the discrete medial
          axis in [0.817 D^, D^], local feature size at most 1.2802 D^
        third_neighbors: n f64: distance to the third nearest other sample, model units
        axis_distances: n f64, optional: distance to the discrete medial axis, model units; absent where no
          axis was given
        r_at_least: one number f64: of the mesh, see r_at_most; -1 without a mesh
        r_at_most: one number f64: every point of the mesh has a sample within this times its distance to
          axis or poles; -1 without a mesh
        r_at: 3 f64: the point of the mesh where r_at_least is attained
        fewer_poles: one number u8: 1 where D^ is the distance to the nearest of fewer places than all
          poles: no bound holds then

    Summary:

        count: number of samples
        min_pole_distance: smallest D^; null without samples
        max_pole_distance: largest D^
        discrete_at_least: times D^: lower bound of the distance to the discrete medial axis; null with
          fewer poles
        at_most: times D^: upper bound of the local feature size; null with fewer poles
        fewer_poles: whether D^ leaves out poles, as those of balls that pruning did not keep
        min_axis_distance: smallest distance to the discrete medial axis; null without an axis
        max_axis_distance: largest one
        min_axis_by_pole: smallest quotient of the distances to axis and pole: 0.817 or more by Corollary
          4.12
        max_axis_by_pole: largest one: at most 1 where the poles are in the axis
        r_at_least: the cloud is no r-sample of the mesh for a smaller r; null without a mesh
        r_at_most: it is one for this r; null without a mesh, or where at_least is 1 or more
    """
    def __init__(self, *, points: ArrayLike, pole_distances: ArrayLike, third_neighbors: ArrayLike, axis_distances: Optional[ArrayLike] = None, r_at_least: ArrayLike, r_at_most: ArrayLike, r_at: ArrayLike, fewer_poles: ArrayLike) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def pole_distances(self) -> NDArray[np.float64]: ...
    @property
    def third_neighbors(self) -> NDArray[np.float64]: ...
    @property
    def axis_distances(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def r_at_least(self) -> NDArray[np.float64]: ...
    @property
    def r_at_most(self) -> NDArray[np.float64]: ...
    @property
    def r_at(self) -> NDArray[np.float64]: ...
    @property
    def fewer_poles(self) -> NDArray[np.uint8]: ...


class MassProperties(Artifact):
    """What a solid of density 1 weighs and how it turns, in powers of model units.

    Arrays (attributes, in this order arguments of the constructor):

        volume: one number f64: volume
        area: one number f64: area of the boundary
        center_of_mass: 3 f64: centre of mass
        inertia: 6 f64: inertia tensor about the centre of mass: xx, yy, zz, xy, xz, yz
        closure_error: one number f64: length of the integral of the outward normal, divided by the area: 0
          but for rounding

    Summary:

        volume: cubed model units
        area: of the boundary, squared model units
        center_of_mass: [x, y, z], model units
        inertia: [xx, yy, zz, xy, xz, yz] about the centre of mass at density 1
        closure_error: 0 but for rounding
    """
    def __init__(self, volume: ArrayLike, area: ArrayLike, center_of_mass: ArrayLike, inertia: ArrayLike, closure_error: ArrayLike) -> None: ...
    @property
    def volume(self) -> NDArray[np.float64]: ...
    @property
    def area(self) -> NDArray[np.float64]: ...
    @property
    def center_of_mass(self) -> NDArray[np.float64]: ...
    @property
    def inertia(self) -> NDArray[np.float64]: ...
    @property
    def closure_error(self) -> NDArray[np.float64]: ...


class MatchedBalls(Artifact):
    """The balls and surface points of a template, found again on one instance, in its own coordinates and in
      the order of the template.

    Arrays (attributes, in this order arguments of the constructor):

        centers: k x 3 f64: of the instance's balls, model units
        radii: k f64: of the same balls, model units, above 0
        carried: k x 3 f64: where the template's centers were carried to, model units
        carried_radii: k f64, optional: of the template's balls, in proportion to the carried points around
          them, model units, above 0
        residuals: k f64: from the carried ball to the instance's own in (x, y, z, r), model units
        partners: k u8: 1; 0: no ball of the instance is near enough, the carried one stands here
        unique: k u8: 1; 0: another ball has the same partner, or there is none
        points: m x 3 f64: on the surface, carried from those of the template
        normals: m x 3 f64: of the surface there, of length 1, outwards
        point_residuals: m f64: of the points from the surface that the samples tell, model units
        samples: n x 3 f64: of the instance's surface, model units
        sample_normals: n x 3 f64: of length 1, outwards
        rotation: 9 f64: from the instance to the template: 3 x 3 by rows
        scale: one number f64: above 0; 1 of a rigid transform
        translation: 3 f64: added last, model units of the template
        similarity: one number u8: 1: the scale was free
        mirrored: one number u8: 1: the transform mirrors
        diagonal: one number f64: of the bounding box of the instance's samples, model units

    Summary:

        balls: of the template
        points: surface points of the template
        without_partner: balls that no ball of the instance is near to
        shared: balls whose partner is also that of another one
        residual: mean of the balls with a partner from it, model units; null: none has one
        surface_residual: mean of the points from the surface, model units; null: no points
        diagonal: of the bounding box of the instance, model units
        degrees: of the rotation from the instance to the template; null where it mirrors
        scale: from the instance to the template
        bbox: of the union of balls, model units
    """
    def __init__(self, *, centers: ArrayLike, radii: ArrayLike, carried: ArrayLike, carried_radii: Optional[ArrayLike] = None, residuals: ArrayLike, partners: ArrayLike, unique: ArrayLike, points: ArrayLike, normals: ArrayLike, point_residuals: ArrayLike, samples: ArrayLike, sample_normals: ArrayLike, rotation: ArrayLike, scale: ArrayLike, translation: ArrayLike, similarity: ArrayLike, mirrored: ArrayLike, diagonal: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def carried(self) -> NDArray[np.float64]: ...
    @property
    def carried_radii(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def residuals(self) -> NDArray[np.float64]: ...
    @property
    def partners(self) -> NDArray[np.uint8]: ...
    @property
    def unique(self) -> NDArray[np.uint8]: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def normals(self) -> NDArray[np.float64]: ...
    @property
    def point_residuals(self) -> NDArray[np.float64]: ...
    @property
    def samples(self) -> NDArray[np.float64]: ...
    @property
    def sample_normals(self) -> NDArray[np.float64]: ...
    @property
    def rotation(self) -> NDArray[np.float64]: ...
    @property
    def scale(self) -> NDArray[np.float64]: ...
    @property
    def translation(self) -> NDArray[np.float64]: ...
    @property
    def similarity(self) -> NDArray[np.uint8]: ...
    @property
    def mirrored(self) -> NDArray[np.uint8]: ...
    @property
    def diagonal(self) -> NDArray[np.float64]: ...


class MedialAxis(Artifact):
    """The medial axis of a union of balls as a polygon complex with a radius at every vertex.

    Arrays (attributes, in this order arguments of the constructor):

        vertices: v x 3 f64: model units
        radii: v f64: radius of the maximal inscribed ball, model units
        edges: e x 2 i32: vertex pairs of edges that bound no polygon
        polygon_offsets: f+1 i64: where the corners of a polygon begin
        polygon_vertices: k i32: corners in order around the polygon
        polygon_kinds: f u8: 0 singular triangle, 1 Voronoi facet, 2 wall
        polygon_sheets: f i32: sheet of each polygon: polygons joined across edges of exactly two polygons
        sheet_orientable: s u8: 1 when the polygons of the sheet face one way, 0 when that is impossible
        seams: m x 2 i32: vertex pairs of edges of three and more polygons, ascending
        seam_degrees: m i32: polygons at each seam
        seam_curves: m i32: curve of each seam: seams joined at vertices where exactly two end

    Summary:

        vertices: number
        edges: edges that bound no polygon
        polygons: number
        euler_characteristic: vertices - edges + polygons, every edge counted once
        components: connected components
        sheets: components of the polygons after cutting at seams
        sheets_not_orientable: sheets with one side only
        seams: edges of three and more polygons
        seam_curves: curves that the seams form
        expected_euler_characteristic: that of the alpha-shape the axis was made from
    """
    def __init__(self, vertices: ArrayLike, radii: ArrayLike, edges: ArrayLike, polygon_offsets: ArrayLike, polygon_vertices: ArrayLike, polygon_kinds: ArrayLike, polygon_sheets: ArrayLike, sheet_orientable: ArrayLike, seams: ArrayLike, seam_degrees: ArrayLike, seam_curves: ArrayLike) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def edges(self) -> NDArray[np.int32]: ...
    @property
    def polygon_offsets(self) -> NDArray[np.int64]: ...
    @property
    def polygon_vertices(self) -> NDArray[np.int32]: ...
    @property
    def polygon_kinds(self) -> NDArray[np.uint8]: ...
    @property
    def polygon_sheets(self) -> NDArray[np.int32]: ...
    @property
    def sheet_orientable(self) -> NDArray[np.uint8]: ...
    @property
    def seams(self) -> NDArray[np.int32]: ...
    @property
    def seam_degrees(self) -> NDArray[np.int32]: ...
    @property
    def seam_curves(self) -> NDArray[np.int32]: ...


class MeshReport(Artifact):
    """How a mesh of the boundary of a union of balls was made, and what holds of it.

    Arrays (attributes, in this order arguments of the constructor):

        made_by: one number u8: 0 from the power diagram, 1 from that of balls whose radii were changed a
          little, 2 a grid, 3 a skin surface
        vertices: one number i64: vertices of the mesh
        faces: one number i64: its triangles
        components: one number i64: its connected components
        euler: one number i64: its Euler characteristic
        surfaces: one number i64: components of the boundary of the union that was meshed
        euler_given: one number i64: Euler characteristic of the union of the balls
        euler_meshed: one number i64: that of the union that was meshed
        closed: one number u8: 1: every edge belongs to two triangles
        manifold: one number u8: 1: every vertex star is a disk
        oriented: one number u8: 1: neighbours run through their edge in opposite directions
        error_asked: one number f64: model units
        error: one number f64: largest distance of the mesh from the boundary, model units
        error_back: one number f64: of a grid, skin surface or simplified mesh: largest distance of the
          boundary from the mesh, model units; -1: not measured
        faces_before: one number i64: triangles before simplification; 0: there was none
        growth: one number f64: most that a radius grew; below 0: shrank; model units
        cell: one number f64: edge of a cell of the grid, model units; 0: no grid
        rounds: one number i64: how often arcs were divided again, or the grid was refined
        self_intersections: one number i64: pairs of triangles that cross; -1: not counted

    Summary:

        made_by: exact, exact of changed radii, grid, or skin surface
        faces: number of triangles
        components: connected components of the mesh
        euler: Euler characteristic of the mesh: twice that of the union
        euler_given: Euler characteristic of the union of the balls
        euler_meshed: that of the union that was meshed: other radii where they had to be changed
        differs: what is not as it was asked for, in words; null when all is
        error_asked: model units
        error: the largest distance of the mesh from the boundary of the union, model units
        error_back: the largest distance of the boundary from the mesh, in notches; null for exact meshes
        faces_before: triangles before simplification; null where there was none
        growth: the most that a radius grew, below 0 shrank, so that nothing is a tie; model units
        cell: edge of a cell of the grid, model units; null without a grid
        self_intersections: pairs of triangles that cross; null when they were not counted
    """
    def __init__(self, made_by: ArrayLike, vertices: ArrayLike, faces: ArrayLike, components: ArrayLike, euler: ArrayLike, surfaces: ArrayLike, euler_given: ArrayLike, euler_meshed: ArrayLike, closed: ArrayLike, manifold: ArrayLike, oriented: ArrayLike, error_asked: ArrayLike, error: ArrayLike, error_back: ArrayLike, faces_before: ArrayLike, growth: ArrayLike, cell: ArrayLike, rounds: ArrayLike, self_intersections: ArrayLike) -> None: ...
    @property
    def made_by(self) -> NDArray[np.uint8]: ...
    @property
    def vertices(self) -> NDArray[np.int64]: ...
    @property
    def faces(self) -> NDArray[np.int64]: ...
    @property
    def components(self) -> NDArray[np.int64]: ...
    @property
    def euler(self) -> NDArray[np.int64]: ...
    @property
    def surfaces(self) -> NDArray[np.int64]: ...
    @property
    def euler_given(self) -> NDArray[np.int64]: ...
    @property
    def euler_meshed(self) -> NDArray[np.int64]: ...
    @property
    def closed(self) -> NDArray[np.uint8]: ...
    @property
    def manifold(self) -> NDArray[np.uint8]: ...
    @property
    def oriented(self) -> NDArray[np.uint8]: ...
    @property
    def error_asked(self) -> NDArray[np.float64]: ...
    @property
    def error(self) -> NDArray[np.float64]: ...
    @property
    def error_back(self) -> NDArray[np.float64]: ...
    @property
    def faces_before(self) -> NDArray[np.int64]: ...
    @property
    def growth(self) -> NDArray[np.float64]: ...
    @property
    def cell(self) -> NDArray[np.float64]: ...
    @property
    def rounds(self) -> NDArray[np.int64]: ...
    @property
    def self_intersections(self) -> NDArray[np.int64]: ...


class MinkowskiReport(Artifact):
    """What the Minkowski sum of two sets of balls came to.

    Arrays (attributes, in this order arguments of the constructor):

        pairs: one number i64: pairs of balls
        survivors: one number i64: sums of pairs that were triangulated; of algorithm memory: that were
          vertices at the end
        count: one number i64: balls of the result: the sums that contribute, or the smallest part
        contributing: one number i64: sums that contribute
        minimal: one number i64: sums in the smallest part of these with the same union; -1: nobody asked
          for it
        touching_boundary: one number i64: contributing sums on the boundary of the union, all of which are
          needed
        lower: 3 f64: corner of the bounding box of the union, model units
        upper: 3 f64: the opposite corner
        error_bound: one number f64: no point of the surface of the sum of the solids is farther from the
          union; -1: unknown
        a_compared_with: one number u8: the solid a: 0 its balls, 1 points, 2 an open mesh, 3 a closed mesh,
          or polygons
        b_compared_with: one number u8: the same of b
        excess_bound: one number f64: no point of the union is farther from the sum of the solids; -1:
          unknown
        rounded: one number u8: sums are rounded 0 to nearest, 1 inwards, 2 outwards
        a_encloses: one number u8: the solid a lies in its balls: 0 not known, 1 proven, 2 not so, 3 it is
          its balls
        b_encloses: one number u8: the same of b
        a_inside: one number u8: no ball reaches out of the solid a: as before
        b_inside: one number u8: the same of b

    Summary:

        pairs: pairs of balls
        survivors: sums of pairs that were triangulated
        count: balls of the result: the sums that contribute, or the smallest part of them
        contributing: sums that contribute to the union
        minimal: sums in an inclusion-minimal part of these with the same union; null when nobody asked for
          it
        touching_boundary: sums with a piece of their sphere on the boundary of the union: needed
        bbox: bounding box of the union, model units; null when it is empty
        error_bound: no point of the surface of the sum of the solids is farther from the union, model
          units; null when it is unknown
        excess_bound: no point of the union is farther from the sum of the solids, model units; null when it
          is unknown
        proven: contains A + B, or lies inside A + B, and how that is proven; null when neither is
        not_proven: why neither is
        error_bound_unknown: why there is no error bound: no comparison, or one with no closed mesh
    """
    def __init__(self, pairs: ArrayLike, survivors: ArrayLike, count: ArrayLike, contributing: ArrayLike, minimal: ArrayLike, touching_boundary: ArrayLike, lower: ArrayLike, upper: ArrayLike, error_bound: ArrayLike, a_compared_with: ArrayLike, b_compared_with: ArrayLike, excess_bound: ArrayLike, rounded: ArrayLike, a_encloses: ArrayLike, b_encloses: ArrayLike, a_inside: ArrayLike, b_inside: ArrayLike) -> None: ...
    @property
    def pairs(self) -> NDArray[np.int64]: ...
    @property
    def survivors(self) -> NDArray[np.int64]: ...
    @property
    def count(self) -> NDArray[np.int64]: ...
    @property
    def contributing(self) -> NDArray[np.int64]: ...
    @property
    def minimal(self) -> NDArray[np.int64]: ...
    @property
    def touching_boundary(self) -> NDArray[np.int64]: ...
    @property
    def lower(self) -> NDArray[np.float64]: ...
    @property
    def upper(self) -> NDArray[np.float64]: ...
    @property
    def error_bound(self) -> NDArray[np.float64]: ...
    @property
    def a_compared_with(self) -> NDArray[np.uint8]: ...
    @property
    def b_compared_with(self) -> NDArray[np.uint8]: ...
    @property
    def excess_bound(self) -> NDArray[np.float64]: ...
    @property
    def rounded(self) -> NDArray[np.uint8]: ...
    @property
    def a_encloses(self) -> NDArray[np.uint8]: ...
    @property
    def b_encloses(self) -> NDArray[np.uint8]: ...
    @property
    def a_inside(self) -> NDArray[np.uint8]: ...
    @property
    def b_inside(self) -> NDArray[np.uint8]: ...


class NoiseReport(Artifact):
    """How noisy a cloud of points is, and what was done about it.

    Arrays (attributes, in this order arguments of the constructor):

        uncertain: one number f64: share of the poles whose label says little
        coarseness: one number f64: median over the samples of the distance to the third neighbour, times 1
          / D^
        level: one number f64: tenth percentile of the deviation from quadrics, times 1 / distance to the
          third neighbour; 0 where it was not asked for
        neighbors: one number i32: with so many samples were denoised, 0: not
        next: one number i32: with so many they are to be denoised next, 0: done
        verdict: one number u8: 0 clean, 1 sharp edges, 2 noisy, 3 denoised, 4 too noisy, 5 left as it is

    Summary:

        verdict: "clean", "sharp edges", "noisy", "denoised", "too noisy" or "left as it is"
        done: false while samples are to be denoised with other neighbours
        uncertain: share of the poles whose label says little
        coarseness: median distance to the third neighbour, times 1 / D^
        level: of the noise, times the distance to the third neighbour; 0 where it was not asked for
        neighbors: with so many samples were denoised; 0: they are as they came
    """
    def __init__(self, uncertain: ArrayLike, coarseness: ArrayLike, level: ArrayLike, neighbors: ArrayLike, next: ArrayLike, verdict: ArrayLike) -> None: ...
    @property
    def uncertain(self) -> NDArray[np.float64]: ...
    @property
    def coarseness(self) -> NDArray[np.float64]: ...
    @property
    def level(self) -> NDArray[np.float64]: ...
    @property
    def neighbors(self) -> NDArray[np.int32]: ...
    @property
    def next(self) -> NDArray[np.int32]: ...
    @property
    def verdict(self) -> NDArray[np.uint8]: ...


class OutlineComparison(Artifact):
    """How far two polygons are from each other: areas and distances.

    Arrays (attributes, in this order arguments of the constructor):

        area_a: one number f64: area of a; -1: unknown, where rings cross or touch
        area_b: one number f64: area of b
        only_a: one number f64: area inside a and outside b
        only_b: one number f64: area inside b and outside a
        a_to_b_at_least: one number f64: the largest distance of the boundary of a from that of b is not
          less
        a_to_b_at_most: one number f64: and not more
        b_to_a_at_least: one number f64: the same from b to a
        b_to_a_at_most: one number f64: and not more

    Summary:

        area_a: squared model units; null where it is unknown
        area_b: squared model units
        only_a: area inside a and outside b
        only_b: area inside b and outside a
        symmetric_difference: area inside one of them alone, as a part of that of a; null where a has none,
          or it is unknown
        a_to_b: [at least, at most]: how far the boundary of a is from that of b, model units
        b_to_a: [at least, at most]: the same from b to a
    """
    def __init__(self, area_a: ArrayLike, area_b: ArrayLike, only_a: ArrayLike, only_b: ArrayLike, a_to_b_at_least: ArrayLike, a_to_b_at_most: ArrayLike, b_to_a_at_least: ArrayLike, b_to_a_at_most: ArrayLike) -> None: ...
    @property
    def area_a(self) -> NDArray[np.float64]: ...
    @property
    def area_b(self) -> NDArray[np.float64]: ...
    @property
    def only_a(self) -> NDArray[np.float64]: ...
    @property
    def only_b(self) -> NDArray[np.float64]: ...
    @property
    def a_to_b_at_least(self) -> NDArray[np.float64]: ...
    @property
    def a_to_b_at_most(self) -> NDArray[np.float64]: ...
    @property
    def b_to_a_at_least(self) -> NDArray[np.float64]: ...
    @property
    def b_to_a_at_most(self) -> NDArray[np.float64]: ...


class Path(Artifact):
    """A polyline with a radius at every point: what something moves along.

    Arrays (attributes, in this order arguments of the constructor):

        points: n x 3 f64: joined by straight segments, model units
        radii: n f64: of the path at each, linear in between, model units
        balls: one number i64: number of balls that were made of it
        spacing: one number f64: their centers are no farther apart along the path, model units
        contains: one number u8: 1 where the balls contain the path, 0 where they lie in it
        error: one number f64: no point of balls or path is farther from the other, model units

    Summary:

        points: number of points
        length: of all segments, model units
        bbox: bounding box of the points, model units
        balls: number of balls made of it
        spacing: their centers are no farther apart, model units
        contains: whether the balls contain the path, or lie in it
        error: no point of balls or path is farther from the other, model units
    """
    def __init__(self, points: ArrayLike, radii: ArrayLike, balls: ArrayLike, spacing: ArrayLike, contains: ArrayLike, error: ArrayLike) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def spacing(self) -> NDArray[np.float64]: ...
    @property
    def contains(self) -> NDArray[np.uint8]: ...
    @property
    def error(self) -> NDArray[np.float64]: ...


class PointSet(Artifact):
    """A sample of a surface: n pairwise distinct points.

    Arrays (attributes, in this order arguments of the constructor):

        points: n x 3 f64: coordinates, model units
        normals: n x 3 f64, optional: unit normals, where the source had them

    Summary:

        count: number of points
        bbox: [[min x, y, z], [max x, y, z]], model units
    """
    def __init__(self, points: ArrayLike, normals: Optional[ArrayLike] = None) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def normals(self) -> Optional[NDArray[np.float64]]: ...


class PoleSet(Artifact):
    """Voronoi vertices that are poles of samples, other bounded ones beside them, and the poles of samples.

    Arrays (attributes, in this order arguments of the constructor):

        centers: p x 3 f64: Voronoi vertices, model units
        radii: p f64: distance to the defining samples, model units
        labels: p u8: 0 unlabelled, 1 inner, 2 outer
        defining_offsets: p+1 i64: where the samples of a pole begin
        defining_samples: d i32: samples on the sphere of each pole, ascending
        unbounded: p u8: 1 where a far-away bounding point is a site
        sample_poles: n x 3 i32: poles of each sample, -1 for none: the farthest vertex of its cell, the
          farthest behind it, and, where the labels of both are the same, the farthest with the other label
        uncertain: p u8, optional: 1 where the evidence for the label is weak; only of labels by angle

    Summary:

        samples: number of samples
        poles: number of distinct poles
        candidates: other vertices; LabelPoles chooses third poles among them
        inner: entries labelled inner
        outer: entries labelled outer
    """
    def __init__(self, centers: ArrayLike, radii: ArrayLike, labels: ArrayLike, defining_offsets: ArrayLike, defining_samples: ArrayLike, unbounded: ArrayLike, sample_poles: ArrayLike, uncertain: Optional[ArrayLike] = None) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def labels(self) -> NDArray[np.uint8]: ...
    @property
    def defining_offsets(self) -> NDArray[np.int64]: ...
    @property
    def defining_samples(self) -> NDArray[np.int32]: ...
    @property
    def unbounded(self) -> NDArray[np.uint8]: ...
    @property
    def sample_poles(self) -> NDArray[np.int32]: ...
    @property
    def uncertain(self) -> Optional[NDArray[np.uint8]]: ...


class Polygon2(Artifact):
    """Polygons in the plane: components with holes, the inside on the left.

    Arrays (attributes, in this order arguments of the constructor):

        vertices: n x 2 f64: coordinates, model units, y upwards
        ring_offsets: r+1 i64: where the vertices of a ring begin
        component_offsets: c+1 i64: where the rings of a component begin: the outer one, counter-clockwise,
          then holes, clockwise

    Summary:

        vertices: number of vertices
        components: number of outer rings
        holes: number of holes
        area: of the inside, squared model units
        perimeter: of all rings, model units
        bbox: bounding box in the plane z = 0, model units; null when it is empty
    """
    def __init__(self, vertices: ArrayLike, ring_offsets: ArrayLike, component_offsets: ArrayLike) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def ring_offsets(self) -> NDArray[np.int64]: ...
    @property
    def component_offsets(self) -> NDArray[np.int64]: ...


class PowerDiagram(Artifact):
    """The regular triangulation of balls, dual to their power diagram, and which of its simplices are in the
      dual complex of the union.

    Arrays (attributes, in this order arguments of the constructor):

        centers: n x 3 f64: centres of the balls, model units
        weights: n f64: squared radii, delta included
        cells: c x 4 i32: vertices of each cell: balls, -1 for the vertex at infinity, -2 where there are
          fewer than four; positively oriented, in lexicographic order of their ascending vertices
        neighbors: c x 4 i32: the cell opposite each vertex
        in_complex: c u8: bit 4: the cell is in the complex; bit k: its facet opposite vertex k is
        dimension: one number i32: of the affine hull of the centres; -1 without balls
        delta: one number f64: added to every squared radius before anything was decided

    Summary:

        balls: number of balls
        hidden: balls without a power cell
        dimension: of the affine hull of the centres; -1 without balls
        cells: finite cells of the triangulation
        infinite_cells: cells that close it to a sphere
        cells_in_complex: cells in the dual complex of the union
        delta: squared model units
    """
    def __init__(self, centers: ArrayLike, weights: ArrayLike, cells: ArrayLike, neighbors: ArrayLike, in_complex: ArrayLike, dimension: ArrayLike, delta: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def weights(self) -> NDArray[np.float64]: ...
    @property
    def cells(self) -> NDArray[np.int32]: ...
    @property
    def neighbors(self) -> NDArray[np.int32]: ...
    @property
    def in_complex(self) -> NDArray[np.uint8]: ...
    @property
    def dimension(self) -> NDArray[np.int32]: ...
    @property
    def delta(self) -> NDArray[np.float64]: ...


class Refinement(Artifact):
    """What became of the refinement of a sample, and where it could not go on.

    Arrays (attributes, in this order arguments of the constructor):

        refined: one number i64: 1, or 0 where the points that came in were returned
        complete: one number i64: 0 where the greatest number of samples stopped it
        left_out: one number i64: triangles with the inside on both sides, which were left out
        samples: one number i64: number of samples
        rounds: one number i64: rounds of insertions
        limited: l x 3 f64: where balls are below the floor, model units
        widths: l f64: width of the wall or slot there, model units
        uncovered: u i32: samples that no inner ball passes through
        wanted: 3 i64: components, tunnels, cavities of the solid; -1 if unknown
        cells: 3 i64: those of the inner Delaunay cells; -1 where they bound no surface
        balls: 3 i64: those of the union of the inner balls

    Summary:

        refined: whether samples were chosen, or the points that came in were returned
        complete: false where the greatest number of samples stopped it
        left_out: triangles with the inside on both sides, which were left out
        samples: number of samples
        rounds: rounds of insertions
        limited: balls below the floor that reach deep into a wall or slot
        thinnest: width of the thinnest such wall or slot, model units; null without one
        uncovered: samples that no inner ball passes through
        wanted: [components, tunnels, cavities] of the solid; null when not known
        cells: those of the inner Delaunay cells; null where they bound no surface
        balls: those of the union of the inner balls; null where nothing was refined
        reached: whether the union of the inner balls has the topology it should have
    """
    def __init__(self, refined: ArrayLike, complete: ArrayLike, left_out: ArrayLike, samples: ArrayLike, rounds: ArrayLike, limited: ArrayLike, widths: ArrayLike, uncovered: ArrayLike, wanted: ArrayLike, cells: ArrayLike, balls: ArrayLike) -> None: ...
    @property
    def refined(self) -> NDArray[np.int64]: ...
    @property
    def complete(self) -> NDArray[np.int64]: ...
    @property
    def left_out(self) -> NDArray[np.int64]: ...
    @property
    def samples(self) -> NDArray[np.int64]: ...
    @property
    def rounds(self) -> NDArray[np.int64]: ...
    @property
    def limited(self) -> NDArray[np.float64]: ...
    @property
    def widths(self) -> NDArray[np.float64]: ...
    @property
    def uncovered(self) -> NDArray[np.int32]: ...
    @property
    def wanted(self) -> NDArray[np.int64]: ...
    @property
    def cells(self) -> NDArray[np.int64]: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...


class Robot(Artifact):
    """The links of a robot with their surfaces, and the joints between them.

    Arrays (attributes, in this order arguments of the constructor):

        description: c u8: the URDF that it was read from, UTF-8
        name: a u8: of the robot, UTF-8
        link_names: b u8: a line for each link, UTF-8
        joint_names: e u8: a line for each joint, UTF-8
        joint_kinds: j u8: 0 fixed, 1 revolute, 2 continuous, 3 prismatic, 4 floating, 5 planar
        joint_parents: j i32: links
        joint_children: j i32: links
        joint_origins: j x 12 f64: frame of the child in that of the parent where the joint is at 0:
          rotation by rows, translation in metres
        joint_axes: j x 3 f64: unit vectors in the frame of the child
        joint_limits: j x 2 f64: radians or metres; 0, 0 where there are none
        joint_mimics: j i32: the joint that it follows, or -1
        joint_mimic_lines: j x 2 f64: factor and offset of that
        vertex_ends: l i64: where the vertices of each link end
        triangle_ends: l i64: where the triangles of each link end
        vertices: v x 3 f64: in the frame of their link, metres
        triangles: t x 3 i32: vertices by their place in the link

    Summary:

        name: of the robot
        links: how many
        joints: how many
        moving_joints: joints that are not fixed
        links_with_surface: links that have triangles
        triangles: of all links
    """
    def __init__(self, description: ArrayLike, name: ArrayLike, link_names: ArrayLike, joint_names: ArrayLike, joint_kinds: ArrayLike, joint_parents: ArrayLike, joint_children: ArrayLike, joint_origins: ArrayLike, joint_axes: ArrayLike, joint_limits: ArrayLike, joint_mimics: ArrayLike, joint_mimic_lines: ArrayLike, vertex_ends: ArrayLike, triangle_ends: ArrayLike, vertices: ArrayLike, triangles: ArrayLike) -> None: ...
    @property
    def description(self) -> NDArray[np.uint8]: ...
    @property
    def name(self) -> NDArray[np.uint8]: ...
    @property
    def link_names(self) -> NDArray[np.uint8]: ...
    @property
    def joint_names(self) -> NDArray[np.uint8]: ...
    @property
    def joint_kinds(self) -> NDArray[np.uint8]: ...
    @property
    def joint_parents(self) -> NDArray[np.int32]: ...
    @property
    def joint_children(self) -> NDArray[np.int32]: ...
    @property
    def joint_origins(self) -> NDArray[np.float64]: ...
    @property
    def joint_axes(self) -> NDArray[np.float64]: ...
    @property
    def joint_limits(self) -> NDArray[np.float64]: ...
    @property
    def joint_mimics(self) -> NDArray[np.int32]: ...
    @property
    def joint_mimic_lines(self) -> NDArray[np.float64]: ...
    @property
    def vertex_ends(self) -> NDArray[np.int64]: ...
    @property
    def triangle_ends(self) -> NDArray[np.int64]: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> NDArray[np.int32]: ...


class RobotSpheres(Artifact):
    """Balls for the links of a robot, and which links need not be tested against each other.

    Arrays (attributes, in this order arguments of the constructor):

        description: c u8: the URDF that it was read from, UTF-8
        name: a u8: of the robot, UTF-8
        link_names: b u8: a line for each link, UTF-8
        joint_names: e u8: a line for each joint, UTF-8
        joint_kinds: j u8: 0 fixed, 1 revolute, 2 continuous, 3 prismatic, 4 floating, 5 planar
        joint_parents: j i32: links
        joint_children: j i32: links
        joint_origins: j x 12 f64: frame of the child in that of the parent where the joint is at 0:
          rotation by rows, translation in metres
        joint_axes: j x 3 f64: unit vectors in the frame of the child
        joint_limits: j x 2 f64: radians or metres; 0, 0 where there are none
        joint_mimics: j i32: the joint that it follows, or -1
        joint_mimic_lines: j x 2 f64: factor and offset of that
        ball_ends: l i64: where the balls of each link end
        centers: n x 3 f64: in the frame of their link, metres
        radii: n f64: metres
        pair_links: p x 2 i32: links that need no test against each other
        pair_reasons: p u8: 0 adjacent, 1 meeting in the default pose, 2 in every pose tried, 3 in none
        poses: one number i64: poses that were tried; 0: pairs were not looked for
        open_ends: k i64: where the points of each link end that are not covered
        open_points: o x 3 f64: points of links that no ball covers, in their frames, metres; of surfaces
          and of voids inside

    Summary:

        name: of the robot
        links: how many
        links_with_balls: how many have any
        balls: of all links
        most_balls: of one link
        untested_pairs: pairs of links that need no test
        pairs_always: of these, pairs that met in every pose tried, and are not adjacent
        pairs_never: pairs that met in no pose tried
        poses: that were tried
        open_points: points of links that no ball covers; null where nothing was proven or tried
    """
    def __init__(self, description: ArrayLike, name: ArrayLike, link_names: ArrayLike, joint_names: ArrayLike, joint_kinds: ArrayLike, joint_parents: ArrayLike, joint_children: ArrayLike, joint_origins: ArrayLike, joint_axes: ArrayLike, joint_limits: ArrayLike, joint_mimics: ArrayLike, joint_mimic_lines: ArrayLike, ball_ends: ArrayLike, centers: ArrayLike, radii: ArrayLike, pair_links: ArrayLike, pair_reasons: ArrayLike, poses: ArrayLike, open_ends: ArrayLike, open_points: ArrayLike) -> None: ...
    @property
    def description(self) -> NDArray[np.uint8]: ...
    @property
    def name(self) -> NDArray[np.uint8]: ...
    @property
    def link_names(self) -> NDArray[np.uint8]: ...
    @property
    def joint_names(self) -> NDArray[np.uint8]: ...
    @property
    def joint_kinds(self) -> NDArray[np.uint8]: ...
    @property
    def joint_parents(self) -> NDArray[np.int32]: ...
    @property
    def joint_children(self) -> NDArray[np.int32]: ...
    @property
    def joint_origins(self) -> NDArray[np.float64]: ...
    @property
    def joint_axes(self) -> NDArray[np.float64]: ...
    @property
    def joint_limits(self) -> NDArray[np.float64]: ...
    @property
    def joint_mimics(self) -> NDArray[np.int32]: ...
    @property
    def joint_mimic_lines(self) -> NDArray[np.float64]: ...
    @property
    def ball_ends(self) -> NDArray[np.int64]: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def pair_links(self) -> NDArray[np.int32]: ...
    @property
    def pair_reasons(self) -> NDArray[np.uint8]: ...
    @property
    def poses(self) -> NDArray[np.int64]: ...
    @property
    def open_ends(self) -> NDArray[np.int64]: ...
    @property
    def open_points(self) -> NDArray[np.float64]: ...


class SampleAssignment(Artifact):
    """Which ball, and which vertex of a surface, every sample belongs to (thesis, 4.5.3).

    Arrays (attributes, in this order arguments of the constructor):

        points: n x 3 f64: the samples, model units
        balls: n i32: the ball to which the sample has the least power
        vertices: m i32: the vertex of the surface that the sample belongs to; none without a surface

    Summary:

        samples: number of samples
        used: vertices, or balls without a surface, that some sample belongs to
        largest: most samples of one of them
    """
    def __init__(self, points: ArrayLike, balls: ArrayLike, vertices: ArrayLike) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def balls(self) -> NDArray[np.int32]: ...
    @property
    def vertices(self) -> NDArray[np.int32]: ...


class Scaling(Artifact):
    """A map that stretches an object along three perpendicular axes.

    Arrays (attributes, in this order arguments of the constructor):

        origin: 3 f64: what is mapped to the origin, model units
        rotation: 4 f64: unit quaternion w x y z: from the axes of the coordinates to the three axes
        factors: 3 f64: along the axes, at least 1; the least is 1
        thickness: 3 f64: of the object along the axes, model units; 0 where factors were given
        longest_edge: one number f64: of the object's box along the coordinates, model units
        thickness_from: one number u8: 0 mean chords, 1 extents, 2 factors were given

    Summary:

        factors: along the three axes
        thickness: along the three axes, model units
        largest_factor: 1: nothing is stretched
        words: the factors, and what they are from
    """
    def __init__(self, origin: ArrayLike, rotation: ArrayLike, factors: ArrayLike, thickness: ArrayLike, longest_edge: ArrayLike, thickness_from: ArrayLike) -> None: ...
    @property
    def origin(self) -> NDArray[np.float64]: ...
    @property
    def rotation(self) -> NDArray[np.float64]: ...
    @property
    def factors(self) -> NDArray[np.float64]: ...
    @property
    def thickness(self) -> NDArray[np.float64]: ...
    @property
    def longest_edge(self) -> NDArray[np.float64]: ...
    @property
    def thickness_from(self) -> NDArray[np.uint8]: ...


class ShapeFit(Artifact):
    """The most plausible shape of a model for an observation of a part of it.

    Arrays (attributes, in this order arguments of the constructor):

        scores: q f64, optional: posterior mean, standard deviations
        covariance: qq f64, optional: posterior, of the scores, row by row
        pose: 12 f64: 3 x 4 by rows: from the model to the observation
        centers: k x 3 f64: of the fitted balls, model units
        radii: k f64: of the fitted balls, model units
        deviations: k f64: how uncertain each ball's place is, model units
        residual: one number f64: root mean square distance of what is explained, model units
        expected: one number f64: the same of an instance that the model does not know
        outliers: one number f64: part of the observation that no part of the shape explains
        mahalanobis: one number f64: root mean square score: about 1 for instances
        noise: one number f64: width around the shape at the end, model units
        observed: one number i64: points or balls of the observation
        iterations: one number i32: steps of the fit
        converged: one number u8: 1: it stood still at the end

    Summary:

        scores: posterior mean, standard deviations of the prior
        score_deviations: posterior standard deviations: 1 where the observation says nothing
        residual: root mean square distance of what is explained from the shape, model units
        expected: the same of an instance that the model does not know, model units; null: not known
        outliers: part of the observation that no part of the shape explains
        mahalanobis: root mean square score: about 1 for instances of the model, 0 for the mean
        largest_deviation: of the place of a ball, model units
        observed: points or balls of the observation
        iterations: steps
        converged: whether it stood still at the end
    """
    def __init__(self, *, scores: Optional[ArrayLike] = None, covariance: Optional[ArrayLike] = None, pose: ArrayLike, centers: ArrayLike, radii: ArrayLike, deviations: ArrayLike, residual: ArrayLike, expected: ArrayLike, outliers: ArrayLike, mahalanobis: ArrayLike, noise: ArrayLike, observed: ArrayLike, iterations: ArrayLike, converged: ArrayLike) -> None: ...
    @property
    def scores(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def covariance(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def pose(self) -> NDArray[np.float64]: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def deviations(self) -> NDArray[np.float64]: ...
    @property
    def residual(self) -> NDArray[np.float64]: ...
    @property
    def expected(self) -> NDArray[np.float64]: ...
    @property
    def outliers(self) -> NDArray[np.float64]: ...
    @property
    def mahalanobis(self) -> NDArray[np.float64]: ...
    @property
    def noise(self) -> NDArray[np.float64]: ...
    @property
    def observed(self) -> NDArray[np.int64]: ...
    @property
    def iterations(self) -> NDArray[np.int32]: ...
    @property
    def converged(self) -> NDArray[np.uint8]: ...


class ShapePose(Artifact):
    """A similarity transform that lays one shape on another, and how sure it is.

    Arrays (attributes, in this order arguments of the constructor):

        rotation: 9 f64: 3 x 3 by rows; determinant +1, or -1 where it mirrors
        scale: one number f64: above 0; 1 of a rigid transform
        translation: 3 f64: added last, model units of the target
        forward: one number f64: root mean square distance from what was moved to the target, trimmed, model
          units
        backward: one number f64: the same the other way; 0 where only a part was moved
        diagonal: one number f64: of the bounding box of the target, model units
        second_best: one number f64: residual of the second best pose by that of this one; 1: ambiguous; 0:
          there is no other
        mirror_image: one number f64: residual of the best mirroring pose by that of this one; 0: not looked
          for
        starts: one number i32: poses that the search began from; 0: none, the transform was given
        similarity: one number u8: 1: the scale was free
        mirrored: one number u8: 1: the transform mirrors

    Summary:

        rotation: by rows
        scale: factor
        translation: [x, y, z], model units
        degrees: angle of the rotation, degrees; null where it mirrors
        residual: [forward, backward] root mean square, model units
        relative_residual: root of the sum of their squares, as part of the target's diagonal
        second_best: residual of the second best pose by that of this one; null: there is no other
        mirror_image: residual of the best mirroring pose by that of this one; null: not looked for
        starts: poses that the search began from
        mirrored: whether the transform mirrors
    """
    def __init__(self, rotation: ArrayLike, scale: ArrayLike, translation: ArrayLike, forward: ArrayLike, backward: ArrayLike, diagonal: ArrayLike, second_best: ArrayLike, mirror_image: ArrayLike, starts: ArrayLike, similarity: ArrayLike, mirrored: ArrayLike) -> None: ...
    @property
    def rotation(self) -> NDArray[np.float64]: ...
    @property
    def scale(self) -> NDArray[np.float64]: ...
    @property
    def translation(self) -> NDArray[np.float64]: ...
    @property
    def forward(self) -> NDArray[np.float64]: ...
    @property
    def backward(self) -> NDArray[np.float64]: ...
    @property
    def diagonal(self) -> NDArray[np.float64]: ...
    @property
    def second_best(self) -> NDArray[np.float64]: ...
    @property
    def mirror_image(self) -> NDArray[np.float64]: ...
    @property
    def starts(self) -> NDArray[np.int32]: ...
    @property
    def similarity(self) -> NDArray[np.uint8]: ...
    @property
    def mirrored(self) -> NDArray[np.uint8]: ...


class ShapePrior(Artifact):
    """Mean and modes of variation of instances of one shape, as labelled balls.

    Arrays (attributes, in this order arguments of the constructor):

        centers: k x 3 f64: of the mean, model units
        radii: k f64: geometric means, model units
        points: m x 3 f64, optional: of the mean surface, model units
        normals: m x 3 f64, optional: of the mean surface, of length 1
        vertices: v x 3 f64, optional: of the template's surface where the mean has it, model units
        triangles: t x 3 i32, optional: of the template's surface, v indices
        point_share: one number f64: weight of the points in the metric; the rest is the balls'
        radius_unit: one number f64: length that a change of log r by 1 counts as, model units
        along: one number f64: weight of displacements of points along the surface
        modes: qk x 4 f64, optional: x, y, z, log r that one standard deviation adds to each ball, mode by
          mode
        point_modes: qm x 3 f64, optional: the same of each point: x, y, z
        variances: q f64, optional: descending, squared model units
        total_variance: one number f64: of all modes, also those that are not kept
        scores: nq f64, optional: instance by instance, standard deviations
        poses: n x 12 f64: 3 x 4 by rows: from an instance's coordinates to the model's
        distances: n f64: of the instances from the mean, model units
        generalization: g f64, optional: distance of an instance from the model of the others with 0, 1, ...
          modes, model units
        generalization_deviation: g f64, optional: standard deviation over the instances
        specificity: q f64, optional: distance of random shapes with 1, 2, ... modes from the nearest
          instance, model units
        specificity_deviation: q f64, optional: standard deviation over the random shapes
        measure: one number u8: of generalization: 0 to the instance's balls, 1 to planes at its points, 2
          to its mesh
        scaled: one number u8: 1: the instances were scaled to one size

    Summary:

        instances: number of instances
        balls: number of balls of each
        points: number of surface points of each
        modes: number of modes
        triangles: of the mesh of the mean; 0: none
        bbox: bounding box of the mean's centers, model units
        compactness: part of the variance in the first modes: of 1, of 2, ...
        deviations: root of the variance of each mode, model units
        generalization: mean distance of an instance from the model of the others with 0, 1, ... modes,
          model units
        generalization_deviation: its standard deviation
        specificity: mean distance of random shapes with 1, 2, ... modes from the nearest instance
        specificity_deviation: its standard deviation
        measured_to: what the distances of generalization are measured to
    """
    def __init__(self, *, centers: ArrayLike, radii: ArrayLike, points: Optional[ArrayLike] = None, normals: Optional[ArrayLike] = None, vertices: Optional[ArrayLike] = None, triangles: Optional[ArrayLike] = None, point_share: ArrayLike, radius_unit: ArrayLike, along: ArrayLike, modes: Optional[ArrayLike] = None, point_modes: Optional[ArrayLike] = None, variances: Optional[ArrayLike] = None, total_variance: ArrayLike, scores: Optional[ArrayLike] = None, poses: ArrayLike, distances: ArrayLike, generalization: Optional[ArrayLike] = None, generalization_deviation: Optional[ArrayLike] = None, specificity: Optional[ArrayLike] = None, specificity_deviation: Optional[ArrayLike] = None, measure: ArrayLike, scaled: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def points(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def normals(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def vertices(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def triangles(self) -> Optional[NDArray[np.int32]]: ...
    @property
    def point_share(self) -> NDArray[np.float64]: ...
    @property
    def radius_unit(self) -> NDArray[np.float64]: ...
    @property
    def along(self) -> NDArray[np.float64]: ...
    @property
    def modes(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def point_modes(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def variances(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def total_variance(self) -> NDArray[np.float64]: ...
    @property
    def scores(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def poses(self) -> NDArray[np.float64]: ...
    @property
    def distances(self) -> NDArray[np.float64]: ...
    @property
    def generalization(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def generalization_deviation(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def specificity(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def specificity_deviation(self) -> Optional[NDArray[np.float64]]: ...
    @property
    def measure(self) -> NDArray[np.uint8]: ...
    @property
    def scaled(self) -> NDArray[np.uint8]: ...


class SimplicialComplex(Artifact):
    """The weighted zero alpha-shape of balls: the dual complex of their union.

    Arrays (attributes, in this order arguments of the constructor):

        centers: n x 3 f64: centres of the balls, model units
        weights: n f64: squared radii, delta included
        vertices: v i32: balls that are vertices of the complex
        edges: e x 2 i32: pairs of balls, ascending
        triangles: t x 3 i32: triples of balls, ascending
        tetrahedra: c x 4 i32: quadruples of balls, ascending
        vertex_classes: v u8: 0 interior, 1 regular, 2 singular
        edge_classes: e u8: 0 interior, 1 regular, 2 singular
        triangle_classes: t u8: 0 interior, 1 regular, 2 singular
        delta: one number f64: added to every squared radius before anything was decided
        betti: 3 i64: components, tunnels, cavities of the union

    Summary:

        vertices: number
        edges: number
        triangles: number
        tetrahedra: number
        singular_vertices: isolated balls
        singular_edges: edges in no triangle
        singular_triangles: triangles in no tetrahedron
        interior_vertices: number
        interior_edges: number
        interior_triangles: number
        regular_vertices: number
        regular_edges: number
        regular_triangles: number
        delta: squared model units
        euler_characteristic: vertices - edges + triangles - tetrahedra
        betti: [components, tunnels, cavities] of the union
    """
    def __init__(self, centers: ArrayLike, weights: ArrayLike, vertices: ArrayLike, edges: ArrayLike, triangles: ArrayLike, tetrahedra: ArrayLike, vertex_classes: ArrayLike, edge_classes: ArrayLike, triangle_classes: ArrayLike, delta: ArrayLike, betti: ArrayLike) -> None: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def weights(self) -> NDArray[np.float64]: ...
    @property
    def vertices(self) -> NDArray[np.int32]: ...
    @property
    def edges(self) -> NDArray[np.int32]: ...
    @property
    def triangles(self) -> NDArray[np.int32]: ...
    @property
    def tetrahedra(self) -> NDArray[np.int32]: ...
    @property
    def vertex_classes(self) -> NDArray[np.uint8]: ...
    @property
    def edge_classes(self) -> NDArray[np.uint8]: ...
    @property
    def triangle_classes(self) -> NDArray[np.uint8]: ...
    @property
    def delta(self) -> NDArray[np.float64]: ...
    @property
    def betti(self) -> NDArray[np.int64]: ...


class SurfaceBallsReport(Artifact):
    """How large surface balls are, and on which ground their union has the topology of the surface.

    Arrays (attributes, in this order arguments of the constructor):

        radius: one number f64: rho, times the distance to the nearest pole
        shrink: one number f64: rho_bar, times the same, of the copies that have to cover the samples
        regime: one number u8: 0 proven, 1 supported, 2 heuristic
        samples: one number i64: number of samples
        raised: one number i64: balls that a floor made larger than rho D^
        coarse: one number i64: samples whose third neighbour is farther than 0.8 D^

    Summary:

        radius: rho, times the distance to the nearest pole
        shrink: rho_bar, of the copies that have to cover the samples
        regime: why the union has the topology of the surface: "proven" (Theorem 4.14), "supported" (by the
          thesis' experiments) or "heuristic"
        samples: number of samples
        raised: balls that a floor made larger than rho D^
        coarse: samples whose third neighbour is about as far as the medial axis, or farther
    """
    def __init__(self, radius: ArrayLike, shrink: ArrayLike, regime: ArrayLike, samples: ArrayLike, raised: ArrayLike, coarse: ArrayLike) -> None: ...
    @property
    def radius(self) -> NDArray[np.float64]: ...
    @property
    def shrink(self) -> NDArray[np.float64]: ...
    @property
    def regime(self) -> NDArray[np.uint8]: ...
    @property
    def samples(self) -> NDArray[np.int64]: ...
    @property
    def raised(self) -> NDArray[np.int64]: ...
    @property
    def coarse(self) -> NDArray[np.int64]: ...


class SurfaceReport(Artifact):
    """How a surface was found among the cells of a triangulation.

    Arrays (attributes, in this order arguments of the constructor):

        components: one number i64: connected components
        genus: one number i64: of all components together
        boundary_loops: one number i64: 0 for a closed surface
        overruled: one number f64: share of the weight of the poles' votes that it contradicts
        filled_area: one number f64: share of the area that closes holes
        wide_area: one number f64: share of the area that closes gaps wider than the balls
        left_out: one number i64: balls that the surface passes by, farther than their radius
        left_out_area: one number f64: their share of the squared radii of all
        farthest: one number f64: how far the farthest of them is, model units
        left_out_patch: one number i64: the most of them that hang together, by balls that meet
        patch_at: 3 f64: the centre of the farthest of these, model units
        mixed_voids: one number i64: parts of space with votes for both sides
        split_vertices: one number i64: copies of vertices where sheets touch
        midpoints: one number i64: vertices that are no samples
        specks: one number i64: small components that were left out
        vertex_balls: n i32: ball of each vertex, -1 for midpoints
        filled: m u8: 1 for triangles that close a gap, 2 for a wide one
        contradicted: m u8: 1 for triangles beside which poles say the contrary
        vertices: n x 3 f64: of the surface, model units
        triangles: m x 3 i32: of the surface

    Summary:

        components: connected components
        genus: of all components together
        overruled: share of the weight of the poles' votes that the surface contradicts
        boundary_loops: 0 for a closed surface
        filled_area: share of the area that closes gaps between balls
        filled: triangles that close them
        wide_area: share of the area that closes gaps wider than the balls around them: holes
        left_out: kept samples that the surface passes by, farther than their ball
        left_out_area: their share of the squared radii of all balls
        farthest: how far the farthest of them is, model units
        left_out_patch: the most of them that hang together: from ten on a part of the shape, not noise
        mixed_voids: parts of space with votes for both sides, which were cut
        split_vertices: copies of vertices where sheets touch
        midpoints: vertices that are no samples
        specks: small components that were left out
    """
    def __init__(self, components: ArrayLike, genus: ArrayLike, boundary_loops: ArrayLike, overruled: ArrayLike, filled_area: ArrayLike, wide_area: ArrayLike, left_out: ArrayLike, left_out_area: ArrayLike, farthest: ArrayLike, left_out_patch: ArrayLike, patch_at: ArrayLike, mixed_voids: ArrayLike, split_vertices: ArrayLike, midpoints: ArrayLike, specks: ArrayLike, vertex_balls: ArrayLike, filled: ArrayLike, contradicted: ArrayLike, vertices: ArrayLike, triangles: ArrayLike) -> None: ...
    @property
    def components(self) -> NDArray[np.int64]: ...
    @property
    def genus(self) -> NDArray[np.int64]: ...
    @property
    def boundary_loops(self) -> NDArray[np.int64]: ...
    @property
    def overruled(self) -> NDArray[np.float64]: ...
    @property
    def filled_area(self) -> NDArray[np.float64]: ...
    @property
    def wide_area(self) -> NDArray[np.float64]: ...
    @property
    def left_out(self) -> NDArray[np.int64]: ...
    @property
    def left_out_area(self) -> NDArray[np.float64]: ...
    @property
    def farthest(self) -> NDArray[np.float64]: ...
    @property
    def left_out_patch(self) -> NDArray[np.int64]: ...
    @property
    def patch_at(self) -> NDArray[np.float64]: ...
    @property
    def mixed_voids(self) -> NDArray[np.int64]: ...
    @property
    def split_vertices(self) -> NDArray[np.int64]: ...
    @property
    def midpoints(self) -> NDArray[np.int64]: ...
    @property
    def specks(self) -> NDArray[np.int64]: ...
    @property
    def vertex_balls(self) -> NDArray[np.int32]: ...
    @property
    def filled(self) -> NDArray[np.uint8]: ...
    @property
    def contradicted(self) -> NDArray[np.uint8]: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> NDArray[np.int32]: ...


class TopologyCheck(Artifact):
    """What the inclusion of a union of few balls in that of all of them does to homology over Z/2.

    Arrays (attributes, in this order arguments of the constructor):

        kept: one number i64: number of balls before the repair
        returned: one number i64: number of balls that the repair returned
        whole: 3 i64: components, tunnels, cavities of the union of all balls
        before: 3 i64: those of the balls before the repair
        before_rank: 3 i64: how many of them are independent ones of the whole
        after: 3 i64: those of the balls after the repair
        after_rank: 3 i64: how many of them are independent ones of the whole
        inclusions: one number i64: how many sets of balls were compared with the whole
        everything: one number u8: 1 where nothing less than all balls had the right topology

    Summary:

        isomorphism: the inclusion induces isomorphisms of homology over Z/2 after the repair
        isomorphism_before: the same before the repair
        words: what was wrong, and how many balls were returned
        kept: number of balls before the repair
        returned: balls that were returned
        inclusions: how many sets of balls were compared with the whole
        everything: true where nothing less than all balls had the right topology
        whole: [components, tunnels, cavities] of the union of all balls
        before: those before the repair
        after: those after the repair
        before_rank: how many of them are independent ones of the whole
        after_rank: how many of them are independent ones of the whole
    """
    def __init__(self, kept: ArrayLike, returned: ArrayLike, whole: ArrayLike, before: ArrayLike, before_rank: ArrayLike, after: ArrayLike, after_rank: ArrayLike, inclusions: ArrayLike, everything: ArrayLike) -> None: ...
    @property
    def kept(self) -> NDArray[np.int64]: ...
    @property
    def returned(self) -> NDArray[np.int64]: ...
    @property
    def whole(self) -> NDArray[np.int64]: ...
    @property
    def before(self) -> NDArray[np.int64]: ...
    @property
    def before_rank(self) -> NDArray[np.int64]: ...
    @property
    def after(self) -> NDArray[np.int64]: ...
    @property
    def after_rank(self) -> NDArray[np.int64]: ...
    @property
    def inclusions(self) -> NDArray[np.int64]: ...
    @property
    def everything(self) -> NDArray[np.uint8]: ...


class TopologyTable(Artifact):
    """Euler characteristic and Betti numbers of a shape at the stages of a pipeline.

    Arrays (attributes, in this order arguments of the constructor):

        stages: n u8: 0 solid inside the surface, 1 inner balls, 2 enlarged balls, 3 kept balls, 4 alpha-
          shape, 5 medial axis
        betti: n x 3 i64: components, tunnels, cavities; -1 where they are unknown
        euler: n i64: Euler characteristics, 0 where they are unknown

    Summary:

        words: what differs from stage to stage, or that nothing does
        changes: number of Betti numbers that differ from stage to stage
        surface: [components, tunnels, cavities] of the solid inside the surface; null when not known
        surface_euler: Euler characteristic of the solid inside the surface
        inner: [components, tunnels, cavities] of the union of the inner balls; null when not known
        inner_euler: Euler characteristic of the union of the inner balls
        enlarged: [components, tunnels, cavities] of the union of the enlarged balls; null when not known
        enlarged_euler: Euler characteristic of the union of the enlarged balls
        kept: [components, tunnels, cavities] of the union of the balls that are kept; null when not known
        kept_euler: Euler characteristic of the union of the balls that are kept
        complex: [components, tunnels, cavities] of the alpha-shape; null when not known
        complex_euler: Euler characteristic of the alpha-shape
        axis: [components, tunnels, cavities] of the medial axis; null when not known
        axis_euler: Euler characteristic of the medial axis
    """
    def __init__(self, stages: ArrayLike, betti: ArrayLike, euler: ArrayLike) -> None: ...
    @property
    def stages(self) -> NDArray[np.uint8]: ...
    @property
    def betti(self) -> NDArray[np.int64]: ...
    @property
    def euler(self) -> NDArray[np.int64]: ...


class TriangleMesh(Artifact):
    """An indexed set of triangles; it may be open or non-manifold, the summary says so.

    Arrays (attributes, in this order arguments of the constructor):

        vertices: v x 3 f64: coordinates, model units
        triangles: f x 3 i32: vertex indices

    Summary:

        vertices: number of vertices
        faces: number of triangles
        closed: every edge belongs to exactly two triangles
        manifold: edges have at most two triangles, vertex stars are one disk or half disk
        oriented: no two triangles run through a shared edge in the same direction
        genus: total over the components, boundary loops filled; null when not manifold or not oriented
        components: connected components
        boundary_loops: closed chains of boundary edges
    """
    def __init__(self, vertices: ArrayLike, triangles: ArrayLike) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> NDArray[np.int32]: ...


class Way(Artifact):
    """Whether there is a way between two points around a union of balls, and one.

    Arrays (attributes, in this order arguments of the constructor):

        balls: one number i64: number of balls
        start: 3 f64: where it begins, model units
        goal: 3 f64: where it ends
        answer: one number u8: 0 a way, 1 none, 2 start, 3 goal, 4 both in a ball
        proof: one number u8: the balls 0 are all there is, 1 contain the forbidden places, 2 lie in them
        components: one number i32: of what the balls leave of space
        start_component: one number i32: 0 the unbounded one, others are voids, -1 in a ball
        goal_component: one number i32: the same of the goal
        start_ball: one number i32: the ball that the start is deepest in; -1: none
        goal_ball: one number i32: the same of the goal
        points: n x 3 f64: of a polyline that meets no ball, model units; or none
        clearances: n f64: of the points from the nearest ball, model units
        clearance: one number f64: the least of the whole polyline

    Summary:

        answer: way, none, start inside, goal inside, both inside
        components: of what the balls leave of space: the unbounded one and voids
        component: [of the start, of the goal]; 0: the unbounded one, -1: in a ball
        points: number of points of the way
        length: of the way, model units; null: none
        clearance: no point of the way is nearer to a ball, model units; null: none
        words: the answer in words, and what it proves
    """
    def __init__(self, balls: ArrayLike, start: ArrayLike, goal: ArrayLike, answer: ArrayLike, proof: ArrayLike, components: ArrayLike, start_component: ArrayLike, goal_component: ArrayLike, start_ball: ArrayLike, goal_ball: ArrayLike, points: ArrayLike, clearances: ArrayLike, clearance: ArrayLike) -> None: ...
    @property
    def balls(self) -> NDArray[np.int64]: ...
    @property
    def start(self) -> NDArray[np.float64]: ...
    @property
    def goal(self) -> NDArray[np.float64]: ...
    @property
    def answer(self) -> NDArray[np.uint8]: ...
    @property
    def proof(self) -> NDArray[np.uint8]: ...
    @property
    def components(self) -> NDArray[np.int32]: ...
    @property
    def start_component(self) -> NDArray[np.int32]: ...
    @property
    def goal_component(self) -> NDArray[np.int32]: ...
    @property
    def start_ball(self) -> NDArray[np.int32]: ...
    @property
    def goal_ball(self) -> NDArray[np.int32]: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def clearances(self) -> NDArray[np.float64]: ...
    @property
    def clearance(self) -> NDArray[np.float64]: ...

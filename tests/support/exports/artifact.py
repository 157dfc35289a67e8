"""What an exported file should hold: the arrays of its artifact, and how numbers are compared."""

import json
import math
import struct

SINGULAR = 2  # class of a simplex
INTERIOR = 0


def require(condition, what):
    if not condition:
        raise AssertionError(what)


def same(found, expected, what):
    if found != expected:
        raise AssertionError(f"{what}: {str(found)[:200]} instead of {str(expected)[:200]}")


def float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def float32_row(row):
    return tuple(float32(value) for value in row)


def rows(values, width):
    return [tuple(values[i:i + width]) for i in range(0, len(values), width)]


def floats(text):
    return tuple(float(word) for word in text.split())


def fans(faces):
    return [(f[0], f[k - 1], f[k]) for f in faces for k in range(2, len(f))]


class Artifact:
    """What the formats should hold, from the arrays of the safetensors file."""

    CODES = {"f64": ("d", 8), "i64": ("q", 8), "i32": ("i", 4), "u8": ("B", 1)}

    def __init__(self, path):
        data = path.read_bytes()
        size, = struct.unpack_from("<Q", data)
        header = json.loads(data[8:8 + size])
        meta = header.pop("__metadata__")
        self.type = meta["type"]
        arrays = {}
        for name, entry in header.items():
            code, width = self.CODES[entry["dtype"].lower()]
            begin, end = entry["data_offsets"]
            values = struct.unpack_from(f"<{(end - begin) // width}{code}", data, 8 + size + begin)
            shape = entry["shape"]
            arrays[name] = rows(values, shape[1]) if len(shape) == 2 else list(values)
        self.arrays = arrays
        self.point_numbers = None
        self.columns = []  # (name, doubles of the points)
        self.coloured = False
        self.normals = self.radii = self.point_codes = self.face_codes = self.face_numbers = None
        self.points, self.edges, self.faces = [], [], []
        getattr(self, "read_" + self.type)(arrays)
        # What ma holds.
        self.all_edges, self.all_triangles = self.edges, fans(self.faces)
        if self.type == "SimplicialComplex":
            number = {ball: i for i, ball in enumerate(arrays["vertices"])}
            self.all_edges = [tuple(number[v] for v in edge) for edge in arrays["edges"]]
            self.all_triangles = [tuple(number[v] for v in t) for t in arrays["triangles"]]
        used = {v for element in self.edges + self.faces for v in element}
        self.dots = [v for v in range(len(self.points)) if v not in used]
        if self.type in ("TriangleMesh", "SurfaceReport"):
            self.dots = []
        if self.type == "SimplicialComplex":
            self.dots = [i for i, c in enumerate(arrays["vertex_classes"]) if c == SINGULAR]

    def read_PointSet(self, a):
        self.points = a["points"]
        self.normals = a.get("normals") or None

    def read_TriangleMesh(self, a):
        self.points, self.faces = a["vertices"], a["triangles"]

    def read_Balls(self, a):
        self.points, self.radii = a["centers"], a["radii"]

    def read_Ellipsoids(self, a):
        self.points = a["centers"]
        self.columns = [(f"radius_{k}", [r[k] for r in a["radii"]]) for k in range(3)]
        self.columns += [(f"rot_{k}", [q[k] for q in a["rotations"]]) for k in range(4)]

    def on_unit_sphere(self, i, p):
        """Where a point of the surface of ellipsoid i is on the sphere, by the matrix of its quaternion."""
        w, x, y, z = self.arrays["rotations"][i]
        columns = ((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
                   (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
                   (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))
        d = [u - v for u, v in zip(p, self.points[i])]
        return [sum(u * v for u, v in zip(column, d)) / r for column, r in zip(columns, self.arrays["radii"][i])]

    def check_surfaces(self, triangles, slack):
        """Triangles as three points each: as many of every ellipsoid, with corners on it."""
        same(len(triangles), 320 * len(self.points), "number of triangles")
        for i in range(len(self.points)):
            for triangle in triangles[320 * i:320 * (i + 1):40]:
                for p in triangle:
                    norm = math.hypot(*self.on_unit_sphere(i, p))
                    require(abs(norm - 1) < slack, f"a corner off ellipsoid {i} by {norm - 1}")

    def read_Polygon2(self, a):
        vertices, ends, parts = a["vertices"], a["ring_offsets"], a["component_offsets"]
        self.points = [(x, y, 0) for x, y in vertices]
        self.rings = [vertices[ends[i]:ends[i + 1]] for i in range(len(ends) - 1)]
        self.components = [self.rings[parts[k]:parts[k + 1]] for k in range(len(parts) - 1)]
        self.edges = [(first + i, first + (i + 1) % (end - first))
                      for first, end in zip(ends, ends[1:]) for i in range(end - first)]

    def read_DiscOutline(self, a):
        ends, parts = a["ring_offsets"], a["component_offsets"]
        arcs = [(*a["centers"][disc], a["radii"][disc], *begin, angle)
                for disc, begin, angle in zip(a["arc_discs"], a["arc_begins"], a["arc_angles"])]
        rings = [arcs[ends[i]:ends[i + 1]] for i in range(len(ends) - 1)]
        self.arcs = [(r, *arc) for r, ring in enumerate(rings) for arc in ring]
        self.components = [rings[parts[k]:parts[k + 1]] for k in range(len(parts) - 1)]

    def read_BallDistance(self, a):
        pairs = a["pairs"] and list(zip(a["pairs"], a["separations"], a["pair_points_a"], a["pair_points_b"]))
        if not pairs:
            pairs = [((a["a"][0], a["b"][0]), a["separation"][0], tuple(a["point_a"]), tuple(a["point_b"]))]
        self.pair_rows = [(*balls, separation, *p, *q) for balls, separation, p, q in pairs]
        for _, _, p, q in pairs:
            self.edges.append((len(self.points), len(self.points) + 1))
            self.points += [p, q]

    def read_Path(self, a):
        self.points, self.radii = a["points"], a["radii"]
        self.edges = [(i, i + 1) for i in range(len(self.points) - 1)]

    def read_Way(self, a):
        self.points, self.radii = a["points"], a["clearances"]
        self.edges = [(i, i + 1) for i in range(len(self.points) - 1)]

    def read_MatchedBalls(self, a):
        self.points, self.radii = a["centers"], a["radii"]
        self.point_codes = ("partner", [p + u for p, u in zip(a["partners"], a["unique"])])

    def read_PoleSet(self, a):
        self.points, self.radii = a["centers"], a["radii"]
        self.point_codes = ("label", a["labels"])

    def read_LocalFeatureSize(self, a):
        self.points, self.radii = a["points"], a["pole_distances"]

    def read_Growth(self, a):
        self.points, self.radii = a["centers"], a["grown_radii"]
        self.point_codes = ("stop", a["stops"])

    def read_ShapePrior(self, a):
        self.points, self.radii = a["centers"], a["radii"]
        modes = len(a.get("variances", []))
        scores = a.get("scores", [])
        self.score_rows = [(i, d, *scores[i * modes:(i + 1) * modes]) for i, d in enumerate(a["distances"])]

    def read_ShapeFit(self, a):
        self.points, self.radii = a["centers"], a["radii"]

    def read_SimplicialComplex(self, a):
        number = {ball: i for i, ball in enumerate(a["vertices"])}
        self.points = [a["centers"][ball] for ball in a["vertices"]]
        self.radii = [math.sqrt(a["weights"][ball]) for ball in a["vertices"]]
        self.edges = [tuple(number[v] for v in edge)
                      for edge, c in zip(a["edges"], a["edge_classes"]) if c == SINGULAR]
        seen = [(t, c) for t, c in zip(a["triangles"], a["triangle_classes"]) if c != INTERIOR]
        self.faces = [tuple(number[v] for v in t) for t, _ in seen]
        self.face_codes = ("class", [c for _, c in seen], SINGULAR)

    def read_MedialAxis(self, a):
        self.points, self.radii, self.edges = a["vertices"], a["radii"], a["edges"]
        ends = a["polygon_offsets"]
        self.faces = [tuple(a["polygon_vertices"][ends[i]:ends[i + 1]]) for i in range(len(ends) - 1)]
        self.face_codes = ("kind", a["polygon_kinds"], 0)
        self.face_numbers = ("sheet", a["polygon_sheets"], -1)

    def read_SampleAssignment(self, a):
        self.points = a["points"]
        self.point_numbers = ("vertex", a["vertices"]) if a["vertices"] else ("ball", a["balls"])

    def read_SurfaceReport(self, a):
        self.points, self.faces = a["vertices"], a["triangles"]
        codes = [3 if wrong else gap for gap, wrong in zip(a["filled"], a["contradicted"])]
        self.face_codes = ("evidence", codes, 0)
        self.coloured = True

    def read_CoverState(self, a):
        pass

    def read_RobotSpheres(self, a):
        """Spheres and pairs by the names of links."""
        names = [bytes(a[field]).decode().splitlines() for field in ("link_names", "joint_names")]
        self.link_names, self.joint_names = names
        balls = [(*c, r) for c, r in zip(a["centers"], a["radii"])]
        ends = [0] + a["ball_ends"]
        self.spheres = {name: balls[ends[i]:ends[i + 1]] for i, name in enumerate(self.link_names)}
        self.with_spheres = {name: list_ for name, list_ in self.spheres.items() if list_}
        self.pairs = [(self.link_names[i], self.link_names[k]) for i, k in a["pair_links"]]
        self.reasons = a["pair_reasons"]

    def read_Robot(self, a):
        ends = [0] + a["vertex_ends"]
        self.link_vertices = [a["vertices"][ends[i]:ends[i + 1]] for i in range(len(ends) - 1)]
        self.link_names = bytes(a["link_names"]).decode().splitlines()

    def offset_triangles(self):
        """Triangles of a robot, each with the number of vertices before those of its link."""
        begins, ends = [0] + self.arrays["vertex_ends"], self.arrays["triangle_ends"]
        link = 0
        for i, triangle in enumerate(self.arrays["triangles"]):
            while i >= ends[link]:
                link += 1
            yield begins[link], triangle

    def frames(self):
        """Rotation and place of each link of a robot, where its joints are at 0 or at the limit nearest to it."""
        a = self.arrays
        values = [min(max(0, low), high) if kind != 2 else 0 for (low, high), kind in zip(a["joint_limits"], a["joint_kinds"])]
        parent = {child: j for j, child in enumerate(a["joint_children"])}

        def value(joint):
            leader = a["joint_mimics"][joint]
            if leader < 0:
                return values[joint]
            factor, offset = a["joint_mimic_lines"][joint]
            return factor * value(leader) + offset

        def frame(link):
            if link not in parent:
                return ((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0)
            j = parent[link]
            rotation, place = frame(a["joint_parents"][j])
            origin, axis, kind = a["joint_origins"][j], a["joint_axes"][j], a["joint_kinds"][j]
            at, own = origin[9:], rows(origin[:9], 3)
            if kind == 3:
                at = tuple(p + value(j) * sum(r * u for r, u in zip(row, axis)) for p, row in zip(at, own))
            if kind in (1, 2):
                # Rodrigues: v cos + (u x v) sin + u (u . v) (1 - cos), for the three unit vectors.
                c, s = math.cos(value(j)), math.sin(value(j))
                turned = []
                for k in range(3):
                    v = [float(i == k) for i in range(3)]
                    cross = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]]
                    turned.append([v[i] * c + cross[i] * s + axis[i] * axis[k] * (1 - c) for i in range(3)])
                own = [[sum(row[i] * turned[k][i] for i in range(3)) for k in range(3)] for row in own]
            product = [[sum(row[i] * own[i][k] for i in range(3)) for k in range(3)] for row in rotation]
            return product, tuple(p + sum(r * x for r, x in zip(row, at)) for p, row in zip(place, rotation))

        return [frame(link) for link in range(len(self.link_names))]

    read_Enclosure = read_MassProperties = read_CoverState

    read_CoverCheck = read_Comparison = read_Bisection = read_CoverState
    read_TopologyTable = read_TopologyCheck = read_Refinement = read_CoverState
    read_MassProperties = read_SurfaceBallsReport = read_CoverState
    read_NoiseReport = read_MinkowskiReport = read_ShapePose = read_Scaling = read_CoverState

    def balls(self):
        return [(*p, r) for p, r in zip(self.points, self.radii)]

    def table(self):
        """Names and rows of the point data."""
        names, columns = ["x", "y", "z"], [list(c) for c in zip(*self.points)] or [[], [], []]
        if self.normals:
            names += ["nx", "ny", "nz"]
            columns += [list(c) for c in zip(*self.normals)]
        if self.radii is not None:
            names.append("radius")
            columns.append(self.radii)
        for name, values in self.columns:
            names.append(name)
            columns.append(values)
        if self.point_codes:
            names.append(self.point_codes[0])
            columns.append(self.point_codes[1])
        if self.point_numbers:
            names.append(self.point_numbers[0])
            columns.append(self.point_numbers[1])
        return names, [tuple(row) for row in zip(*columns)]

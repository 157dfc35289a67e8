"""Reads exported files by their specifications and compares them with the artifacts they were made from.

check_exports.py FOLDER: for every NAME.safetensors in the folder, every other NAME.FORMAT must hold the same
numbers, to the last bit where the format has doubles and to the nearest float where it has floats. Prints one
line per file that was compared; exit code 1 when one differs. Uses nothing but the standard library, and none
of the code that wrote the files.
"""

import csv
import json
import math
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree as ElementTree

SINGULAR = 2  # class of a simplex
INTERIOR = 0
MOST_BALL_NODES = 20000


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


# ---- the artifact


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

    def read_PoleSet(self, a):
        self.points, self.radii = a["centers"], a["radii"]
        self.point_codes = ("label", a["labels"])

    def read_LocalFeatureSize(self, a):
        self.points, self.radii = a["points"], a["pole_distances"]

    def read_Growth(self, a):
        self.points, self.radii = a["centers"], a["grown_radii"]
        self.point_codes = ("stop", a["stops"])

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
    read_NoiseReport = read_CoverState

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
        if self.point_codes:
            names.append(self.point_codes[0])
            columns.append(self.point_codes[1])
        if self.point_numbers:
            names.append(self.point_numbers[0])
            columns.append(self.point_numbers[1])
        return names, [tuple(row) for row in zip(*columns)]


def fans(faces):
    return [(f[0], f[k - 1], f[k]) for f in faces for k in range(2, len(f))]


# ---- the formats


def check_ply(data, artifact):
    head, _, body = data.partition(b"end_header\n")
    lines = head.decode("ascii").splitlines()
    same(lines[:2], ["ply", "format binary_little_endian 1.0"], "first lines")
    kinds = {"double": "d", "int": "i", "uchar": "B"}
    elements, at = [], 0
    for words in (line.split() for line in lines[2:]):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    found = {}
    for name, count, properties in elements:
        table = found[name] = ([p[-1] for p in properties], [])
        for _ in range(count):
            row = []
            for p in properties:
                if p[0] == "list":
                    n, = struct.unpack_from("<" + kinds[p[1]], body, at)
                    at += struct.calcsize(kinds[p[1]])
                    row.append(struct.unpack_from(f"<{n}{kinds[p[2]]}", body, at))
                    at += n * struct.calcsize(kinds[p[2]])
                else:
                    row += struct.unpack_from("<" + kinds[p[0]], body, at)
                    at += struct.calcsize(kinds[p[0]])
            table[1].append(tuple(row))
    same(at, len(body), "bytes after the header")
    same(found["vertex"], artifact.table(), "vertices")
    faces = [(tuple(f),) for f in artifact.faces]
    names = ["vertex_indices"]
    for values in (artifact.face_codes, artifact.face_numbers):
        if values:
            names.append(values[0])
            faces = [(*f, value) for f, value in zip(faces, values[1])]
    if artifact.coloured and faces:
        # One colour per code, and never one for two.
        colours = [f[-3:] for f in found["face"][1]]
        codes = artifact.face_codes[1]
        same(len(set(zip(codes, colours))), len(set(codes)), "colours")
        same(len(set(colours)), len(set(codes)), "colours")
        names += ["red", "green", "blue"]
        faces = [(*f, *colour) for f, colour in zip(faces, colours)]
    if faces:
        same(found["face"], (names, faces), "faces")
    if artifact.edges:
        same(found["edge"], (["vertex1", "vertex2"], artifact.edges), "edges")
    same(set(found), {"vertex"} | ({"face"} if faces else set()) | ({"edge"} if artifact.edges else set()),
         "elements")


def check_obj(data, artifact):
    elements = {"v": [], "f": [], "l": []}
    for line in data.decode("ascii").splitlines():
        if not line.startswith("#"):
            elements[line[0]].append(floats(line[1:]))
    same(elements["v"], artifact.points, "vertices")
    for kind, expected in (("f", artifact.faces), ("l", artifact.edges)):
        same([tuple(int(v) - 1 for v in e) for e in elements[kind]], expected, kind)


def check_off(data, artifact):
    lines = data.decode("ascii").splitlines()
    n, m = len(artifact.points), len(artifact.faces)
    same(lines[:2], ["OFF", f"{n} {m} 0"], "header")
    same([floats(line) for line in lines[2:2 + n]], artifact.points, "points")
    same([tuple(map(int, line.split())) for line in lines[2 + n:]], [(len(f), *f) for f in artifact.faces], "faces")


def check_stl(data, artifact):
    triangles = fans(artifact.faces)
    require(not data.startswith(b"solid"), "looks like an ASCII file")
    same(len(data), 84 + 50 * len(triangles), "bytes")
    same(struct.unpack_from("<I", data, 80)[0], len(triangles), "count")
    for i, triangle in enumerate(triangles):
        values = struct.unpack_from("<12fH", data, 84 + 50 * i)
        same(rows(values[3:12], 3), [float32_row(artifact.points[v]) for v in triangle], f"triangle {i}")


def check_topology_csv(lines, arrays):
    same(lines[0], "stage,euler,components,tunnels,cavities", "names")
    names = ["surface", "inner", "enlarged", "kept", "complex", "axis"]
    expected = []
    for stage, euler, betti in zip(arrays["stages"], arrays["euler"], arrays["betti"]):
        numbers = [""] * 4 if betti[0] < 0 else [str(n) for n in (euler, *betti)]
        expected.append(",".join([names[stage], *numbers]))
    same(lines[1:], expected, "rows")


def check_csv(data, artifact):
    lines = data.decode("ascii").splitlines()
    if artifact.type == "RobotSpheres":
        found = {}
        for row in csv.DictReader(lines):
            numbers = tuple(float(row[name]) for name in ("x", "y", "z", "radius"))
            found.setdefault(row["link"], []).append(numbers)
        return same(found, artifact.with_spheres, "spheres")
    if artifact.type == "DiscOutline":
        same(lines[0], "ring,x,y,r,begin_x,begin_y,angle", "names")
        return same([tuple(map(float, line.split(","))) for line in lines[1:]], artifact.arcs, "arcs")
    if artifact.type == "TopologyTable":
        return check_topology_csv(lines, artifact.arrays)
    if artifact.type == "CoverState":
        names = ["ball", "how"]
        expected = list(zip(artifact.arrays["chosen"], artifact.arrays["chosen_how"]))
    else:
        names, expected = artifact.table()
        names = ["r" if name == "radius" else name for name in names]
    same(lines[0].split(","), names, "names")
    same([tuple(map(float, line.split(","))) for line in lines[1:]], expected, "rows")


def check_xyz(data, artifact):
    same([floats(line) for line in data.decode("ascii").splitlines()], artifact.table()[1], "rows")


def check_npy(data, artifact):
    same(data[:8], b"\x93NUMPY\x01\x00", "magic number")
    size, = struct.unpack_from("<H", data, 8)
    header = data[10:10 + size].decode("ascii")
    require((10 + size) % 64 == 0 and header.endswith("\n"), "the header is not aligned")
    found = re.fullmatch(r"\{'descr': '<f8', 'fortran_order': False, 'shape': \((\d+), (\d)\), \} *\n", header)
    require(found, header)
    expected = artifact.balls() if artifact.radii is not None else artifact.points
    width = 4 if artifact.radii is not None else 3
    same((int(found[1]), int(found[2])), (len(expected), width), "shape")
    values = struct.unpack(f"<{len(expected) * width}d", data[10 + size:])
    same(rows(values, width), expected, "values")


def check_vtp(data, artifact):
    head, found, tail = data.partition(b'<AppendedData encoding="raw">\n_')
    require(found, "no appended data")
    require(tail.endswith(b"\n</AppendedData>\n</VTKFile>\n"), "the end of the file")
    blocks = tail[:-len(b"\n</AppendedData>\n</VTKFile>\n")]
    root = ElementTree.fromstring(head + b"</VTKFile>")
    same(root.attrib, {"type": "PolyData", "version": "1.0", "byte_order": "LittleEndian", "header_type": "UInt64"},
         "VTKFile")
    piece = root.find("PolyData/Piece")
    kinds = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B"}
    next_offset = 0
    arrays = {}
    for section in piece:
        for array in section:
            same(int(array.get("offset")), next_offset, f"offset of {array.get('Name')}")
            size, = struct.unpack_from("<Q", blocks, next_offset)
            kind, width = kinds[array.get("type")], int(array.get("NumberOfComponents"))
            values = struct.unpack_from(f"<{size // struct.calcsize(kind)}{kind}", blocks, next_offset + 8)
            arrays[section.tag, array.get("Name")] = rows(values, width) if width > 1 else list(values)
            next_offset += 8 + size
    same(next_offset, len(blocks), "bytes of the blocks")

    expected = {("Points", "Points"): artifact.points}
    if artifact.normals:
        expected["PointData", "Normals"] = artifact.normals
    if artifact.radii is not None:
        expected["PointData", "radius"] = artifact.radii
    if artifact.point_codes:
        expected["PointData", artifact.point_codes[0]] = artifact.point_codes[1]
    if artifact.point_numbers:
        expected["PointData", artifact.point_numbers[0]] = artifact.point_numbers[1]
    for values in (artifact.face_codes, artifact.face_numbers):
        if values:
            name, of_faces, of_others = values
            expected["CellData", name] = [of_others] * (len(artifact.dots) + len(artifact.edges)) + of_faces
    counts = {"Strips": 0, "Points": len(artifact.points)}
    cells = {"Verts": [(v,) for v in artifact.dots], "Lines": artifact.edges, "Polys": artifact.faces}
    for section, elements in cells.items():
        counts[section] = len(elements)
        expected[section, "connectivity"] = [v for element in elements for v in element]
        expected[section, "offsets"] = [sum(map(len, elements[:1])) * (i + 1) for i in range(len(elements))]
        if section == "Polys":
            end, ends = 0, []
            for element in elements:
                end += len(element)
                ends.append(end)
            expected[section, "offsets"] = ends
    same({k[len("NumberOf"):]: int(v) for k, v in piece.attrib.items()}, counts, "Piece")
    same(arrays, expected, "arrays")


def check_ma(data, artifact):
    lines = data.decode("ascii").splitlines()
    sides = {tuple(sorted(pair)) for a, b, c in artifact.all_triangles for pair in ((a, b), (b, c), (c, a))}
    edges = sorted(sides | {tuple(sorted(edge)) for edge in artifact.all_edges})
    triangles = artifact.all_triangles
    n, m = len(artifact.points), len(edges)
    same(lines[0], f"{n} {m} {len(triangles)}", "header")
    kinds = "".join(line[:2] for line in lines[1:])
    same(kinds, "v " * n + "e " * m + "f " * len(triangles), "kinds of lines")
    same([floats(line[2:]) for line in lines[1:1 + n]], artifact.balls(), "v")
    same([tuple(map(int, line[2:].split())) for line in lines[1 + n:1 + n + m]], edges, "e")
    same([tuple(map(int, line[2:].split())) for line in lines[1 + n + m:]], triangles, "f")


def closed(components):
    return [[ring + ring[:1] for ring in rings] for rings in components]


def check_geojson(data, artifact):
    found = json.loads(data)
    same(found["type"], "MultiPolygon", "type")
    rings = [[[tuple(point) for point in ring] for ring in rings] for rings in found["coordinates"]]
    same(rings, closed(artifact.components), "coordinates")


def check_wkt(data, artifact):
    text = data.decode("ascii")
    if not artifact.components:
        return same(text, "MULTIPOLYGON EMPTY\n", "text")
    require(text.startswith("MULTIPOLYGON (((") and text.endswith(")))\n"), "the ends")
    rings = [[[floats(point) for point in ring.split(", ")] for ring in rings.split("), (")]
             for rings in text[len("MULTIPOLYGON ((("):-len(")))\n")].split(")), ((")]
    same(rings, closed(artifact.components), "coordinates")


def check_poly2d(data, artifact):
    lines = data.decode("ascii").splitlines()
    same(lines[0], str(len(artifact.rings)), "number of rings")
    at = 1
    for ring in artifact.rings:
        same(lines[at], str(len(ring)), "number of points")
        same([floats(line) for line in lines[at + 1:at + 1 + len(ring)]], ring, "points")
        at += 1 + len(ring)
    same(at, len(lines), "lines")


def check_arcs(paths, artifact):
    """Every arc of the outline is some arcs of the path, over the same circle, with ends to the last bit."""
    same(len(paths), len(artifact.components), "paths")
    for path, rings in zip(paths, artifact.components):
        texts = path[1:-1].split("ZM")
        same(len(texts), len(rings), "rings")
        for text, ring in zip(texts, rings):
            begin, *pieces = text.split("A")
            here = floats(begin)
            pieces = [floats(piece) for piece in pieces]
            for i, (x, y, r, bx, by, angle) in enumerate(ring):
                same(here, (bx, by), "begin of an arc")
                end = ring[(i + 1) % len(ring)][3:5]
                gone = 0
                while True:
                    rx, ry, _, large, sweep, *there = pieces.pop(0)
                    same((rx, ry, large, sweep), (r, r, 0, 1), "an arc")
                    require(abs(math.hypot(there[0] - x, there[1] - y) - r) < 1e-9 * (r + abs(x) + abs(y)), "circle")
                    gone += 2 * math.asin(min(1, math.hypot(there[0] - here[0], there[1] - here[1]) / (2 * r)))
                    here = tuple(there)
                    if here == end and abs(gone - angle) < 1e-6:
                        break
            same(pieces, [], "pieces after the last arc")


def check_svg(data, artifact):
    root = ElementTree.fromstring(data)
    group, = root
    name = "{http://www.w3.org/2000/svg}"
    same((root.tag, group.tag), (name + "svg", name + "g"), "elements")
    same(group.get("transform"), "scale(1 -1)", "transform")
    if artifact.type == "Balls":
        found = [(float(c.get("cx")), float(c.get("cy")), float(c.get("r"))) for c in group]
        return same(found, [(x, y, r) for x, y, _, r in artifact.balls()], "circles")
    if artifact.type == "DiscOutline":
        return check_arcs([path.get("d") for path in group], artifact)
    found = [[[floats(point) for point in ring.split("L")] for ring in path.get("d")[1:-1].split("ZM")]
             for path in group]
    same(found, artifact.components, "paths")


def check_sph(data, artifact):
    lines = data.decode("ascii").splitlines()
    same(lines[0], str(len(artifact.points)), "number")
    same([floats(line) for line in lines[1:]], artifact.balls(), "balls")


def check_yaml(data, artifact):
    text = data.decode("ascii")
    if not artifact.points:
        return same(text, "collision_spheres:\n  link: []\n", "text")
    entry = r"    - center: \[(\S+), (\S+), (\S+)\]\n      radius: (\S+)\n"
    require(re.fullmatch(r"collision_spheres:\n  link:\n(" + entry + ")*", text), "the layout")
    same([tuple(map(float, found)) for found in re.findall(entry, text)], artifact.balls(), "spheres")


def ignored_pairs(lists):
    return {(a, b) for a, partners in lists.items() for b in partners}


def yaml_spheres(lists):
    return {link: [(*map(float, s["center"]), float(s["radius"])) for s in spheres] for link, spheres in lists.items()}


def check_curobo(data, artifact):
    import yaml
    kinematics = yaml.safe_load(data)["robot_cfg"]["kinematics"]
    same(yaml_spheres(kinematics["collision_spheres"]), artifact.with_spheres, "spheres")
    same(kinematics["collision_link_names"], list(artifact.with_spheres), "links")
    same(ignored_pairs(kinematics["self_collision_ignore"]), set(artifact.pairs), "pairs")
    require(kinematics["base_link"] in artifact.link_names, "base_link")


def check_xrdf(data, artifact):
    import yaml
    robot = yaml.safe_load(data)
    same((robot["format"], robot["format_version"]), ("xrdf", 1.0), "format")
    geometry = robot["geometry"][robot["collision"]["geometry"]]
    same(yaml_spheres(geometry["spheres"]), artifact.with_spheres, "spheres")
    same(robot["self_collision"]["geometry"], robot["collision"]["geometry"], "geometry")
    same(ignored_pairs(robot["self_collision"]["ignore"]), set(artifact.pairs), "pairs")
    require(set(robot["default_joint_positions"]) <= set(artifact.joint_names), "joints")


def check_foam(data, artifact):
    found = {link: [(*s["origin"], s["radius"]) for s in entry["spheres"]] for link, entry in json.loads(data).items()}
    same(found, artifact.with_spheres, "spheres")


def check_srdf(data, artifact):
    root = ElementTree.fromstring(data)
    found = {link.get("link"): [(*floats(s.get("center")), float(s.get("radius"))) for s in link]
             for link in root.findall("link_sphere_approximation")}
    disabled = {name: spheres or [(0, 0, 0, 0)] for name, spheres in artifact.spheres.items()}
    same(found, disabled, "spheres")
    pairs = [(p.get("link1"), p.get("link2")) for p in root.findall("disable_collisions")]
    same(pairs, artifact.pairs, "pairs")
    reasons = [("Adjacent", "Default", "Always", "Never")[code] for code in artifact.reasons]
    same([p.get("reason") for p in root.findall("disable_collisions")], reasons, "reasons")


def check_mjcf(data, artifact):
    root = ElementTree.fromstring(data)
    bodies = {body.get("name"): body for body in root.iter("body")}
    same(set(bodies), set(artifact.link_names), "bodies")
    for name, body in bodies.items():
        geoms = body.findall("geom")
        require(all(g.get("type") == "sphere" for g in geoms), "spheres only")
        found = [(*floats(g.get("pos")), float(g.get("size"))) for g in geoms]
        same(found, artifact.spheres[name], "spheres of " + name)
        # The place of the body in that of its parent is the origin of its joint.
        for child in body.findall("body"):
            joint = artifact.arrays["joint_children"].index(artifact.link_names.index(child.get("name")))
            same(artifact.link_names[artifact.arrays["joint_parents"][joint]], name, "parent")
            origin = artifact.arrays["joint_origins"][joint]
            same(floats(child.get("pos")), tuple(origin[9:]), "place")
            w, x, y, z = floats(child.get("quat"))
            turned = (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
            require(all(abs(p - q) < 1e-12 for p, q in zip(turned, origin)), "rotation")
    same([(e.get("body1"), e.get("body2")) for e in root.iter("exclude")], artifact.pairs, "pairs")


def check_urdf(data, artifact):
    if artifact.type == "RobotSpheres":
        root = ElementTree.fromstring(data)
        found = {link.get("name"): [(*floats(c.find("origin").get("xyz")), float(c.find("geometry/sphere").get("radius")))
                                    for c in link.findall("collision")] for link in root.findall("link")}
        same({j.get("name") for j in root.findall("joint")}, set(artifact.joint_names), "joints")
        return same(found, artifact.spheres, "spheres")
    link = ElementTree.fromstring(data).find("link")
    found = [(*floats(c.find("origin").get("xyz")), float(c.find("geometry/sphere").get("radius"))) for c in link]
    same(found, artifact.balls(), "spheres")


class Glb:
    """A glTF file, its structure checked as strictly as the specification asks."""

    WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
    KINDS = {5123: "H", 5125: "I", 5126: "f"}

    def __init__(self, data):
        magic, version, size = struct.unpack_from("<4sII", data)
        same((magic, version, size), (b"glTF", 2, len(data)), "header")
        chunks, at = [], 12
        while at < len(data):
            length, kind = struct.unpack_from("<I4s", data, at)
            require(length % 4 == 0 and at + 8 + length <= len(data), "length of a chunk")
            chunks.append((kind, data[at + 8:at + 8 + length]))
            at += 8 + length
        kinds = [kind for kind, _ in chunks]
        require(kinds in ([b"JSON"], [b"JSON", b"BIN\0"]), f"chunks {kinds}")
        self.gltf = json.loads(chunks[0][1])
        same(self.gltf["asset"]["version"], "2.0", "version")
        for name, value in self.gltf.items():
            require(value != [], f"{name} is empty")
        binary = chunks[1][1] if len(chunks) == 2 else b""
        if binary:
            length = self.gltf["buffers"][0]["byteLength"]
            require(length <= len(binary) <= length + 3, "length of the buffer")
        self.accessors = [self.accessor(entry, binary) for entry in self.gltf.get("accessors", [])]
        for mesh in self.gltf.get("meshes", []):
            for primitive in mesh["primitives"]:
                self.check_primitive(primitive)

    def accessor(self, entry, binary):
        view = self.gltf["bufferViews"][entry["bufferView"]]
        kind, width = self.KINDS[entry["componentType"]], self.WIDTHS[entry["type"]]
        count = entry["count"] * width
        require(entry["count"] > 0, "an accessor without elements")
        require(view["byteOffset"] % struct.calcsize(kind) == 0, "alignment")
        same(view["byteLength"], count * struct.calcsize(kind), "length of a view")
        require(view["byteOffset"] + view["byteLength"] <= len(binary), "a view beyond the buffer")
        values = struct.unpack_from(f"<{count}{kind}", binary, view["byteOffset"])
        require(all(map(math.isfinite, values)), "a number that is not finite")
        values = rows(values, width) if width > 1 else list(values)
        if "min" in entry:
            same(entry["min"], [min(c) for c in zip(*values)], "min")
            same(entry["max"], [max(c) for c in zip(*values)], "max")
        return values

    def check_primitive(self, primitive):
        attributes = {name: self.accessors[i] for name, i in primitive["attributes"].items()}
        n = len(attributes["POSITION"])
        require("min" in self.gltf["accessors"][primitive["attributes"]["POSITION"]], "POSITION without bounds")
        for name, values in attributes.items():
            same(len(values), n, name)
            require(name in ("POSITION", "NORMAL", "COLOR_0") or re.fullmatch("_[A-Z0-9_]+", name), name)
        for normal in attributes.get("NORMAL", []):
            require(abs(math.dist(normal, (0, 0, 0)) - 1) < 1e-6, "a normal that is not of length 1")
        if "COLOR_0" in attributes:
            require(self.gltf["accessors"][primitive["attributes"]["COLOR_0"]]["normalized"], "colours")
        if "indices" in primitive:
            indices = self.accessors[primitive["indices"]]
            require(max(indices) < n, "an index beyond the vertices")
            same(len(indices) % {1: 2, 4: 3}[primitive.get("mode", 4)], 0, "indices")
        require(primitive["material"] < len(self.gltf["materials"]), "material")

    def roots(self):
        nodes = self.gltf.get("nodes", [])
        for i in self.gltf["scenes"][self.gltf["scene"]].get("nodes", []):
            yield nodes[i], [nodes[k] for k in nodes[i].get("children", [])]

    def primitive(self, node):
        primitives = self.gltf["meshes"][node["mesh"]]["primitives"]
        same(len(primitives), 1, "primitives")
        p = primitives[0]
        attributes = {name: self.accessors[i] for name, i in p["attributes"].items()}
        width = {0: 1, 1: 2, 4: 3}[p.get("mode", 4)]
        indices = rows(self.accessors[p["indices"]], width) if "indices" in p else None
        return attributes, indices, width


def check_sphere(attributes, triangles):
    positions = attributes["POSITION"]
    same(len(positions) - 3 * len(triangles) // 2 + len(triangles), 2, "Euler characteristic of the sphere")
    for p in positions:
        require(abs(math.dist(p, (0, 0, 0)) - 1) < 1e-6, "a vertex that is not on the sphere")
    for a, b, c in triangles:
        a, b, c = positions[a], positions[b], positions[c]
        u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        require(sum(x * y for x, y in zip(normal, a)) > 0, "a triangle that looks inward")


def placed_by(frame, p):
    rotation, place = frame
    return tuple(t + sum(r * x for r, x in zip(row, p)) for t, row in zip(place, rotation))


def check_robot_glb(glb, artifact):
    """Meshes, spheres and points of the links where the joints put them."""
    roots = list(glb.roots())
    if artifact.type == "RobotSpheres" and artifact.arrays["open_points"]:
        attributes, _, width = glb.primitive(roots.pop()[0])
        ends = [0] + artifact.arrays["open_ends"]
        expected = [placed_by(f, p) for i, f in enumerate(artifact.frames())
                    for p in artifact.arrays["open_points"][ends[i]:ends[i + 1]]]
        same((width, len(attributes["POSITION"])), (1, len(expected)), "points")
        require(all(math.dist(a, b) < 1e-6 for a, b in zip(attributes["POSITION"], expected)), "points")
    same(len(roots), 1, "nodes")
    root, children = roots[0]
    if artifact.type == "Robot":
        attributes, triangles, _ = glb.primitive(root)
        same(triangles, [tuple(v + offset for v in t) for offset, t in artifact.offset_triangles()], "triangles")
        found = [(*p, 0) for p in attributes["POSITION"]]
        expected = [(*placed_by(f, p), 0) for f, part in zip(artifact.frames(), artifact.link_vertices) for p in part]
        numbers = [i for i, part in enumerate(artifact.link_vertices) for _ in part]
        same(attributes["_LINK"], [float(i) for i in numbers], "links")
    else:
        found = [(*child["translation"], child["scale"][0]) for child in children]
        expected = [(*placed_by(f, s[:3]), s[3]) for f, name in zip(artifact.frames(), artifact.link_names)
                    for s in artifact.spheres[name]]
    same(len(found), len(expected), "elements")
    for a, b in zip(found, expected):
        require(math.dist(a, b) < 1e-6, f"{a} instead of {b}")


def check_glb(data, artifact):
    glb = Glb(data)
    if artifact.type in ("Robot", "RobotSpheres"):
        return check_robot_glb(glb, artifact)
    points = {float32_row(p) for p in artifact.points}
    found = {1: set(), 2: set(), 3: set()}
    count = {1: 0, 2: 0, 3: 0}
    balls = []
    for root, children in glb.roots():
        for child in children:
            attributes, triangles, _ = glb.primitive(child)
            if not balls:
                check_sphere(attributes, triangles)
            same(len(set(child["scale"])), 1, "scale")
            balls.append((*child["translation"], child["scale"][0]))
        if children:
            continue
        attributes, elements, width = glb.primitive(root)
        positions = attributes["POSITION"]
        require(set(positions) <= points, "a position that is no point of the artifact")
        elements = elements if elements is not None else [(i,) for i in range(len(positions))]
        count[width] += len(elements)
        found[width] |= {tuple(positions[v] for v in element) for element in elements}
        if "_RADIUS" in attributes:
            radius = {}
            for p, r in artifact.table()[1] and zip(artifact.points, artifact.radii):
                radius.setdefault(float32_row(p), set()).add(float32(r))
            for p, r in zip(positions, attributes["_RADIUS"]):
                require(r in radius[p], "a radius")

    def placed(elements):
        return {tuple(float32_row(artifact.points[v]) for v in element) for element in elements}

    dots = artifact.dots
    if artifact.type == "PoleSet":  # the outer ones, often far away, are hidden
        dots = [i for i in dots if artifact.point_codes[1][i] != 2]
    if artifact.type in ("Balls", "Growth") and len(artifact.points) <= MOST_BALL_NODES:
        same(balls, artifact.balls(), "balls")
        dots = []
    triangles = fans(artifact.faces)
    for width, expected in ((1, [(v,) for v in dots]), (2, artifact.edges), (3, triangles)):
        same(count[width], len(expected), f"number of elements of {width} points")
        same(found[width], placed(expected), f"elements of {width} points")


def check_json(data, artifact):
    same(json.loads(data)["type"], artifact.type, "type")


def check_scp(data, artifact):
    numbers = list(map(int, data.split()))
    columns, sets = numbers[:2]
    same((sets, columns), (len(artifact.arrays["row_ids"]), len(artifact.arrays["column_ids"])), "size")


def check_lp(data, artifact):
    constraints = re.findall(rb"^ *s\d+: ", data, re.MULTILINE)
    same(len(constraints), len(artifact.arrays["column_ids"]), "constraints")


def main(folder):
    failed = False
    for source in sorted(pathlib.Path(folder).glob("*.safetensors")):
        artifact = Artifact(source)
        for path in sorted(source.parent.glob(source.stem + ".*")):
            if path == source:
                continue
            kind = path.suffix[1:]
            try:
                globals()["check_" + kind](path.read_bytes(), artifact)
                print("equal", artifact.type, kind)
            except Exception as error:  # every way of being wrong is a difference
                failed = True
                print("DIFFERENT", path.name, artifact.type, kind, type(error).__name__, error)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

"""Binary glTF."""

import json
import math
import re
import struct

from exports.artifact import fans, float32, float32_row, require, rows, same

MOST_BALL_NODES = 20000


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
            if artifact.type == "Ellipsoids":
                x, y, z, w = child["rotation"]
                balls.append((*child["translation"], *child["scale"], w, x, y, z))
                continue
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
    if artifact.type == "Ellipsoids":
        same(balls, artifact.table()[1], "ellipsoids")
        dots = []
    triangles = fans(artifact.faces)
    for width, expected in ((1, [(v,) for v in dots]), (2, artifact.edges), (3, triangles)):
        same(count[width], len(expected), f"number of elements of {width} points")
        same(found[width], placed(expected), f"elements of {width} points")

"""GeoJSON, WKT, poly2d and SVG."""

import json
import math
import xml.etree.ElementTree as ElementTree

from exports.artifact import floats, require, same


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

"""PLY, OBJ, OFF, STL, VTP and MA."""

import struct
import xml.etree.ElementTree as ElementTree

from exports.artifact import fans, float32_row, floats, require, rows, same


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
    if artifact.type == "Ellipsoids":
        corners = [[elements["v"][int(v) - 1] for v in face] for face in elements["f"]]
        return artifact.check_surfaces(corners, 1e-9)
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
    require(not data.startswith(b"solid"), "looks like an ASCII file")
    if artifact.type == "Ellipsoids":
        found = [rows(struct.unpack_from("<12fH", data, 84 + 50 * i)[3:12], 3) for i in range((len(data) - 84) // 50)]
        thin = min(min(r) for r in artifact.arrays["radii"])
        return artifact.check_surfaces(found, 1e-6 * max(max(map(abs, p)) for p in artifact.points) / thin + 1e-6)
    triangles = fans(artifact.faces)
    same(len(data), 84 + 50 * len(triangles), "bytes")
    same(struct.unpack_from("<I", data, 80)[0], len(triangles), "count")
    for i, triangle in enumerate(triangles):
        values = struct.unpack_from("<12fH", data, 84 + 50 * i)
        same(rows(values[3:12], 3), [float32_row(artifact.points[v]) for v in triangle], f"triangle {i}")


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
    for name, values in artifact.columns:
        expected["PointData", name] = values
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

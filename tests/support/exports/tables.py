"""CSV, XYZ, NPY, and what the covering problems are written as."""

import csv
import json
import re
import struct

from exports.artifact import floats, require, rows, same


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
    if artifact.type == "BallDistance":
        same(lines[0], "ball_a,ball_b,separation,ax,ay,az,bx,by,bz", "names")
        return same([tuple(map(float, line.split(","))) for line in lines[1:]], artifact.pair_rows, "pairs")
    if artifact.type == "ShapePrior":
        modes = len(artifact.score_rows[0]) - 2
        same(lines[0].split(","), ["instance", "distance"] + [f"mode_{i}" for i in range(modes)], "names")
        return same([tuple(map(float, line.split(","))) for line in lines[1:]], artifact.score_rows, "rows")
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
    found = re.fullmatch(r"\{'descr': '<f8', 'fortran_order': False, 'shape': \((\d+), (\d+)\), \} *\n", header)
    require(found, header)
    expected = artifact.balls() if artifact.radii is not None else artifact.points
    width = 4 if artifact.radii is not None else 3
    if artifact.columns:
        expected, width = artifact.table()[1], 3 + len(artifact.columns)
    same((int(found[1]), int(found[2])), (len(expected), width), "shape")
    values = struct.unpack(f"<{len(expected) * width}d", data[10 + size:])
    same(rows(values, width), expected, "values")


def check_json(data, artifact):
    same(json.loads(data)["type"], artifact.type, "type")


def check_scp(data, artifact):
    numbers = list(map(int, data.split()))
    columns, sets = numbers[:2]
    same((sets, columns), (len(artifact.arrays["row_ids"]), len(artifact.arrays["column_ids"])), "size")


def check_lp(data, artifact):
    constraints = re.findall(rb"^ *s\d+: ", data, re.MULTILINE)
    same(len(constraints), len(artifact.arrays["column_ids"]), "constraints")

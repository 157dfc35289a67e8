#!/usr/bin/env python3
"""Checks that includes run downwards, and draws the floors.

usage: tools/floors.py [--fix]
Reads cmake/floors.txt, which says what every folder may include, and all #include lines of engine, nodes and tools.
Fails on an include that runs upwards or sideways, on a folder that no floor has, on a table with a cycle, on a source
file over 450 lines, and when the picture in ARCHITECTURE.md is not that of the table. --fix draws it.
"""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "cmake" / "floors.txt"
PICTURE = ROOT / "ARCHITECTURE.md"
BEGIN, END = "<!-- floors: begin -->", "<!-- floors: end -->"
# Where the folders of an area are, and the part of a path that an include begins with.
AREAS = {"engine": ROOT / "engine" / "src", "nodes": ROOT / "nodes", "tools": ROOT / "tools" / "ballflow"}
PUBLIC = ROOT / "engine" / "include" / "ballflow"
MOST_LINES = 450
SOURCES = (".cpp", ".hpp", ".h", ".py", ".js", ".mjs")
# Besides *.node.cpp and *.type.cpp: what connects a family of nodes with the engine.
SEES_SDK = ("plugin.cpp", "artifact_types.hpp", "box_summary.hpp", "type_of.hpp")


def read_table():
    """floor -> floors it names; header of the engine -> floor."""
    sees, headers = {}, {}
    for line in TABLE.read_text().splitlines():
        match = re.match(r"([a-z_/]+):([^#]*)(?:#(.*))?$", line)
        if not match:
            continue
        floor, seen, note = match.groups()
        sees[floor] = seen.split()
        for name in re.findall(r"\[([^]]*)\]", note or ""):
            headers.update({header: floor for header in name.split()})
    return sees, headers


def closure(sees):
    """floor -> every floor below it, itself included. Fails on a cycle and on a name that is no floor."""
    below = {}

    def visit(floor, path):
        if floor in path:
            sys.exit("cmake/floors.txt has a cycle: " + " -> ".join([*path, floor]))
        if floor not in sees:
            sys.exit(f"cmake/floors.txt: {path[-1]} names {floor}, which has no line")
        if floor not in below:
            below[floor] = {floor}.union(*(visit(seen, [*path, floor]) for seen in sees[floor]))
        return below[floor]

    for floor in sees:
        visit(floor, [])
    return below


def sources():
    for area, folder in AREAS.items():
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".cpp", ".hpp", ".h") and "node_modules" not in path.parts:
                yield area, path
    for path in sorted(PUBLIC.rglob("*.h*")):
        yield "engine", path


def floor_of_header(parts, headers):
    """Of ballflow/<parts>: by its name, or by its folder, which the table names with a slash."""
    return headers.get(parts[0] if len(parts) == 1 else parts[0] + "/")


def floor_of_path(area, path, sees, headers):
    if PUBLIC in path.parents:
        return floor_of_header(path.relative_to(PUBLIC).parts, headers)
    parts = path.relative_to(AREAS[area]).parts[:-1]
    for length in range(len(parts), 0, -1):
        floor = "/".join((area, *parts[:length]))
        if floor in sees:
            return floor
    return None


def floor_of_include(area, name, sees, headers):
    """None for what is not the project's."""
    parts = name.split("/")
    if parts[0] == "ballflow":
        return floor_of_header(parts[1:], headers) or "no floor"
    for where in (area, "nodes"):
        for length in range(len(parts) - 1, 0, -1):
            floor = "/".join((where, *parts[:length]))
            if floor in sees:
                return floor
    return None


def is_adapter(path):
    """What connects a family with the engine sees the SDK too."""
    return path.name.endswith((".node.cpp", ".type.cpp")) or path.name in SEES_SDK


def findings(sees, headers, below):
    for area, path in sources():
        shown = path.relative_to(ROOT)
        if path == AREAS["tools"] / "main.cpp":
            continue
        floor = floor_of_path(area, path, sees, headers)
        if floor is None:
            yield f"{shown}: cmake/floors.txt has no line for its folder"
            continue
        lines = path.read_text().splitlines()
        allowed = below[floor] | ({"engine/sdk"} if is_adapter(path) else set())
        for number, line in enumerate(lines, 1):
            match = re.match(r'\s*#include ["<]([^">]+)[">]', line)
            target = match and floor_of_include(area, match[1], sees, headers)
            if target and target not in allowed:
                yield f"{shown}:{number}: {floor} does not see {target} ({match[1]})"


def is_source(path):
    """Of any language; programs without a suffix begin with #!."""
    if path.suffix in SOURCES:
        return True
    return not path.suffix and path.is_file() and path.read_bytes()[:2] == b"#!"


def long_files():
    for top in ("engine", "nodes", "tools", "tests"):
        for folder, folders, names in os.walk(ROOT / top):
            folders[:] = sorted(name for name in folders if name not in ("node_modules", "__pycache__", "dist"))
            for path in (pathlib.Path(folder, name) for name in sorted(names)):
                lines = path.read_text().count("\n") if is_source(path) else 0
                if lines > MOST_LINES:
                    shown = path.relative_to(ROOT)
                    yield f"{shown}: {lines} lines; more than {MOST_LINES} have several subjects, split them"


def picture(sees):
    lines = ["```mermaid", "flowchart TB"]
    for area in AREAS:
        lines.append(f"  subgraph {area}")
        for floor in sees:
            if floor.startswith(area + "/"):
                lines.append(f'    {floor.replace("/", "_")}["{floor.split("/", 1)[1]}"]')
        lines.append("  end")
    for floor, seen in sees.items():
        for other in seen:
            lines.append(f'  {floor.replace("/", "_")} --> {other.replace("/", "_")}')
    return "\n".join([*lines, "```"])


def main():
    if sys.argv[1:] not in ([], ["--fix"]):
        sys.exit(__doc__)
    sees, headers = read_table()
    found = [*findings(sees, headers, closure(sees)), *long_files()]
    text = PICTURE.read_text()
    if BEGIN not in text:
        sys.exit(f"ARCHITECTURE.md: the line {BEGIN} is missing, after which the picture is drawn")
    head, _, rest = text.partition(BEGIN)
    old, _, tail = rest.partition(END)
    drawn = f"\n{picture(sees)}\n"
    if sys.argv[1:] == ["--fix"]:
        PICTURE.write_text(head + BEGIN + drawn + END + tail)
    elif old != drawn:
        found.append('ARCHITECTURE.md: the picture is not that of cmake/floors.txt; "tools/floors.py --fix" draws it')
    for finding in found:
        print(finding)
    if found:
        print(f"{len(found)} findings; cmake/floors.txt says who may include whom", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

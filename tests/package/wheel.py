#!/usr/bin/env python3
"""wheel.py SOURCE BUILD WORK [--all]: packs the wheel from what the build folder has, installs it into an
environment of its own without an index, and uses it in an empty folder with an empty environment. WORK is
made anew. --all: all graphs and not only those that are quick. Exit code 77: what packing or installing needs
is not here."""

from __future__ import annotations

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path
from typing import Optional

LIMIT = 60 * 1000 * 1000  # bytes of the wheel
# Runtimes that every Linux with Python has; anything else has to come from the wheel.
SYSTEM = {
    "linux-vdso",
    "ld-linux-x86-64",
    "libc",
    "libm",
    "libdl",
    "librt",
    "libpthread",
    "libresolv",
    "libgcc_s",
    "libstdc++",
}
# Half a second and more each; the nodes in them are in quicker ones, too.
SLOW = {
    "ball_mesh",
    "compare",
    "configuration_space",
    "difference",
    "distance",
    "enclose",
    "enclose_scene",
    "measure",
    "minkowski_sum",
    "offset",
    "robot_spheres",
    "shape_match",
    "sweep_along_path",
    "experiments/epsilon_by_strategy",
    "experiments/table_3_3",
    "experiments/table_5_2",
}
# Models small enough for everything to be quick; what graphs need besides.
SETTINGS: dict[str, dict[str, object]] = {
    "ellipsoids": {"spacing": 5, "delta": 2},
    "k_ellipsoids": {"spacing": 5, "delta": 2},
    "robot_spheres": {"curves.fits": "2,4"},
    "shape_prior": {"points": 1000, "samples": 300},
    "shape_complete": {
        "input": "shape:bumpBox?n=1500&r=0.65",
        "extent": "whole",
        "samples": 300,
        "model.points": 1000,
    },
    "shape_fit": {
        "input": "shape:bumpBox?n=1500&r=0.65",
        "extent": "whole",
        "samples": 300,
        "prior": "prior/prior.safetensors",
    },
    "shape_instance": {"prior": "prior/prior.safetensors"},
}

NODE = '''
import ballflow as bf


@bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
def Twice(balls, factor: float = 2.0):
    """Larger balls."""
    return bf.Balls(balls.centers, balls.radii * factor)
'''
NODE_GRAPH = """{
  "nodes": {
    "balls": { "type": "LoadBalls", "params": { "file": "balls.csv" } },
    "twice": { "type": "Twice", "inputs": { "balls": "balls.balls" } }
  },
  "outputs": { "balls": "twice.balls" }
}"""

# Runs in the environment: the graphs again, from Python. What the program left in the cache has to be found,
# so keys and digests are the same.
FROM_PYTHON = """
import ctypes, json, re, sys, warnings
import ballflow as bf

warnings.simplefilter("ignore")
assert bf.__file__.startswith(sys.prefix), bf.__file__
for name, settings in json.load(open("graphs.json")).items():
    report = json.load(open(f"reports/{name.replace('/', '-')}.json"))
    if name.startswith("experiments/"):
        result = bf.sweep(name, settings)
        statuses = {node["status"] for node in report["nodes"].values()}
        assert "failed" not in statuses, name
        continue
    run = bf.run(name, settings)
    digests = {output: artifact.digest for output, artifact in run.outputs.items()}
    assert digests == {output: entry["digest"] for output, entry in report["outputs"].items()}, name
    assert {node.status for node in run.nodes.values()} <= {"hit", "skipped"}, (name, run)

import my_nodes
balls = bf.Balls([[0, 0, 0]], [1.5])
assert bf.geometry.enlarge is not None
assert my_nodes.Twice(balls).radii[0] == 3.0

ctypes.CDLL(bf.__file__.replace("__init__.py", "lib/libembree3.so.3"))
files = {line.split()[-1] for line in open("/proc/self/maps") if "/" in line}
pools = {file for file in files if re.search(r"libtbb[-.]", file)}
assert len(pools) == 1 and "/site-packages/ballflow/lib/" in pools.pop(), pools
print("all the same from Python")
"""


def skip(reason: str) -> None:
    print(f"SKIPPED: {reason}")
    sys.exit(77)


def run(command: list[str], env: Optional[dict[str, str]] = None, cwd: Optional[Path] = None) -> str:
    done = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=env, cwd=cwd
    )
    if done.returncode != 0:
        sys.exit(f"FAILED: {' '.join(command)}\n{done.stdout}")
    return done.stdout


def check_wheel(wheel: Path, source: Path, build: Path) -> None:
    size = wheel.stat().st_size
    print(f"{wheel.name}: {size} bytes")
    assert size <= LIMIT, f"the wheel has {size} bytes"
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        for wanted in (
            "ballflow/__init__.py",
            "ballflow/py.typed",
            "ballflow/bin/ballflow",
            "ballflow/lib/ballflow/cover.so",
            "ballflow/lib/libembree3.so.3",
            "ballflow/lib/libcurl.so.4",
            "ballflow/share/ballflow/graphs/medial_axis.json",
            "ballflow/share/ballflow/schemas/graph.schema.json",
        ):
            assert wanted in names, f"the wheel lacks {wanted}"
        assert not [name for name in names if "__pycache__" in name or name.endswith((".a", ".hpp"))]
        if (build / "share/ballflow/viewer.html").exists():
            assert "ballflow/share/ballflow/viewer.html" in names, "the wheel lacks the viewer"
        for library in (
            "libtbb",
            "libgmp",
            "libmpfr",
            "libCbc",
            "libassimp",
            "libcrypto",
            "libzstd",
            "libtinyxml2",
        ):
            copies = [
                name
                for name in names
                if re.fullmatch(rf"ballflow/lib/{library}-[0-9a-f]{{8}}\.so\.[0-9.]+", name)
            ]
            assert len(copies) == 1, f"{library}: {copies}"
        for name in names:
            content = archive.read(name)
            for trace in (f"{source}/", f"{build}/"):
                assert (
                    trace.encode() not in content
                ), f"{name} names a folder of the machine that built it, {trace}"


def check_libraries(package: Path, glibc: tuple[int, int]) -> None:
    """Libraries come from the wheel or are the system's, and no file needs a newer glibc than the tag."""
    files = [path for path in package.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]
    assert len(files) > 40, files
    for path in files:
        for line in run(["ldd", str(path)], env={}).splitlines():
            assert "not found" not in line and "Inconsistency" not in line, f"{path}: {line}"
            name = line.split()[0].rsplit("/", 1)[-1].split(".so")[0]
            assert name in SYSTEM or str(package) in line, f"{path} takes a library of the machine: {line}"
        asked = re.findall(r"GLIBC_(\d+)\.(\d+)", run(["readelf", "--version-info", "--wide", str(path)]))
        newest = max((int(major), int(minor)) for major, minor in asked)
        assert newest <= glibc, f"{path} needs glibc {newest}"


def main() -> None:
    source, build, work = (Path(argument).resolve() for argument in sys.argv[1:4])
    everything = "--all" in sys.argv[4:]
    for program in ("patchelf", "strip", "readelf"):
        if not shutil.which(program):
            skip(f"{program} is not here (Debian packages patchelf, binutils)")
    for module in ("ensurepip", "numpy"):
        if importlib.util.find_spec(module) is None:
            skip(f"{sys.executable} has no {module} (Debian packages python3-venv, python3-numpy)")
    if not list((build / "python/ballflow").glob(f"_core{sysconfig.get_config_var('EXT_SUFFIX')}")):
        skip("the extension was not built for this Python: it needs python3-dev and pybind11-dev")
    shutil.rmtree(work, ignore_errors=True)
    folder = work / "empty"
    folder.mkdir(parents=True)

    print("== pack")
    run(
        [sys.executable, "-B", str(source / "tools/python/wheel/backend.py"), str(work)],
        env={**os.environ, "BALLFLOW_BUILD": str(build)},
    )
    (wheel,) = work.glob("*.whl")
    check_wheel(wheel, source, build)

    print("== install without an index; numpy is Debian's")
    run([sys.executable, "-m", "venv", "--system-site-packages", str(work / "venv")])
    there = {
        "PATH": f"{work}/venv/bin:/usr/bin:/bin",
        "HOME": str(work / "home"),
        "BALLFLOW_CACHE": str(work / "cache"),
    }
    run(["pip", "install", "--no-index", "--no-compile", "--quiet", str(wheel)], env=there, cwd=folder)
    package = work / f"venv/lib/python{sysconfig.get_python_version()}/site-packages/ballflow"
    major, minor = re.search(r"manylinux_(\d+)_(\d+)_", wheel.name).groups()  # type: ignore[union-attr]
    check_libraries(package, (int(major), int(minor)))

    print("== graphs, by the program")
    loaded = run(["ballflow", "version"], env=there, cwd=folder)
    assert loaded.count(f"{package}/lib/ballflow/") == len(
        list((package / "lib/ballflow").glob("*.so"))
    ), loaded
    (folder / "reports").mkdir()
    graphs = {}
    listed = json.loads(run(["ballflow", "graph", "--list", "--json"], env=there, cwd=folder))
    # The model of shapes that others take is made first.
    for graph in sorted(listed, key=lambda graph: str(graph["name"]) != "shape_prior"):
        name = graph["name"]
        if name in SLOW and not everything:
            continue
        takes_input = re.search(r'"input": +\{ "kind": "file"', Path(graph["file"]).read_text())
        settings: dict[str, object] = {"input": "shape:torus?n=600"} if takes_input else {}
        settings.update(SETTINGS.get(name, {}))
        command = ["ballflow", "run", name, "--quiet", "--report", f"reports/{name.replace('/', '-')}.json"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        if name == "shape_prior":
            command += ["--out", "prior", "--format", "prior=safetensors"]
        run(command, env=there, cwd=folder)
        graphs[name] = settings
    assert len(graphs) >= (len(listed) if everything else 40), f"only {len(graphs)} graphs"
    run(
        ["ballflow", "render", "shape:torus?n=600", "--size", "64x64", "-o", "picture.png"],
        env=there,
        cwd=folder,
    )
    if (package / "share/ballflow/viewer.html").exists():
        run(["ballflow", "view", "latest"], env=there, cwd=folder)

    print("== a node in Python, by the program")
    (folder / "my_nodes.py").write_text(NODE)
    (folder / "graph.json").write_text(NODE_GRAPH)
    (folder / "balls.csv").write_text("x,y,z,r\n0,0,0,1\n2,0,0,1\n")
    run(
        ["ballflow", "--plugin", "my_nodes.py", "run", "graph.json", "--out", "out", "--format", "balls=csv"],
        env=there,
        cwd=folder,
    )
    radii = [line.split(",")[3] for line in (folder / "out/balls.csv").read_text().splitlines()[1:]]
    assert [float(radius) for radius in radii] == [2, 2], radii

    print("== the same from Python")
    (folder / "graphs.json").write_text(json.dumps(graphs))
    (folder / "from_python.py").write_text(FROM_PYTHON)
    print(run(["python", "from_python.py"], env=there, cwd=folder), end="")
    print(f"{len(graphs)} of {len(listed)} graphs")


main()

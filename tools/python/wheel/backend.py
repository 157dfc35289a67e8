"""Makes the wheel: what pip calls for a checkout (PEP 517), and `tools/package wheel`.

A backend of our own, since what is in the wheel is made by CMake and changed by patchelf: setuptools would
pack it with four commands replaced and leave folders in the checkout, scikit-build-core is not in Debian, and
both would have to be downloaded before anything begins.

The tree that is packed is build/wheel, configured and built here for the Python that runs this;
$BALLFLOW_BUILD names another one, which is taken as it is.

    ballflow/                   the Python files, and the extension _core
    ballflow/bin/ballflow       the program, which the script "ballflow" of the environment becomes
    ballflow/lib/ballflow/*.so  node libraries
    ballflow/lib/*.so.*         shared libraries that not every Linux has; see bundle.py
    ballflow/share/ballflow/    graphs, schemas, the page of `ballflow view`
"""

from __future__ import annotations

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path
from typing import Any, Iterator, Mapping, Optional

import bundle

SOURCE = Path(__file__).resolve().parents[3]
Settings = Optional[Mapping[str, Any]]

# "#!python" becomes the interpreter of the environment. The package is found without importing it, which
# takes longer than many a command.
SCRIPT = """#!python
import importlib.util
import os
import sys

spec = importlib.util.find_spec("ballflow")
if spec is None or spec.origin is None:
    sys.exit("ballflow: the package is not in this environment; install it again")
program = os.path.join(os.path.dirname(spec.origin), "bin", "ballflow")
os.execv(program, sys.argv[:1] + sys.argv[1:])
"""

DESCRIPTION = """\
Pipelines of typed nodes that compute with unions of balls: polar balls of a scan, a small set of them with a
proven bound, stable medial axes, Minkowski sums, closed surfaces, collision spheres of robots. Intermediate
results are cached by their content.

    import ballflow as bf
    run = bf.run("medial_axis", input="scan.ply", epsilon=0.3)
    run.balls.centers, run.balls.radii

The command line is in the wheel, too: `ballflow run medial_axis --set input=scan.ply --out out`.
"""


def version() -> str:
    text = (SOURCE / "CMakeLists.txt").read_text()
    found = re.search(r"project\(ballflow VERSION ([0-9.]+)", text)
    assert found is not None, "CMakeLists.txt names no version"
    return found.group(1)


def metadata() -> str:
    return (
        f"Metadata-Version: 2.1\nName: ballflow\nVersion: {version()}\n"
        "Summary: Dataflow engine for unions of balls: medial axes, covers, sums, collision spheres\n"
        "License: GPL-3.0-or-later\n"
        "Classifier: License :: OSI Approved :: GNU General Public License v3 or later (GPLv3+)\n"
        "Classifier: Operating System :: POSIX :: Linux\n"
        "Classifier: Programming Language :: C++\n"
        "Classifier: Topic :: Scientific/Engineering\n"
        f"Requires-Python: =={sys.version_info.major}.{sys.version_info.minor}.*\n"
        "Requires-Dist: numpy>=1.20\nDescription-Content-Type: text/plain\n\n" + DESCRIPTION
    )


def tag() -> str:
    """One Python, since the extension is made for one; the glibc of this machine, or a newer one."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    machine = sysconfig.get_platform().rsplit("-", 1)[-1]
    major, minor = os.confstr("CS_GNU_LIBC_VERSION").split()[1].split(".")[:2]  # type: ignore[union-attr]
    return f"{python}-{python}-manylinux_{major}_{minor}_{machine}"


def built_tree() -> Path:
    """The tree that is packed."""
    given = os.environ.get("BALLFLOW_BUILD")
    if given:
        return Path(given).resolve()
    tree = SOURCE / "build" / "wheel"
    configure = [
        "cmake",
        "--preset",
        "release",
        "-S",
        str(SOURCE),
        "-B",
        str(tree),
        "-DCMAKE_UNITY_BUILD=ON",
        "-DBALLFLOW_TESTS=OFF",
        f"-DPython3_EXECUTABLE={sys.executable}",
    ]
    try:
        import pybind11  # from the isolated environment of pip, where Debian has none

        configure.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
    except ImportError:
        pass
    subprocess.run(configure, check=True, cwd=SOURCE)
    subprocess.run(
        ["cmake", "--build", str(tree), "--target", "ballflow_programs", "ballflow_python"], check=True
    )
    return tree


def stage(tree: Path, folder: Path) -> None:
    """Puts the package together in `folder`, all but the libraries that come with it."""
    extensions = list((tree / "python" / "ballflow").glob(f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"))
    if len(extensions) != 1:
        sys.exit(
            f"{tree} has no extension for Python {sysconfig.get_python_version()}: build the target "
            "ballflow_python (Python's headers and pybind11: python3-dev, pybind11-dev)"
        )
    package = folder / "ballflow"
    shutil.copytree(
        SOURCE / "tools" / "python" / "ballflow", package, ignore=shutil.ignore_patterns("__pycache__")
    )
    shutil.copy2(extensions[0], package)
    with tempfile.TemporaryDirectory() as prefix:
        subprocess.run(
            ["cmake", "--install", str(tree), "--prefix", prefix, "--strip"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        for part in ("bin", "lib/ballflow", "share/ballflow"):
            shutil.copytree(Path(prefix, part), package / part)
    # Beside them, `cmake --install` has headers and static libraries for who compiles; those are in the
    # Debian package.
    shutil.rmtree(package / "share" / "ballflow" / "python", ignore_errors=True)
    subprocess.run(["strip", str(package / extensions[0].name)], check=True)


def write(folder: Path, wheel: Path) -> None:
    """A wheel is an archive with a list of its files. Equal folders give equal bytes."""
    epoch = (1980, 1, 1, 0, 0, 0)
    info = f"ballflow-{version()}.dist-info"
    record = ""

    def entries() -> Iterator[Path]:
        # By the format the list is last, and what describes the wheel physically near the end.
        files = (path for path in folder.rglob("*") if path.is_file())
        yield from sorted(files, key=lambda path: (info in path.parts, path.as_posix()))

    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:

        def add(name: str, content: bytes, mode: int) -> None:
            entry = zipfile.ZipInfo(name, epoch)
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)

        for path in entries():
            content = path.read_bytes()
            name = path.relative_to(folder).as_posix()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
            add(name, content, 0o755 if os.access(path, os.X_OK) else 0o644)
        add(f"{info}/RECORD", (record + f"{info}/RECORD,,\n").encode(), 0o644)


def write_info(folder: Path) -> Path:
    info = folder / f"ballflow-{version()}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(metadata())
    (info / "WHEEL").write_text(
        f"Wheel-Version: 1.0\nGenerator: ballflow\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    )
    shutil.copy(SOURCE / "LICENSE", info)
    return info


# What pip calls.


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    needed = []
    if shutil.which("patchelf") is None:
        needed.append("patchelf")
    if not Path("/usr/include/pybind11/pybind11.h").exists():
        needed.append("pybind11>=2.10")
    return needed


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    return write_info(Path(metadata_directory)).name


def build_wheel(
    wheel_directory: str, config_settings: Settings = None, metadata_directory: Optional[str] = None
) -> str:
    tree = built_tree()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        stage(tree, folder)
        info = write_info(folder)
        bundle.bundle(folder / "ballflow", info / "licenses")
        scripts = folder / f"ballflow-{version()}.data" / "scripts"
        scripts.mkdir(parents=True)
        (scripts / "ballflow").write_text(SCRIPT)
        (scripts / "ballflow").chmod(0o755)
        wheel = f"ballflow-{version()}-{tag()}.whl"
        write(folder, Path(wheel_directory) / wheel)
    return wheel


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    raise NotImplementedError("ballflow has no source distribution: clone the repository, or take the wheel")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: backend.py FOLDER-FOR-THE-WHEEL ($BALLFLOW_BUILD: the tree that is packed as it is)")
    Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
    print(os.path.join(sys.argv[1], build_wheel(sys.argv[1])))

"""Puts the shared libraries that not every Linux has into the package.

auditwheel follows what extensions of Python need. Here the program and the node libraries need as much, and
the program opens node libraries, Embree and libcurl by itself; so every ELF file of the package is looked at,
and these two are named. A library gets a name with a digest of its content, so that nothing else in the
process (another package's TBB, say) can be taken for it, and is found through $ORIGIN. All files name the
same one: there is one libtbb in the process, with one pool of threads.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

# What a Linux has that runs Python: the C and C++ runtimes (PEP 600). Their versions are what the tag says.
EVERYWHERE = re.compile(
    r"(ld-linux.*|libc|libm|libdl|librt|libpthread|libutil|libresolv|libgcc_s|libstdc\+\+)\.so\.\d+"
)
# Opened by name when a picture is drawn or an upstream is on a server, so they keep their names.
OPENED = {"libembree3.so.3": "libembree-dev", "libcurl.so.4": "libcurl4"}


def run(*command: str) -> str:
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def is_elf(path: Path) -> bool:
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def needed(path: Path) -> list[str]:
    return run("patchelf", "--print-needed", str(path)).split()


def found(path: Path) -> dict[str, Path]:
    """Where the loader finds the libraries that `path` needs, and those that these need, by name."""
    places = {}
    for line in run("ldd", str(path)).splitlines():
        match = re.match(r"\s*(\S+) => (\S+)", line)
        if match and match[2] == "not":
            sys.exit(f"{path} needs {match[1]}, which is not on this machine")
        if match:
            places[match[1]] = Path(match[2])
    return places


def opened(name: str) -> Path:
    """Where the loader finds a library that is opened by its name."""
    for line in run("/sbin/ldconfig", "--print-cache").splitlines():
        match = re.match(rf"\s*{re.escape(name)} .* => (\S+)", line)
        if match:
            return Path(match[1])
    sys.exit(f"{name} is not on this machine (Debian package {OPENED[name]})")


def hashed(name: str, path: Path) -> str:
    """libtbb.so.12 -> libtbb-1a2b3c4d.so.12"""
    stem, rest = name.split(".so", 1)
    return f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{rest}"


def copy_licence(library: Path, folder: Path) -> None:
    """The terms of a library, where Debian's packages have them."""
    if shutil.which("dpkg-query") is None:
        return
    path = str(library.resolve())
    # A library of /usr/lib may be recorded as one of /lib, its place before the two became one.
    for recorded in (path, path.removeprefix("/usr")):
        answer = subprocess.run(
            ["dpkg-query", "--search", recorded],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        if answer.returncode == 0:
            package = re.split(r"[:,]", answer.stdout)[0]
            terms = Path("/usr/share/doc", package, "copyright")
            if terms.is_file():
                folder.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(terms, folder / package)
            return


def bundle(package: Path, licences: Path) -> None:
    """Copies libraries into `package`/lib and lets all files of `package` name and find them there; terms of
    the libraries go into `licences`."""
    own = [path for path in sorted(package.rglob("*")) if path.is_file() and is_elf(path)]
    places: dict[str, Path] = {}
    for path in own:
        places.update(found(path))
    for name in OPENED:
        places[name] = opened(name)
        places.update(found(places[name]))
    places = {name: path for name, path in places.items() if not EVERYWHERE.fullmatch(name)}

    folder = package / "lib"
    names = {name: name if name in OPENED else hashed(name, path) for name, path in places.items()}
    copies = []
    for name, path in sorted(places.items()):
        copy = folder / names[name]
        shutil.copyfile(path, copy)
        copy.chmod(0o755)
        copy_licence(path, licences)
        run("patchelf", "--set-soname", names[name], str(copy))
        copies.append(copy)
    for path in own + copies:
        replaced = []
        for name in needed(path):
            if name in names and names[name] != name:
                replaced += ["--replace-needed", name, names[name]]
        # Two calls: in one, patchelf 0.14 mixes up the name and the path.
        if replaced:
            run("patchelf", *replaced, str(path))
        where = os.path.relpath(folder, path.parent)
        run("patchelf", "--set-rpath", "$ORIGIN" if where == "." else f"$ORIGIN/{where}", str(path))

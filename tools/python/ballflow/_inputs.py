"""Arrays and objects of other libraries as values of parameters."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
import weakref
from pathlib import Path
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from ._artifact import Artifact, converted

_POINTS = {"dtype": "f64", "shape": ["n", 3]}
_FACES = {"dtype": "i32", "shape": ["m", 3]}


class Files:
    """Files made of arrays, in a folder of their own that goes with this object."""

    def __init__(self) -> None:
        self._folder: Optional[str] = None
        self._count = 0

    @property
    def used(self) -> bool:
        """Whether there are any."""
        return self._folder is not None

    def path(self, suffix: str) -> str:
        if self._folder is None:
            self._folder = tempfile.mkdtemp(prefix="ballflow-")
            weakref.finalize(self, shutil.rmtree, self._folder, True)
        self._count += 1
        return os.path.join(self._folder, f"input{self._count}{suffix}")


def _is_array_like(value: Any) -> bool:
    if isinstance(value, np.ndarray) or (hasattr(value, "__array__") and not isinstance(value, np.generic)):
        return np.ndim(value) > 0  # also tensors, and tables of pandas
    if isinstance(value, (list, tuple)) and value:
        return any(hasattr(part, "__array__") and np.ndim(part) > 0 for part in value) or (
            isinstance(value[0], (list, tuple)) and bool(value[0]) and not isinstance(value[0][0], str)
        )
    return False


def _parts(value: Any) -> Optional[tuple[Any, Any]]:
    """Vertices, and triangles or None, of what has some; None for anything else."""
    if isinstance(value, Artifact):
        if value.type == "TriangleMesh":
            return value.vertices, value.triangles
        if value.type == "PointSet":
            return value.points, None
        return None
    if hasattr(value, "faces") and hasattr(value, "vertices"):  # trimesh
        return value.vertices, value.faces
    if hasattr(value, "triangles") and hasattr(value, "vertices"):  # Open3D, a mesh
        return value.vertices, value.triangles
    if hasattr(value, "regular_faces") and hasattr(value, "points"):  # PyVista, where all faces are triangles
        if value.n_verts == value.n_cells:  # nothing but points
            return value.points, None
        surface = value if getattr(value, "is_all_triangles", False) else value.triangulate()
        return surface.points, np.asarray(surface.faces).reshape(-1, 4)[:, 1:]
    if hasattr(value, "points") and hasattr(value, "has_normals"):  # Open3D, a cloud
        return value.points, None
    if hasattr(value, "triangle") and hasattr(value, "vertex"):  # Open3D, a mesh of tensors
        return value.vertex.positions.cpu().numpy(), value.triangle.indices.cpu().numpy()
    if hasattr(value, "point") and hasattr(value.point, "positions"):  # Open3D, a cloud of tensors
        return value.point.positions.cpu().numpy(), None
    if hasattr(value, "vertices"):  # trimesh, a cloud
        return value.vertices, None
    if not _is_array_like(value):
        return None
    if isinstance(value, tuple) and len(value) == 2 and np.ndim(value[0]) == 2:
        return value[0], value[1]
    return value, None


def is_geometry(value: Any) -> bool:
    """Whether a value is points, a mesh, or balls, and no number or text."""
    if isinstance(value, Artifact):
        return True
    if isinstance(value, (str, bytes, os.PathLike)):
        return False
    return _parts(value) is not None


def _write_ply(path: str, points: NDArray[Any], faces: Optional[NDArray[Any]]) -> None:
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    header += [f"property double {axis}" for axis in "xyz"]
    if faces is not None:
        header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    header += ["end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode("ascii"))
        points.tofile(file)
        if faces is not None:
            rows = np.empty(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
            rows["count"] = 3
            rows["corners"] = faces
            rows.tofile(file)


def _contiguous(value: Any, declaration: Any, where: str) -> NDArray[Any]:
    """As converted(), without a copy of what is in that form already: it is written to a file at once."""
    if (
        isinstance(value, np.ndarray)
        and value.dtype == np.dtype("<f8")
        and value.ndim == 2
        and value.shape[1] == 3
        and value.flags.c_contiguous
        and not isinstance(value, np.ma.MaskedArray)
        and declaration["dtype"] == "f64"
    ):
        return value
    return converted(value, declaration, where)


def file_of(value: Any, name: str, files: Files) -> str:
    """The path of a file with these points (n x 3), this mesh (points, m x 3 corners) or these balls.

    Raises TypeError or ValueError that names the parameter `name`.
    """
    if isinstance(value, Artifact) and value.type == "Balls":
        path = files.path(".sph")
        rows = np.column_stack([value.centers, value.radii])
        with open(path, "w", encoding="ascii") as file:
            file.write(f"{len(rows)}\n")
            for row in rows.tolist():
                file.write(" ".join(map(repr, row)) + "\n")
        return path
    parts = _parts(value)
    if parts is None:
        raise TypeError(
            f"{name}: {type(value).__name__} is no file, no points, no (points, triangles) and no mesh that is known; "
            "give a path, arrays, or an object of trimesh, Open3D or PyVista"
        )
    points = _contiguous(parts[0], _POINTS, f"{name} (points)")
    if not np.all(np.isfinite(points)):
        row = int(np.argmax(~np.isfinite(points).all(axis=1)))
        raise ValueError(f"{name}: point {row} is {points[row].tolist()}; leave points that are not finite out")
    faces = None if parts[1] is None else converted(parts[1], _FACES, f"{name} (triangles)")
    if faces is not None and faces.size and (int(faces.min()) < 0 or int(faces.max()) >= len(points)):
        bad = int(np.argmax(((faces < 0) | (faces >= len(points))).any(axis=1)))
        raise ValueError(f"{name}: triangle {bad} has corners {faces[bad].tolist()}, there are {len(points)} points")
    path = files.path(".ply")
    _write_ply(path, points, faces)
    return path


def _scalar(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def text_of(value: Any, name: str) -> str:
    """The text that --set would get for a number, a boolean, a text, a path, or a list of these.

    Raises TypeError that names the parameter for anything else.
    """
    value = _scalar(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim == 1):
        return json.dumps([plain(entry, name) for entry in value])
    raise TypeError(f"{name}: a parameter cannot be a {type(value).__name__}")


def plain(value: Any, name: str) -> Any:
    """What JSON has for a number, a boolean, a text or a path; TypeError that names the parameter otherwise."""
    value = _scalar(value)
    if value is None or not isinstance(value, (bool, int, float, str)):
        raise TypeError(f"{name}: an entry of a list cannot be a {type(value).__name__}")
    return value


def paths_of(values: Sequence[Any], name: str, files: Files) -> list[str]:
    """Paths of a list of files, some of which may be given as arrays."""
    return [file_of(value, name, files) if is_geometry(value) else text_of(value, name) for value in values]


__all__ = ["Files", "Path", "file_of", "is_geometry", "paths_of", "plain", "text_of"]

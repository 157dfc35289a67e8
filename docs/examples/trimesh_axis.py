"""A trimesh, its medial axis, and the distance of every vertex to the axis.

usage: trimesh_axis.py [MESH]
"""

from __future__ import annotations

import sys

import numpy as np
import trimesh

import ballflow as bf


def main(path: str) -> None:
    mesh = trimesh.load_mesh(path) if path else trimesh.creation.capsule(height=2.0, radius=0.5)
    run = bf.run("medial_axis", input=mesh, epsilon=0.5, progress=True)
    axis = run.medial_axis
    vertices = np.asarray(mesh.vertices)
    nearest = min(float(np.linalg.norm(vertices - center, axis=1).min()) for center in axis.vertices)
    print(f"{len(axis.vertices)} vertices of the axis, {len(axis.edges)} edges; the nearest is {nearest:.3g} from the mesh")
    print("topology:", run.topology.summary["words"])


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")

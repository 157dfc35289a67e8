"""A cloud of Open3D without normals, and the closed surface through it.

usage: open3d_reconstruct.py [CLOUD]
"""

from __future__ import annotations

import sys

import numpy as np
import open3d

import ballflow as bf


def main(path: str) -> None:
    if path:
        cloud = open3d.io.read_point_cloud(path)
    else:
        cloud = open3d.geometry.TriangleMesh.create_torus().sample_points_poisson_disk(1500)
    run = bf.run("reconstruct", input=cloud, progress=True)
    surface = run.mesh
    mesh = open3d.geometry.TriangleMesh(  # Open3D wants arrays that it may change; those of artifacts are read-only
        open3d.utility.Vector3dVector(np.array(surface.vertices)),
        open3d.utility.Vector3iVector(np.array(surface.triangles)),
    )
    print(f"{len(surface.triangles)} triangles, closed: {mesh.is_watertight()}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")

"""The spheres that enclose a surface, drawn with PyVista.

usage: pyvista_spheres.py [PICTURE.png]
"""

from __future__ import annotations

import sys

import numpy as np
import pyvista

import ballflow as bf


def main(picture: str) -> None:
    surface = pyvista.ParametricTorus(u_res=40, v_res=20).triangulate().clean()
    run = bf.run("enclose", input=surface, balls=24, progress=True)
    balls = run.balls
    print(f"{len(balls)} balls, proven to contain the surface: {run.enclosure.summary.get('words', '')}")
    spheres = pyvista.MultiBlock(
        [pyvista.Sphere(radius=radius, center=center) for center, radius in zip(balls.centers, balls.radii)]
    )
    if picture:
        plotter = pyvista.Plotter(off_screen=True)
        plotter.add_mesh(surface, color="white")
        plotter.add_mesh(spheres.combine(), color="orange", opacity=0.3)
        plotter.screenshot(picture)
    print("largest radius", float(np.max(balls.radii)))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")

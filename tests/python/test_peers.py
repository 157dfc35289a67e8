"""Objects of other libraries as inputs: the same points and triangles as when they are given as arrays."""

from __future__ import annotations

import numpy as np
import pytest

import ballflow as bf


def same_as_arrays(value, *arrays):
    # A mesh of few vertices, taken as it is, costs little.
    given = bf.run("dmt" if len(arrays) == 2 else "dmt_points", input=value)
    plain = bf.run("dmt" if len(arrays) == 2 else "dmt_points", input=arrays if len(arrays) == 2 else arrays[0])
    return given.points == plain.points and given.inner == plain.inner and len(given.inner) > 0


POINTS = np.random.default_rng(4).normal(size=(80, 3))


@pytest.mark.filterwarnings("ignore::ballflow.BallflowWarning")
def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.icosphere(subdivisions=2)
    assert same_as_arrays(mesh, np.asarray(mesh.vertices), np.asarray(mesh.faces))
    assert same_as_arrays(trimesh.PointCloud(POINTS), POINTS)
    assert len(bf.geometry.sample_mesh(mesh)) > 0


@pytest.mark.filterwarnings("ignore::ballflow.BallflowWarning")
def test_pyvista():
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.Sphere(theta_resolution=12, phi_resolution=12)
    assert same_as_arrays(mesh, np.asarray(mesh.points), np.asarray(mesh.faces).reshape(-1, 4)[:, 1:])
    cube = pyvista.Cube().clean()
    whole = cube.triangulate()
    assert same_as_arrays(cube, np.asarray(whole.points), np.asarray(whole.faces).reshape(-1, 4)[:, 1:])
    assert same_as_arrays(pyvista.PolyData(POINTS), POINTS)


@pytest.mark.filterwarnings("ignore::ballflow.BallflowWarning")
def test_open3d():
    open3d = pytest.importorskip("open3d")
    mesh = open3d.geometry.TriangleMesh.create_sphere(resolution=8)
    vertices, triangles = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    assert same_as_arrays(mesh, vertices, triangles)
    assert same_as_arrays(open3d.t.geometry.TriangleMesh.from_legacy(mesh, open3d.core.Dtype.Float64), vertices, triangles)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(POINTS))
    assert same_as_arrays(cloud, POINTS)
    assert same_as_arrays(open3d.t.geometry.PointCloud(POINTS), POINTS)


@pytest.mark.filterwarnings("ignore::ballflow.BallflowWarning")
def test_pandas():
    pandas = pytest.importorskip("pandas")
    assert same_as_arrays(pandas.DataFrame(POINTS, columns=["x", "y", "z"]), POINTS)


@pytest.mark.parametrize("example", ["trimesh_axis", "open3d_reconstruct", "pyvista_spheres"])
def test_examples(example, capsys):
    import runpy
    from pathlib import Path

    pytest.importorskip(example.split("_")[0])
    runpy.run_path(str(Path(__file__).resolve().parents[2] / "docs" / "examples" / f"{example}.py"))["main"]("")
    assert capsys.readouterr().out.strip()

"""Artifacts made in Python: what arrays become, what is refused."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import ballflow as bf

CENTERS = np.array([[0.0, 1, 2], [3, 4, 5], [6, 7, 8]])
RADII = np.array([1.0, 2, 3])


@pytest.mark.parametrize(
    "centers, radii",
    [
        (CENTERS.tolist(), RADII.tolist()),
        (tuple(map(tuple, CENTERS.tolist())), tuple(RADII.tolist())),
        (np.asfortranarray(CENTERS), RADII),
        (CENTERS[::-1][::-1], RADII[::-1][::-1]),
        (np.repeat(CENTERS, 2, axis=0)[::2], np.repeat(RADII, 3)[::3]),
        (CENTERS.astype(">f8"), RADII.astype(">f4")),
        (CENTERS.astype(np.float32), RADII.astype(np.float16)),
        (CENTERS.astype(np.int8), RADII.astype(np.uint64)),
        (CENTERS.astype(object), RADII.astype(object)),
        (np.ma.masked_array(CENTERS), RADII),
        (np.broadcast_to(CENTERS, (3, 3)), RADII),
        (np.column_stack([CENTERS, RADII])[:, :3], np.column_stack([CENTERS, RADII])[:, 3]),
        (np.matrix(CENTERS), RADII),
        (CENTERS.T.copy().T, RADII.view()),
        (CENTERS.astype(np.longdouble), RADII),
    ],
)
def test_whatever_holds_the_numbers_gives_the_same_balls(centers, radii):
    expected = bf.Balls(CENTERS, RADII)
    made = bf.Balls(centers, radii)
    assert made.digest == expected.digest
    assert made.centers.dtype == np.float64 and made.centers.flags.c_contiguous
    assert np.array_equal(made.centers, CENTERS) and np.array_equal(made.radii, RADII)


@pytest.mark.parametrize(
    "arguments, kind, words",
    [
        ((CENTERS[:, :2], RADII), ValueError, "Balls.centers is 3 x 2, must be n x 3"),
        ((CENTERS, RADII[:2]), ValueError, "Balls.radii has length 2"),
        ((CENTERS[0], RADII), ValueError, "must be n x 3"),
        ((CENTERS, [RADII]), ValueError, "Balls.radii is 1 x 3, must be n"),
        ((CENTERS,), TypeError, "needs the array radii"),
        ((), TypeError, "needs the array centers"),
        ((CENTERS, "abc"), TypeError, "real numbers"),
        ((CENTERS, RADII + 1j), TypeError, "complex"),
        ((CENTERS, None), TypeError, "radii"),
        ((CENTERS, [1, 2, {}]), TypeError, "numbers"),
        ((CENTERS, [[1], [2, 3], [4]]), TypeError, "Balls.radii"),
        ((CENTERS, np.array(["1", "2", "3"])), TypeError, "real numbers"),
        ((CENTERS, np.array(["2020-01-01"] * 3, dtype="datetime64[D]")), TypeError, "real numbers"),
        ((CENTERS, np.ma.masked_array(RADII, [0, 1, 0])), ValueError, "masked"),
        ((CENTERS, [1, 2, np.nan]), bf.PluginError, "Balls"),
        ((CENTERS, [1, 2, np.inf]), bf.PluginError, "Balls"),
        ((CENTERS, [1, -2, 1]), bf.PluginError, "Balls"),
        ((CENTERS, RADII, None, None, 5), TypeError, "4 arrays, 5"),
    ],
)
def test_what_are_no_balls_is_refused_by_name(arguments, kind, words):
    with pytest.raises(kind, match=words):
        bf.Balls(*arguments)


def test_names_of_arrays():
    with pytest.raises(TypeError, match="no array 'radius'"):
        bf.Balls(CENTERS, radius=RADII)
    with pytest.raises(TypeError, match="twice"):
        bf.Balls(CENTERS, centers=CENTERS)
    assert bf.Balls(radii=RADII, centers=CENTERS) == bf.Balls(CENTERS, RADII)
    with pytest.raises(AttributeError, match="has no array 'radius'"):
        bf.Balls(CENTERS, RADII).radius
    assert bf.Balls(CENTERS, RADII).defining_samples is None
    with pytest.raises(AttributeError):
        bf.Bals
    with pytest.raises(TypeError, match="has a type"):
        bf.Artifact(CENTERS)


def test_integers_come_through_unchanged_or_not_at_all():
    points = np.zeros((3, 3))
    mesh = bf.TriangleMesh(points, np.array([[0.0, 1.0, 2.0]]))
    assert mesh.triangles.dtype == np.int32 and mesh.triangles.tolist() == [[0, 1, 2]]
    with pytest.raises(ValueError, match="not whole"):
        bf.TriangleMesh(points, [[0, 1, 1.5]])
    with pytest.raises(ValueError, match="not whole"):
        bf.TriangleMesh(points, [[0, 1, np.nan]])
    with pytest.raises(ValueError, match="outside"):
        bf.TriangleMesh(points, [[0, 1, 2**31]])
    with pytest.raises(ValueError, match="outside"):
        bf.TriangleMesh(points, np.array([[0, 1, 2**64 - 1]], dtype=np.uint64))
    with pytest.raises(bf.PluginError, match="TriangleMesh"):
        bf.TriangleMesh(points, [[0, 1, 3]])


def test_nothing_at_all_is_a_set_of_balls():
    for empty in ([], np.zeros((0, 3)), np.zeros((0, 3), dtype=">i2")):
        balls = bf.Balls(empty, [])
        assert len(balls) == 0 and balls.centers.shape == (0, 3) and bool(balls)
        assert balls.summary["count"] == 0
    with pytest.raises(ValueError):
        bf.Balls(np.zeros((0, 4)), [])


def test_an_artifact_does_not_change():
    centers = CENTERS.copy()
    balls = bf.Balls(centers, RADII)
    centers[:] = 9
    assert np.array_equal(balls.centers, CENTERS)
    with pytest.raises(ValueError):
        balls.centers[0, 0] = 1
    with pytest.raises(AttributeError, match="cannot be changed"):
        balls.radii = RADII
    with pytest.raises(AttributeError, match="cannot be changed"):
        del balls.radii
    with pytest.raises(TypeError):
        balls.arrays["radii"] = RADII


def test_it_has_the_summary_that_the_engine_makes():
    balls = bf.Balls(CENTERS, RADII)
    assert balls.summary["count"] == 3 and balls.summary["max_radius"] == 3
    run = bf.run("balls", file="balls:0 1 2 1; 3 4 5 2; 6 7 8 3")
    assert run.balls.summary == balls.summary and run.balls.digest == balls.digest


def test_it_can_be_pickled_and_copied():
    balls = bf.Balls(CENTERS, RADII)
    assert pickle.loads(pickle.dumps(balls)) == balls
    assert copy.deepcopy(balls) == balls and copy.copy(balls) == balls
    assert {balls: 1}[bf.Balls(CENTERS, RADII)] == 1
    assert balls != bf.Balls(CENTERS, RADII + 1) and balls != "balls"


def test_its_class_says_what_it_holds():
    assert "n x 3 f64" in bf.Balls.__doc__ and "model units" in bf.Balls.__doc__
    assert bf.Balls.__name__ == "Balls" and issubclass(bf.Balls, bf.Artifact)
    assert isinstance(bf.Balls(CENTERS, RADII), bf.Balls)
    assert repr(bf.Balls(CENTERS, RADII)) == "<Balls: centers 3 x 3 float64, radii 3 float64>"
    assert "Balls" in dir(bf) and "radii" in dir(bf.Balls(CENTERS, RADII))
    assert bf.Balls(CENTERS, RADII).formats[0] == "ply"

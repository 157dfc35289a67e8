"""A thousand calls with whatever comes: a right result or an exception that names what is wrong, never a crash."""

from __future__ import annotations

import random
import warnings

import numpy as np
import pytest

import ballflow as bf

EXPECTED = (bf.BallflowError, TypeError, ValueError)


def some_array(rng: random.Random):
    """An array of some shape, dtype, order, strides and byte order, with or without what is no number."""
    shape = rng.choice([(0,), (5,), (5, 3), (5, 3), (5, 3), (5, 2), (5, 4), (3, 5), (0, 3), (5, 3, 1), (1, 3), ()])
    dtype = rng.choice(["f8", "f8", "f4", ">f8", ">f4", "f2", "i1", "i8", "u8", ">i4", "?", "c16", "U3", "O", "M8[s]"])
    values = np.random.default_rng(rng.randrange(2**32)).uniform(0, 9, size=shape)
    try:
        array = values.astype(dtype)
    except (TypeError, ValueError):
        array = np.empty(shape, dtype)
    if array.dtype.kind == "f" and array.size and rng.random() < 0.2:
        array = array.copy()
        array.flat[rng.randrange(array.size)] = rng.choice([np.nan, np.inf, -np.inf, -1.0, 1e308 if dtype != "f2" else 1])
    if array.ndim == 2:
        array = rng.choice(
            [lambda a: a, np.asfortranarray, lambda a: a[::-1], lambda a: np.repeat(a, 2, axis=0)[::2], lambda a: a.T]
        )(array)
    elif array.ndim == 1:
        array = rng.choice([lambda a: a, lambda a: a[::-1], lambda a: np.repeat(a, 3)[::3]])(array)
    return array


def something(rng: random.Random):
    return rng.choice(
        [
            lambda: some_array(rng),
            lambda: some_array(rng).tolist(),
            lambda: (some_array(rng), some_array(rng)),
            lambda: rng.choice([None, True, 7, -3, 2**70, 0.5, float("nan"), "text", "", b"bytes", "\x00", "shape:torus"]),
            lambda: rng.choice([[], {}, set(), object(), lambda: 1, range(3), ["a", None], "\ud800"]),
            lambda: bf.Balls([[0, 0, 0], [1, 0, 0]], [1, 1]),
            lambda: bf.PointSet(np.eye(3)),
        ]
    )()


def rows_are_right(made, given, columns):
    """What a float64 array became is what numpy says that it is."""
    return np.array_equal(made, np.asarray(given, dtype=np.float64).reshape((-1, columns) if columns else (-1,)))


def attempt(call):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return call()
    except EXPECTED as problem:
        assert str(problem), "an exception says what is wrong"
        return None


@pytest.mark.parametrize("seed", range(8))
def test_artifacts(seed):
    rng = random.Random(seed)
    right = 0
    for _ in range(100):
        centers, radii = something(rng), something(rng)
        if rng.random() < 0.4:
            centers, radii = some_array(rng), np.arange(5, dtype=rng.choice(["f8", ">f4", "i2", "u1"]))[:: rng.choice([1, -1])]
        made = attempt(lambda: bf.Balls(centers, radii))
        if made is not None:
            right += 1
            assert rows_are_right(made.centers, centers, 3) and rows_are_right(made.radii, radii, 0)
            assert made.summary["count"] == len(made.radii)
    assert right > 0, "some of them are balls"


def test_functions():
    rng = random.Random(100)
    right = 0
    for _ in range(120):
        balls, points, epsilon = something(rng), something(rng), something(rng)
        if rng.random() < 0.5:
            balls, epsilon = (np.random.default_rng(1).random((4, 3)), np.ones(4)), rng.choice([0.5, 1, np.float32(2), "3"])
            points = some_array(rng)
        made = attempt(lambda: bf.geometry.enlarge(balls, points, epsilon=epsilon, mode="additive"))
        right += made is not None
        if made is not None:
            assert np.all(made.balls.radii >= made.growth.radii_before if "radii_before" in made.growth.arrays else True)
    assert right > 0


def test_inputs_and_parameters_of_graphs():
    rng = random.Random(200)
    right = 0
    for _ in range(80):
        name = rng.choice(["file", "file", "file", "epsilon", "\ud800", "load.file", "diagram.tolerance", ""])
        value = something(rng) if rng.random() < 0.8 else "balls:0 0 0 1"
        made = attempt(lambda: bf.run("balls", {name: value}, cache=False))
        right += made is not None
    assert right > 0

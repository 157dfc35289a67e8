"""Nodes as functions, against formulas."""

from __future__ import annotations

import inspect
import math

import numpy as np
import pytest

import ballflow as bf


def test_every_node_is_a_function_that_says_what_it_takes():
    names = dir(bf.geometry)
    assert {"enlarge", "voronoi_poles", "ip_solve", "minkowski_sum"} <= set(names)
    for name in names:
        function = getattr(bf.geometry, name)
        assert function.__doc__ and inspect.signature(function)
    assert len(names) == len(dir(bf.nodes))
    assert "epsilon" in inspect.signature(bf.geometry.enlarge).parameters
    assert "Lemma 3.4" in bf.nodes.Enlarge.__doc__ == bf.geometry.enlarge.__doc__
    with pytest.raises(AttributeError, match="enlarge"):
        bf.geometry.enlarg
    with pytest.raises(AttributeError, match="Enlarge"):
        bf.nodes.Enlarg


def test_the_volume_of_two_balls(balls, tmp_path):
    diagram = bf.geometry.power_diagram(balls)
    measure = bf.geometry.union_measure(complex=bf.geometry.alpha_shape(diagram=diagram), diagram=diagram)
    lens = math.pi * (4 + 1.5) * (2 - 1.5) ** 2 / 12  # of two unit balls 1.5 apart
    assert measure.summary["volume"] == pytest.approx(2 * 4 / 3 * math.pi - lens, rel=1e-12)
    assert not (tmp_path / "cache").exists(), "a function keeps nothing unless asked"


def test_arrays_and_tuples_are_artifacts(balls):
    grown = bf.geometry.enlarge((balls.centers, balls.radii), epsilon=0.5, mode="absolute")
    assert type(grown).__name__ == "EnlargeOutputs"
    assert grown.balls.radii.tolist() == [1.5, 1.5]
    poles = bf.geometry.voronoi_poles(np.random.default_rng(3).normal(size=(50, 3)))
    assert type(poles).__name__ == "PoleSet" and len(poles) > 50


def test_several_artifacts_of_one_port(box):
    vertices, _ = box
    clouds = [np.random.default_rng(seed).random((200, 3)) * vertices[-1] for seed in (1, 2, 3)]
    balls = [([[1, 0.5, 0.5]], [0.5])] * 3
    template = bf.geometry.choose_template(clouds, balls, clouds)
    assert any(np.array_equal(template.samples.points, cloud) for cloud in clouds)
    with pytest.raises(TypeError, match="ChooseTemplate: samples"):
        bf.geometry.choose_template([3], balls, clouds)


def test_a_parameter_with_the_name_of_an_input_has_a_line_behind_it():
    both = [
        (node, param["name"])
        for node in (getattr(bf.nodes, name).declaration for name in dir(bf.nodes))
        for param in node["params"]
        if any(port["name"] == param["name"] for port in node["inputs"])
    ]
    for node, param in both:
        parameters = inspect.signature(getattr(bf.geometry, bf._graph._snake(node["id"]))).parameters
        assert param in parameters and param + "_" in parameters


def test_the_cache_is_used_where_asked(balls, tmp_path):
    first = bf.geometry.enlarge(balls, mode="absolute", epsilon=2, cache=True)
    assert (tmp_path / "cache").exists()
    again = bf.geometry.enlarge(balls, mode="absolute", epsilon=2, cache=True)
    assert first.balls == again.balls
    assert again.balls.digest == first.balls.digest


@pytest.mark.parametrize(
    "call, kind, words",
    [
        (lambda b: bf.geometry.enlarge(), TypeError, "balls"),
        (lambda b: bf.geometry.enlarge(b, fector=2), TypeError, "fector"),
        (lambda b: bf.geometry.enlarge("balls.ply"), TypeError, "Balls"),
        (lambda b: bf.geometry.enlarge((b.centers, b.radii[:1])), ValueError, "Enlarge: balls: Balls.radii"),
        (lambda b: bf.geometry.enlarge(b, epsilon=-1), bf.GraphError, "at least 0"),
        (lambda b: bf.geometry.enlarge(b, mode="additive"), bf.NodeFailed, "points"),
        (lambda b: bf.geometry.enlarge(bf.PointSet(np.eye(3))), bf.GraphError, "Balls"),
    ],
)
def test_mistakes_are_named(call, kind, words, balls):
    with pytest.raises(kind, match=words):
        call(balls)

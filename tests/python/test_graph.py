"""Graphs built in Python are the graphs of the command line."""

from __future__ import annotations

import json

import numpy as np
import pytest

import ballflow as bf


def inner_balls():
    g = bf.Graph(doc="The inner balls of a mesh, grown and counted.")
    epsilon = g.param("epsilon", 0.5, minimum=0, unit="% of the longest bounding-box edge", doc="growth")
    model = g.param("input", "shape:sTube", kind="file", doc="a mesh")
    scan = g.Sample(file=model)
    poles = g.VoronoiPoles(points=scan.points)
    label = g.LabelPoles(poles=poles.poles, mesh=scan.mesh)
    grown = g.Enlarge(name="grow", balls=label.inner, points=scan.points, epsilon=epsilon)
    g.output("balls", grown.balls, "the grown balls")
    g.output("inner", label.inner)
    return g


def test_what_is_built_is_what_the_command_line_runs(program):
    g = inner_balls()
    run = bf.run(g, epsilon=1.0)
    g.save("inner.json")
    program("check", "inner.json")
    program("run", "inner.json", "--set", "epsilon=1", "--cache", "other", "--report", "report.json", "--quiet")
    report = json.load(open("report.json"))
    assert report["nodes"]["grow"]["outputs"]["balls"]["digest"] == run.balls.digest
    assert bf.run("inner.json", epsilon=1.0).balls.digest == run.balls.digest
    assert np.all(run.balls.radii > run.inner.radii)


def test_graphs_that_ship_go_through_unchanged():
    for name in bf.graphs():
        loaded = bf.Graph.load(name)
        again = json.loads(loaded.to_json())
        assert again == loaded.to_dict() and again["nodes"]
    run = bf.run(bf.Graph.load("balls"), file="balls:0 0 0 1")
    assert run.balls == bf.run("balls", file="balls:0 0 0 1").balls


def test_comments_are_left_out_and_texts_are_not(tmp_path):
    (tmp_path / "g.json").write_text(
        '{ // one\n "doc": "a // b /* c */ \\" d", /* two */ "nodes": {"load": {"type": "LoadBalls"}}}'
    )
    assert bf.Graph.load("g.json").to_dict()["doc"] == 'a // b /* c */ " d'


def test_subgraphs_maps_and_what_is_said_as_in_a_file():
    shipped = bf._session.share_folder() / "graphs"
    g = bf.Graph(file=shipped / "mine.json")
    dmt = g.graph("dmt.json", params={"input": "shape:sTube", "sampling": "surface"})
    g.add("count", {"type": "UnionTopology", "inputs": {"diagram": g.PowerDiagram(balls=dmt.inner).diagram},
                    "params": {"stage": "inner"}})
    g.output("inner", dmt.inner)
    assert bf.run(g).inner.summary["count"] > 0


@pytest.mark.parametrize(
    "build, kind, words",
    [
        (lambda g: g.Sampel(), AttributeError, "Sample"),
        (lambda g: g.node("Sampel"), bf.UsageError, "Sample"),
        (lambda g: g.Sample(fill="x"), TypeError, "'fill'"),
        (lambda g: g.Sample().pionts, AttributeError, "points"),
        (lambda g: g.output("x", "sample.points"), TypeError, "output of a node"),
        (lambda g: (g.Sample(name="a"), g.Sample(name="a")), bf.UsageError, "'a' already"),
        (lambda g: (g.param("a", 1), g.param("a", 1)), bf.UsageError, "'a' already"),
        (lambda g: g.param("a"), TypeError, "kind"),
        (lambda g: g.VoronoiPoles(points=bf.Graph().Sample().points), bf.UsageError, "another graph"),
        (lambda g: g.VoronoiPoles(points=bf.PointSet(np.eye(3))), TypeError, "parameter of kind artifact"),
        (lambda g: g.Sample(file=object()), TypeError, "cannot hold"),
    ],
)
def test_mistakes_are_named_where_they_are_made(build, kind, words):
    with pytest.raises(kind, match=words):
        build(bf.Graph())


def test_names_are_the_types_in_small_letters():
    g = bf.Graph()
    first, second = g.VoronoiPoles(), g.VoronoiPoles()
    assert first.poles.text == "voronoi_poles.poles" and second.poles.text == "voronoi_poles2.poles"
    assert g.IPSolve().cover.text == "ip_solve.cover"
    assert repr(g) == "<graph of 3 nodes: voronoi_poles, voronoi_poles2, ip_solve>"


def test_an_artifact_is_a_parameter(balls):
    g = bf.Graph()
    g.output("outer", g.Enlarge(balls=g.param("balls", type="Balls"), mode="absolute", epsilon=0.25).balls)
    assert bf.run(g, balls=balls).outer.radii.tolist() == [1.25, 1.25]
    balls.save("balls.safetensors")
    assert bf.run(g, balls="balls.safetensors").outer.radii.tolist() == [1.25, 1.25]
    with pytest.raises(bf.GraphError):
        bf.run(g, balls=bf.PointSet(np.eye(3)))
    with pytest.raises(TypeError, match="takes an artifact"):
        bf.run(g, balls=3)

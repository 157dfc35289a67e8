"""Nodes that are functions of this process: what they give, when they run again, how they fail and end."""

from __future__ import annotations

import importlib
import os
import sys
import textwrap
from pathlib import Path
from typing import Annotated, Optional

import numpy as np
import pytest

import ballflow as bf
from ballflow import _node


@pytest.fixture(autouse=True)
def no_nodes_of_other_tests():
    before = list(_node._registered)
    yield
    _node._registered[:] = before


def cell(code, scope):
    """Runs it as a cell of a notebook."""
    exec(compile(textwrap.dedent(code), "<cell>", "exec"), scope)


def of_one(node, **values):
    """A graph of one node, with all its outputs."""
    graph = bf.Graph()
    made = getattr(graph, node.id)(name="it", **values)
    for port in node.declaration["outputs"]:
        graph.output(port["name"], getattr(made, port["name"]))
    return graph


def test_a_function_is_a_node_and_stays_a_function():
    @bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
    def Double(balls, factor: float = 2.0):
        "Multiplies every radius."
        return bf.Balls(balls.centers, balls.radii * factor)

    assert np.all(Double(bf.Balls([[0, 0, 0]], [1.0]), factor=3.0).radii == 3)
    assert Double.__doc__ == Double.declaration["summary"] == "Multiplies every radius."
    assert "factor" in bf.nodes.Double.__doc__

    graph = bf.Graph()
    graph.output("balls", graph.Double(balls=graph.LoadBalls(file="balls:0 0 0 1; 3 0 0 2").balls, factor=5).balls)
    run = bf.run(graph)
    assert list(run.balls.radii) == [5, 10] and run.balls.summary["max_radius"] == 10
    assert {node.status for node in bf.run(graph).nodes.values()} == {"hit"}


def test_a_cell_that_changes_what_a_node_calls_runs_it_again():
    scope = {"bf": bf}
    cell("def radius(): return 1.0", scope)
    cell(
        """
        @bf.node
        def One() -> bf.Balls:
            return bf.Balls([[0, 0, 0]], [radius()])
        """,
        scope,
    )
    graph = of_one(scope["One"])
    assert [bf.run(graph)["it"].status for _ in range(2)] == ["run", "hit"]
    cell("def radius(): return 2.0", scope)
    again = bf.run(graph)
    assert again["it"].status == "run" and again.balls.radii[0] == 2


def test_a_module_that_is_reloaded_runs_again(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    module = """
        import ballflow as bf
        def radius(): return {}
        @bf.node
        def Reloaded() -> bf.Balls:
            return bf.Balls([[0, 0, 0]], [radius()])
    """
    file = Path("reloaded_nodes.py")
    file.write_text(textwrap.dedent(module.format(1.0)))
    nodes = importlib.import_module("reloaded_nodes")
    first = nodes.Reloaded.digest
    graph = of_one(nodes.Reloaded)
    assert bf.run(graph).balls.radii[0] == 1
    file.write_text(textwrap.dedent(module.format(20.0)))
    assert nodes.Reloaded.digest == first  # what runs is still what was imported
    assert bf.run(graph)["it"].status == "hit"
    importlib.reload(nodes)
    assert nodes.Reloaded.digest != first
    assert bf.run(graph).balls.radii[0] == 20


def test_exceptions_are_failures_of_the_node():
    @bf.node
    def Fails(count: int = 1) -> bf.Balls:
        raise KeyError("no such thing")

    @bf.node
    def Wrong() -> bf.Balls:
        return 3

    @bf.node
    def Invalid() -> bf.Balls:
        return bf.Balls([[0, 0, 0]], [-1.0])

    with pytest.raises(bf.NodeFailed, match=r"KeyError: 'no such thing' \(test_python_nodes.py:\d+, in Fails\)") as told:
        bf.run(of_one(Fails))
    assert told.value.node == "it"
    with pytest.raises(bf.NodeFailed, match="Wrong returned a int for its output 'balls', must be ballflow.Balls"):
        bf.run(of_one(Wrong))
    with pytest.raises(bf.NodeFailed, match="ball 0 has radius -1"):
        bf.run(of_one(Invalid))


def test_the_context_tells_and_asks():
    @bf.node(seed=True)
    def Talks(ctx: bf.Context, much: Annotated[float, bf.Range(0, 1), "how much"] = 0.5) -> bf.Balls:
        ctx.progress(much)
        ctx.log("a line")
        ctx.warn("careful")
        return bf.Balls([[0, 0, 0]], [ctx.seed + ctx.threads * 0])

    events = []
    with pytest.warns(bf.BallflowWarning, match="careful"):
        run = bf.run(of_one(Talks), seed=7, progress=events.append)
    assert run.balls.radii[0] == 7
    assert {"a line", "careful"} <= {event.get("text") for event in events}
    assert any(event["event"] == "node_progress" and event["fraction"] == 0.5 for event in events)
    with pytest.raises(bf.UsageError, match="at most 1"):
        bf.run(of_one(Talks, much=2.0))


def test_a_cancelled_run_ends_where_progress_is_told():
    @bf.node
    def Endless(ctx: bf.Context) -> bf.Balls:
        while True:
            ctx.progress(0.1)

    with pytest.raises(bf.Cancelled):
        bf.run(of_one(Endless), progress=lambda event: event["event"] != "node_progress")


def test_what_a_function_must_not_say():
    with pytest.raises(TypeError, match=r"node Star \(test_python_nodes.py:\d+\): parameter 'rest' has no name"):

        @bf.node
        def Star(*rest: float) -> bf.Balls: ...

    with pytest.raises(TypeError, match="parameter 'x' is annotated with"):

        @bf.node
        def Odd(x: dict) -> bf.Balls: ...

    with pytest.raises(TypeError, match="output 'balls' is optional or a list"):

        @bf.node
        def Maybe() -> Optional[bf.Balls]: ...

    with pytest.raises(TypeError, match="input 'b' is no parameter of the function"):

        @bf.node(inputs={"b": bf.Balls}, outputs={"balls": bf.Balls})
        def Named(a): ...

    with pytest.raises(TypeError, match="must be an artifact type like ballflow.Balls"):

        @bf.node(inputs={"a": float}, outputs={"balls": bf.Balls})
        def Port(a): ...


def test_a_file_of_nodes_runs_in_processes_of_its_own(tmp_path):
    text = """
        import os
        import ballflow as bf
        @bf.node
        def Elsewhere(here: int) -> bf.Balls:
            assert os.getpid() != here
            return bf.Balls([[0, 0, 0]], [{}])
    """
    file = tmp_path / "elsewhere.py"
    file.write_text(textwrap.dedent(text.format("1.0")))
    Path("graph.json").write_text(
        '{"nodes": {"it": {"type": "Elsewhere", "params": {"here": %d}}}, "outputs": {"balls": "it.balls"}}' % os.getpid()
    )
    assert bf.run("graph.json", plugins=[file]).balls.radii[0] == 1
    file.write_text(textwrap.dedent(text.format("2.25")))
    run = bf.run("graph.json", plugins=[file])
    assert run["it"].status == "run" and run.balls.radii[0] == 2.25

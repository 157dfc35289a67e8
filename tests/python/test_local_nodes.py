"""Functions of this process as nodes, beside the command line and beside each other."""

from __future__ import annotations

import json
import threading
from pathlib import Path

import pytest

import ballflow as bf
from ballflow import _node

SOURCE = '''
import ballflow as bf

def times(radii, factor):
    return radii * factor

@bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
def Scale(balls, factor: float = 2.0):
    """Multiplies every radius."""
    return bf.Balls(balls.centers, times(balls.radii, factor))
'''

GRAPH = {
    "nodes": {
        "load": {"type": "LoadBalls", "params": {"file": "balls:0 0 0 1; 3 0 0 2"}},
        "scale": {"type": "Scale", "inputs": {"balls": "load.balls"}, "params": {"factor": 1.5}},
    },
    "outputs": {"balls": "scale.balls"},
}


@pytest.fixture(autouse=True)
def own_nodes():
    known = list(_node.registered())
    yield
    _node.registered()[:] = known


def from_file(source=SOURCE, name="my_nodes.py"):
    """The module of a file, as `import my_nodes` gives it."""
    import importlib.util
    import sys

    Path(name).write_text(source)
    spec = importlib.util.spec_from_file_location(Path(name).stem, Path(name).resolve())
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def graph():
    Path("graph.json").write_text(json.dumps(GRAPH))
    return "graph.json"


def test_the_command_line_takes_the_results_of_python_and_the_other_way(program):
    from_file()
    run = bf.run(graph())
    assert run["scale"].status == "run" and run.balls.radii.tolist() == [1.5, 3]
    program("--plugin", "my_nodes.py", "run", "graph.json", "--report", "report.json", "--quiet")
    node = json.load(open("report.json"))["nodes"]["scale"]
    assert node["status"] == "hit" and node["outputs"]["balls"]["digest"] == run.balls.digest
    _node.registered().clear()  # what a program sees that has not imported the file
    of_plugin = bf.run("graph.json", plugins=["my_nodes.py"], cache="other")
    assert of_plugin["scale"].status == "run" and of_plugin.balls.digest == run.balls.digest


def test_several_functions_run_side_by_side_with_nodes_of_libraries():
    seen = set()

    @bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
    def Same(balls, number: int = 0):
        """Hands its balls on."""
        seen.add(threading.get_ident())
        return bf.Balls(balls.centers, balls.radii + number)

    g = bf.Graph()
    loaded = g.LoadBalls(file="balls:0 0 0 1; 3 0 0 2")
    for i in range(20):
        grown = g.Enlarge(balls=g.Same(balls=loaded.balls, number=i).balls, mode="absolute", epsilon=1.0)
        g.output(f"balls{i}", grown.balls)
    run = bf.run(g, threads=4)
    for i in range(20):
        assert run.outputs[f"balls{i}"].radii.tolist() == [2 + i, 3 + i]
    assert threading.get_ident() not in seen

"""Graphs of toy nodes (plugin/toy.cpp)."""

from __future__ import annotations

import json
from pathlib import Path


def write_graph(folder: Path, models: int, variants: int, seconds: float, megabytes: float = 0) -> Path:
    """models x (load, variants x (prune, metric), report), and the sum of all."""
    names = [str(i) for i in range(models)]
    inner = {
        "params": {"add": {"kind": "number", "doc": "what is added"}},
        "inputs": {"from": {"type": "toy.Count"}},
        "nodes": {
            "prune": {"type": "toy.Step",
                      "params": {"add": "${add}", "seconds": seconds, "megabytes": megabytes},
                      "inputs": {"from": "inputs.from"}},
            "metric": {"type": "toy.Step", "params": {"seconds": seconds}, "inputs": {"from": "prune.count"}},
        },
        "outputs": {"count": "metric.count"},
    }
    model = {
        "params": {"model": {"kind": "number", "doc": "a number"}},
        "nodes": {
            "load": {"type": "toy.Load", "params": {"model": "${model}"}},
            "variants": {"map": "variant.json", "over": {"add": [str(i) for i in range(variants)]},
                         "inputs": {"from": "load.count"}},
            "report": {"type": "toy.Sum", "inputs": {"counts": "variants.count"}},
        },
        "outputs": {"sum": "report.sum"},
    }
    top = {
        "nodes": {
            "models": {"map": "model.json", "over": {"model": names}},
            "final": {"type": "toy.Sum", "inputs": {"counts": "models.sum"}},
        },
        "outputs": {"sum": "final.sum"},
    }
    folder.mkdir(parents=True, exist_ok=True)
    for name, graph in (("variant", inner), ("model", model), ("graph", top)):
        (folder / f"{name}.json").write_text(json.dumps(graph))
    return folder / "graph.json"


def write_loop(folder: Path, iterations: int, seconds: float) -> Path:
    """Counts to `iterations`, each of which takes so long, and sums that with another number."""
    body = {
        "inputs": {"n": {"type": "toy.Count"}},
        "nodes": {"step": {"type": "toy.Step", "params": {"add": 1, "seconds": seconds},
                           "inputs": {"from": "inputs.n"}}},
        "outputs": {"n": "step.count"},
    }
    top = {
        "nodes": {
            "zero": {"type": "toy.Load", "params": {"model": 0}},
            "one": {"type": "toy.Load", "params": {"model": 1}},
            "loop": {"loop": "body.json", "inputs": {"n": "zero.count"}, "until": f"n.value == {iterations}"},
            "sum": {"type": "toy.Sum", "inputs": {"counts": ["loop.n", "one.count"]}},
        },
        "outputs": {"sum": "sum.sum"},
    }
    folder.mkdir(parents=True, exist_ok=True)
    for name, graph in (("body", body), ("graph", top)):
        (folder / f"{name}.json").write_text(json.dumps(graph))
    return folder / "graph.json"

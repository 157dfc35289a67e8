"""ballflow: unions of balls, medial axes, covers and what is made of them, as graphs of nodes that run in parallel
and keep what they made.

    import ballflow as bf
    run = bf.run("medial_axis", input="scan.ply", epsilon=0.3, progress=True)
    run.balls.centers, run.balls.radii

``run`` and ``sweep`` run graphs, ``Graph`` builds them, ``geometry`` has every node as a function, ``nodes`` says
what they do, ``node`` makes a node of a function. Classes of artifacts (``Balls``, ``TriangleMesh``, ...) are made
from what node libraries declare.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable

from . import _core
from ._artifact import Artifact
from ._errors import (
    BallflowError,
    BallflowWarning,
    Cancelled,
    GraphError,
    NodeFailed,
    PluginError,
    StoreError,
    UsageError,
)

if TYPE_CHECKING:
    from . import geometry, nodes
    from ._graph import Graph
    from ._node import Context, Range, Unit, node
    from ._results import NodeResult, Run
    from ._run import run
    from ._sweep import Sweep, sweep

__version__: str = _core.version

# What is loaded when it is first looked at, so that importing ballflow costs little.
_LAZY = {
    "Context": "_node",
    "Graph": "_graph",
    "NodeResult": "_results",
    "Range": "_node",
    "Run": "_results",
    "Sweep": "_sweep",
    "Unit": "_node",
    "run": "_run",
    "sweep": "_sweep",
    "node": "_node",
}
_MODULES = ("geometry", "nodes")

__all__ = [
    "Artifact",
    "BallflowError",
    "BallflowWarning",
    "Cancelled",
    "Context",
    "Graph",
    "GraphError",
    "NodeFailed",
    "NodeResult",
    "PluginError",
    "Range",
    "Run",
    "StoreError",
    "Sweep",
    "Unit",
    "UsageError",
    "geometry",
    "graphs",
    "load",
    "node",
    "nodes",
    "run",
    "sweep",
]


def graphs() -> dict[str, str]:
    """The graphs that come with ballflow: name and what each is for."""
    from . import _session

    return {name: doc for name, doc, _ in _core.shipped_graphs(_session.graphs_folder())}


def load(path: Any) -> Artifact:
    """Reads an artifact from a safetensors file, as ``Artifact.save`` and the command line write it."""
    import os

    from . import _results, _session

    _session.base_registry()
    return _results.artifact_of(_core.read_artifact(os.fspath(path)))


def __getattr__(name: str) -> Any:
    import importlib

    if name in _LAZY:
        value = getattr(importlib.import_module(f".{_LAZY[name]}", __name__), name)
        globals()[name] = value
        return value
    if name in _MODULES:
        return importlib.import_module(f".{name}", __name__)
    if name.startswith("_"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import _artifact, _session

    _session.base_registry()
    cls = _artifact.class_named(name)
    if cls is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return cls


def __dir__() -> Iterable[str]:
    from . import _artifact, _session

    _session.base_registry()
    return sorted({*globals(), *_LAZY, *_MODULES, *_artifact.class_names()})

"""Every node as a function: ``ballflow.geometry.enlarge(balls, points, epsilon=0.3)``.

Inputs come in the order of the node, then parameters as keywords; ``help(ballflow.geometry.enlarge)`` says what
they are. An input is an artifact, or what its class takes: ``(centers, radii)`` for balls, ``n x 3`` for points.
The result is the artifact, or, of a node with several outputs, a named tuple of them.

A call is a graph of one node. It reads and writes the cache only with ``cache=`` (True: that of the command
line, or a folder).
"""

from __future__ import annotations

import collections
import inspect
from typing import Any, Callable, Iterable, Mapping, Optional

import numpy as np

from . import _artifact, _nodes
from ._artifact import Artifact
from ._graph import Graph, Parameter, _snake
from ._run import run
from ._session import Cache

_functions: dict[str, tuple[Any, Callable[..., Any]]] = {}


def _as_artifact(value: Any, type_name: str, where: str) -> Artifact:
    if isinstance(value, Artifact):
        return value
    cls = _artifact.class_named(type_name)
    if cls is None:
        raise TypeError(f"{where}: the artifact type {type_name} is not declared")
    try:
        if isinstance(value, Mapping):
            return cls(**value)
        if isinstance(value, tuple):
            return cls(*value)
        if isinstance(value, (np.ndarray, list)):
            return cls(value)
        if type_name == "TriangleMesh" and hasattr(value, "vertices") and hasattr(value, "faces"):
            return cls(value.vertices, value.faces)
        if type_name == "TriangleMesh" and hasattr(value, "vertices") and hasattr(value, "triangles"):
            return cls(np.asarray(value.vertices), np.asarray(value.triangles))
        if type_name == "PointSet" and hasattr(value, "points"):
            return cls(np.asarray(value.points))
        if type_name == "PointSet" and hasattr(value, "vertices"):
            return cls(np.asarray(value.vertices))
    except (TypeError, ValueError) as problem:
        raise type(problem)(f"{where}: {problem}") from None
    raise TypeError(f"{where} takes {type_name}, not a {type(value).__name__}")


def _call(declared: Any, inputs: Mapping[str, Any], params: Mapping[str, Any], options: Mapping[str, Any]) -> Any:
    graph = Graph()
    given: dict[str, Any] = {}
    wired: dict[str, Any] = {}
    for port in declared["inputs"]:
        name = port["name"]
        value = inputs.get(name)
        if value is None:
            if port.get("optional") or port.get("list"):
                continue
            raise TypeError(f"{declared['id']} needs the input {name} ({port['type']}: {port.get('doc', '')})")
        values = list(value) if port.get("list") else [value]
        edges: list[Parameter] = []
        for i, one in enumerate(values):
            key = f"in_{name}_{i}"
            given[key] = _as_artifact(one, port["type"], f"{declared['id']}: {name}")
            edges.append(graph.param(key, type=port["type"]))
        wired[name] = edges if port.get("list") else edges[0]
    node = graph.node(declared["id"], "node", **wired)
    outputs = [port["name"] for port in declared["outputs"]]
    for name in outputs:
        graph.output(name, node[name])
    settings: dict[str, Any] = {f"node.{name}": value for name, value in params.items() if value is not None}
    done = run(graph, {**given, **settings}, **options)
    results = [done.outputs[name] for name in outputs]
    if len(results) == 1:
        return results[0]
    return collections.namedtuple(f"{declared['id'].rsplit('.', 1)[-1]}Outputs", outputs)(*results)


def _function(name: str, declared: Any) -> Callable[..., Any]:
    parameters = []
    order = sorted(declared["inputs"], key=lambda port: bool(port.get("optional") or port.get("list")))
    for port in order:
        optional = bool(port.get("optional") or port.get("list"))
        parameters.append(
            inspect.Parameter(
                port["name"],
                inspect.Parameter.POSITIONAL_OR_KEYWORD,
                default=None if optional else inspect.Parameter.empty,
            )
        )
    for param in declared["params"]:
        default = inspect.Parameter.empty if param.get("required") else param.get("default")
        keyword = _nodes.keyword_of(declared, param["name"])
        parameters.append(inspect.Parameter(keyword, inspect.Parameter.KEYWORD_ONLY, default=default))
    options = {"cache": False, "threads": 0, "memory": None, "seed": 0, "progress": None}
    taken = {parameter.name for parameter in parameters}
    for option, standard in options.items():
        if option not in taken:
            parameters.append(inspect.Parameter(option, inspect.Parameter.KEYWORD_ONLY, default=standard))
    signature = inspect.Signature(parameters)
    ports = {port["name"] for port in declared["inputs"]}
    known = {_nodes.keyword_of(declared, param["name"]): param["name"] for param in declared["params"]}

    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            bound = signature.bind(*args, **kwargs)
        except TypeError as problem:
            raise TypeError(f"{name}(): {problem}") from None
        values = bound.arguments
        return _call(
            declared,
            {key: value for key, value in values.items() if key in ports},
            {known[key]: value for key, value in values.items() if key in known},
            {"cache": False, **{key: value for key, value in values.items() if key not in ports and key not in known}},
        )

    call.__name__ = call.__qualname__ = name
    call.__module__ = __name__
    call.__doc__ = _nodes.doc_of(declared)
    call.__signature__ = signature  # type: ignore[attr-defined]
    return call


def _by_name() -> Mapping[str, Any]:
    return {_snake(identifier): declared for identifier, declared in _nodes.declarations().items()}


def __getattr__(name: str) -> Any:
    if name.startswith("_"):
        raise AttributeError(name)
    declared: Optional[Any] = _by_name().get(name)
    if declared is None:
        import difflib

        near = difflib.get_close_matches(name, list(_by_name()), 3)
        hint = f"; did you mean {' or '.join(near)}?" if near else ""
        raise AttributeError(f"there is no function {name!r} in ballflow.geometry{hint}")
    known = _functions.get(name)
    if known is None or known[0] is not declared:
        known = (declared, _function(name, declared))
        _functions[name] = known
    return known[1]


def __dir__() -> Iterable[str]:
    return sorted(_by_name())


__all__ = ["Cache"]

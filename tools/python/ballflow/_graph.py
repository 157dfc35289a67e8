"""Building graphs in Python. What comes out is the JSON that the command line runs."""

from __future__ import annotations

import json
import os
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _artifact, _nodes, _session
from ._errors import UsageError
from ._session import PathLike


class Port:
    """An output of a node of a graph, to be connected to inputs of others."""

    def __init__(self, graph: "Graph", text: str) -> None:
        self._graph = graph
        self.text = text

    def __repr__(self) -> str:
        return f"<output {self.text}>"


class Parameter:
    """A parameter of a graph, to be given to parameters (or inputs, where it is an artifact) of nodes."""

    def __init__(self, graph: "Graph", name: str) -> None:
        self._graph = graph
        self.name = name

    def __str__(self) -> str:
        return "${" + self.name + "}"

    def __repr__(self) -> str:
        return f"<parameter {self.name}>"


class Node:
    """A node of a graph; its outputs are attributes (``voronoi.poles``) or items (``voronoi["poles"]``)."""

    def __init__(self, graph: "Graph", name: str, outputs: Optional[Sequence[str]]) -> None:
        self._graph = graph
        self._name = name
        self._outputs = outputs  # None: those of a subgraph, which the engine checks

    def __getitem__(self, output: str) -> Port:
        if self._outputs is not None and output not in self._outputs:
            raise AttributeError(f"{self._name} has no output {output!r}; it has {', '.join(self._outputs)}")
        return Port(self._graph, f"{self._name}.{output}")

    def __getattr__(self, output: str) -> Port:
        if output.startswith("_"):
            raise AttributeError(output)
        return self[output]

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *(self._outputs or ())})

    def __repr__(self) -> str:
        return f"<node {self._name}>"


class Graph:
    """A graph in the making.

        g = Graph(doc="The inner balls of a scan.")
        epsilon = g.param("epsilon", 0.3, minimum=0, unit="% of the longest bounding-box edge", doc="...")
        scan = g.Sample(file=g.param("input", kind="file", doc="a mesh"))
        poles = g.VoronoiPoles(points=scan.points)
        g.output("poles", poles.poles)
        g.save("poles.json")

    A node type is a method: inputs and parameters are its keywords, ``name=`` names the node (else its type in
    small letters, with a number where that is taken). ``graph`` includes another graph file, ``add`` takes what
    a graph file says of a node (loops, maps) as a dict.
    """

    def __init__(self, doc: str = "", file: Optional[PathLike] = None) -> None:
        self._json: dict[str, Any] = {"doc": doc} if doc else {}
        #: What relative paths of subgraphs are relative to; the name in messages.
        self.file: Optional[str] = os.fspath(file) if file is not None else None

    # ---- parts

    def param(
        self,
        name: str,
        default: Any = None,
        *,
        kind: Optional[str] = None,
        doc: str = "",
        unit: str = "",
        minimum: Optional[float] = None,
        maximum: Optional[float] = None,
        choices: Optional[Sequence[str]] = None,
        type: Optional[str] = None,
    ) -> Parameter:
        """Declares a parameter. ``kind`` is that of the default unless given (number, integer, boolean, string,
        choice, file, list, files, artifact); without a default it has to be set in every run."""
        params = self._json.setdefault("params", {})
        if name in params:
            raise UsageError(f"the graph has a parameter {name!r} already")
        if kind is None:
            kind = "artifact" if type else "choice" if choices else _kind_of(default)
        declared: dict[str, Any] = {"kind": kind}
        if default is not None:
            declared["default"] = _plain(default)
        for key, value in (("type", type), ("unit", unit), ("minimum", minimum), ("maximum", maximum), ("doc", doc)):
            if value not in (None, ""):
                declared[key] = value
        if choices:
            declared["choices"] = list(choices)
        params[name] = declared
        return Parameter(self, name)

    def add(self, name: str, entry: Mapping[str, Any], outputs: Optional[Sequence[str]] = None) -> Node:
        """Adds a node as a graph file says it; outputs of nodes and parameters may stand in it."""
        nodes = self._json.setdefault("nodes", {})
        if name in nodes:
            raise UsageError(f"the graph has a node {name!r} already")
        nodes[name] = _plain(entry, self)
        return Node(self, name, outputs)

    def graph(self, file: str, name: Optional[str] = None, params: Optional[Mapping[str, Any]] = None,
              **inputs: Union[Port, Parameter]) -> Node:
        """Includes another graph file; a relative path is relative to this graph's file."""
        entry: dict[str, Any] = {"graph": file}
        if inputs:
            entry["inputs"] = inputs
        if params:
            entry["params"] = params
        stem = os.path.splitext(os.path.basename(file))[0]
        return self.add(name or self._free_name(stem.replace("$", "").strip("{}")), entry)

    def output(self, name: str, port: Port, doc: str = "") -> None:
        """Makes an output of a node one of the graph."""
        if not isinstance(port, Port):
            raise TypeError(f"output {name}: give an output of a node, like select.balls, not a {type(port).__name__}")
        outputs = self._json.setdefault("outputs", {})
        if name in outputs:
            raise UsageError(f"the graph has an output {name!r} already")
        outputs[name] = {"from": _plain(port, self), "doc": doc} if doc else _plain(port, self)

    def __getattr__(self, node_type: str) -> Any:
        if node_type.startswith("_") or not node_type[:1].isupper():
            raise AttributeError(node_type)
        declaration = _nodes.declaration(node_type)
        if declaration is None:
            raise AttributeError(_nodes.unknown(node_type))

        def add_node(*, name: Optional[str] = None, **values: Any) -> Node:
            return self.node(node_type, name, **values)

        add_node.__name__ = node_type
        add_node.__doc__ = _nodes.doc_of(declaration)
        return add_node

    def node(self, type: str, name: Optional[str] = None, **values: Any) -> Node:
        """Adds a node of a type: ``g.node("acme.Offset", points=scan.points)`` where a type has a dot in it."""
        declaration = _nodes.declaration(type)
        if declaration is None:
            raise UsageError(_nodes.unknown(type))
        ports = {port["name"]: port for port in declaration["inputs"]}
        known = {_nodes.keyword_of(declaration, param["name"]): param["name"] for param in declaration["params"]}
        inputs, params = {}, {}
        for key, value in values.items():
            if key in ports:
                inputs[key] = value
            elif key in known:
                params[known[key]] = value
            else:
                raise TypeError(f"{type} has no input or parameter {key!r}; it has {', '.join([*ports, *known])}")
        entry: dict[str, Any] = {"type": type}
        if inputs:
            entry["inputs"] = inputs
        if params:
            entry["params"] = params
        outputs = [port["name"] for port in declaration["outputs"]]
        return self.add(name or self._free_name(_snake(type)), entry, outputs)

    def _free_name(self, base: str) -> str:
        nodes = self._json.get("nodes", {})
        if base not in nodes:
            return base
        number = 2
        while f"{base}{number}" in nodes:
            number += 1
        return f"{base}{number}"

    # ---- the whole

    def to_dict(self) -> dict[str, Any]:
        """What a graph file says, as Python values."""
        return json.loads(json.dumps(self._json))  # type: ignore[no-any-return]

    def to_json(self) -> str:
        """The text of a graph file."""
        return json.dumps(self._json, indent=2, ensure_ascii=False) + "\n"

    def save(self, path: PathLike) -> None:
        """Writes the graph file."""
        target = os.fspath(path)
        scratch = target + ".part"
        with open(scratch, "w", encoding="utf-8") as file:
            file.write(self.to_json())
        os.replace(scratch, target)

    @classmethod
    def load(cls, graph: PathLike) -> "Graph":
        """Reads a graph: a file, or the name of one that comes with ballflow. Comments are not kept."""
        path = _session.graph_file(graph)
        with open(path, encoding="utf-8-sig") as file:
            text = file.read()
        result = cls(file=path)
        result._json = json.loads(_without_comments(text))
        return result

    def __repr__(self) -> str:
        nodes = self._json.get("nodes", {})
        return f"<graph of {len(nodes)} nodes: {', '.join(nodes)}>"


def _kind_of(default: Any) -> str:
    if isinstance(default, (bool, np.bool_)):
        return "boolean"
    if isinstance(default, (int, np.integer)):
        return "integer"
    if isinstance(default, (float, np.floating)):
        return "number"
    if isinstance(default, (list, tuple)):
        return "list"
    if isinstance(default, os.PathLike):
        return "file"
    if isinstance(default, str):
        return "string"
    raise TypeError("give the kind of a parameter that has no default")


def _plain(value: Any, graph: Optional[Graph] = None) -> Any:
    """What JSON has for a value of Python."""
    if isinstance(value, (Port, Parameter)):
        if graph is not None and value._graph is not graph:
            raise UsageError(f"{value!r} belongs to another graph")
        return value.text if isinstance(value, Port) else str(value)
    if isinstance(value, Mapping):
        return {str(key): _plain(entry, graph) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry, graph) for entry in value]
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, _artifact.Artifact):
        raise TypeError("an artifact is no part of a graph: declare a parameter of kind artifact and give it to run()")
    raise TypeError(f"a graph cannot hold a {type(value).__name__}")


def _snake(name: str) -> str:
    """VoronoiPoles -> voronoi_poles; acme.Offset -> offset; IPSolve -> ip_solve."""
    name = name.rsplit(".", 1)[-1]
    parts = ""
    for i, letter in enumerate(name):
        begins = letter.isupper() and i > 0
        after_small = begins and not name[i - 1].isupper()
        before_small = begins and i + 1 < len(name) and name[i + 1].islower()
        parts += ("_" if after_small or before_small else "") + letter.lower()
    return parts


def _without_comments(text: str) -> str:
    """JSON without // and /* */ comments; what is in texts stays."""
    result = []
    i = 0
    while i < len(text):
        if text[i] == '"':
            end = i + 1
            while end < len(text) and text[end] != '"':
                end += 2 if text[end] == "\\" else 1
            result.append(text[i : end + 1])
            i = end + 1
        elif text.startswith("//", i):
            end = text.find("\n", i)
            i = len(text) if end < 0 else end
        elif text.startswith("/*", i):
            end = text.find("*/", i + 2)
            i = len(text) if end < 0 else end + 2
        else:
            result.append(text[i])
            i += 1
    return "".join(result)


__all__ = ["Graph", "Node", "Parameter", "Port"]

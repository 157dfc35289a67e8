"""The node types, for ``help(ballflow.nodes.Enlarge)``; they are built into graphs by ``ballflow.Graph`` and
called as functions in ``ballflow.geometry``."""

from __future__ import annotations

from typing import Any, Iterable

from . import _nodes


class NodeType:
    """One node type: ``declaration`` is what its library says of it."""

    declaration: Any


def __getattr__(name: str) -> Any:
    if name.startswith("_"):
        raise AttributeError(name)
    declaration = _nodes.declaration(name)
    if declaration is None:
        raise AttributeError(_nodes.unknown(name))
    return type(
        name,
        (NodeType,),
        {"declaration": declaration, "__doc__": _nodes.doc_of(declaration), "__module__": __name__},
    )


def __dir__() -> Iterable[str]:
    return sorted(_nodes.declarations())

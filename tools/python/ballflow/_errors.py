"""What goes wrong, as exceptions that say what, where, and what to do next."""

from __future__ import annotations

from typing import TYPE_CHECKING, Optional, Sequence

if TYPE_CHECKING:
    from ._results import Run


class BallflowError(Exception):
    """What went wrong; ``hint`` says what to do next (it may be empty)."""

    def __init__(self, cause: str, hint: str = "") -> None:
        super().__init__(cause if not hint else f"{cause}\n  {hint}")
        self.cause = cause
        self.hint = hint


class UsageError(BallflowError):
    """What was asked for cannot be: an unknown graph, parameter, output or node, or a value out of range."""


class GraphError(UsageError):
    """A graph that cannot be run, with all ``findings`` about it: file, line, what is wrong, what to do."""

    def __init__(self, findings: Sequence[str]) -> None:
        super().__init__("\n".join(findings))
        self.findings = list(findings)


class NodeFailed(BallflowError):
    """A node failed: ``node`` is its path in the graph. What other nodes have made is in ``run``."""

    def __init__(self, node: str, cause: str, hint: str = "", run: Optional["Run"] = None) -> None:
        super().__init__(f"node {node}: {cause}", hint)
        self.node = node
        self.run = run


class Cancelled(BallflowError):
    """The progress callback ended the run. What was finished is in the cache, and in ``run``."""

    def __init__(self, run: Optional["Run"] = None) -> None:
        super().__init__("the run was cancelled", "what was finished is in the cache; the same call goes on from there")
        self.run = run


class StoreError(BallflowError):
    """The cache or a file cannot be read, written or trusted."""


class PluginError(BallflowError):
    """A node library cannot be used, or gave something that it must not give."""


class BallflowWarning(UserWarning):
    """What a node, a graph or the cache wants to be known about a result."""


def of_engine(code: str, cause: str, hint: str, findings: Sequence[str]) -> BallflowError:
    """The exception for an error of the engine."""
    if findings:
        return GraphError(findings)
    kinds = {"store": StoreError, "plugin": PluginError, "usage": UsageError, "cancelled": UsageError}
    return kinds.get(code, BallflowError)(cause, hint)

"""Nodes that were written in Python in this process, as the engine gets them."""

from __future__ import annotations

import json
from typing import Any

from ._artifact import Artifact


def current() -> tuple[Any, ...]:
    """The functions decorated with ballflow.node so far; of one id the newest."""
    try:
        from . import _node
    except ImportError:
        return ()
    newest = {function.declaration["id"]: function for function in _node.registered()}
    return tuple(newest.values())


def entry(function: Any) -> tuple[str, str, str, Any]:
    """What the engine's registry takes: declaration, file, digest, and what it calls."""

    def call(inputs: Any, params: str, run: Any) -> Any:
        from . import _node
        from ._run import _artifact_of

        lists = {name: [_artifact_of(core) for core in cores] for name, cores in inputs.items()}
        try:
            outputs: dict[str, Artifact] = function.call(lists, json.loads(params), run)
        except BaseException as problem:  # whatever the function raises ends the node, not the run
            if run.cancelled():
                return ("cancelled",)
            cause, hint = _node.failure_of(problem)
            return "failed", cause, hint
        return "ok", {name: artifact._core for name, artifact in outputs.items()}

    return json.dumps(function.declaration), function.file, function.digest, call

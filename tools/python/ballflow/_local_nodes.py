"""Nodes that were written in Python in this process, as the engine gets them."""

from __future__ import annotations

import json
import sys
from typing import Any

from ._artifact import Artifact


def current() -> tuple[tuple[Any, str], ...]:
    """The functions decorated with ballflow.node so far, of one id the newest, with their digests: in a notebook
    what they call may be another function than before."""
    if f"{__package__}._node" not in sys.modules:
        return ()
    from . import _node

    newest = {function.id: function for function in _node.registered()}
    return tuple((function, function.digest) for function in newest.values())


def entry(node: tuple[Any, str]) -> tuple[str, str, str, Any]:
    """What the engine's registry takes: declaration, file, digest, and what it calls."""
    function, digest = node

    def call(inputs: Any, params: str, run: Any) -> Any:
        from . import _failures
        from ._results import artifact_of

        lists = {name: [artifact_of(core) for core in cores] for name, cores in inputs.items()}
        try:
            outputs: dict[str, Artifact] = function.call(lists, json.loads(params), run)
        except BaseException as problem:  # whatever the function raises ends the node, not the run
            if run.cancelled():
                return ("cancelled",)
            cause, hint = _failures.failure_of(problem)
            return "failed", cause, hint
        return "ok", {name: artifact._core for name, artifact in outputs.items()}

    return json.dumps(function.declaration), function.file, digest, call

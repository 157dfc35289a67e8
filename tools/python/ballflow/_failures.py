"""What is said of a function that failed: the place, the cause, the next step."""

from __future__ import annotations

import os
import traceback


def place_of(problem: BaseException, file: str = "") -> str:
    """The innermost place in `file`, else the innermost outside of this package: "my_nodes.py:12, in Scale"."""
    if isinstance(problem, SyntaxError) and problem.filename:
        return f"{os.path.basename(problem.filename)}:{problem.lineno}"
    package = os.path.dirname(__file__)
    frames = [f for f in traceback.extract_tb(problem.__traceback__) if os.path.dirname(f.filename) != package]
    own = [frame for frame in frames if frame.filename == file]
    for frame in (own or frames)[-1:]:
        inside = "" if frame.name == "<module>" else f", in {frame.name}"
        return f"{os.path.basename(frame.filename)}:{frame.lineno}{inside}"
    return os.path.basename(file)


def failure_of(problem: BaseException, file: str = "") -> tuple[str, str]:
    """Cause and hint of a node that failed: ("ValueError: too few (my_nodes.py:12, in Scale)", what to do)."""
    text = " ".join((problem.msg if isinstance(problem, SyntaxError) else str(problem)).split())
    place = place_of(problem, file)
    cause = f"{type(problem).__name__}{': ' + text if text else ''}{f' ({place})' if place else ''}"
    if isinstance(problem, MemoryError):
        return cause, "use a smaller input, or a machine with more memory"
    return cause, "correct the function and run again: what was computed before is in the cache"


def trace_of(problem: BaseException) -> list[str]:
    """The lines of the traceback, without the frames of this package."""
    package = os.path.dirname(__file__)
    shown = traceback.TracebackException.from_exception(problem)
    shown.stack = traceback.StackSummary.from_list(
        [f for f in shown.stack if os.path.dirname(f.filename) != package]
    )
    return [line for part in shown.format() for line in part.rstrip("\n").split("\n")]

"""What progress=True shows."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable, Optional, Protocol, TextIO

Event = dict[str, Any]
Callback = Callable[[Event], Any]


class Display(Protocol):
    def __call__(self, event: Event) -> None: ...
    def close(self) -> None: ...


class Lines:
    """A line for every node that has taken a second, and every ten seconds one for what still runs."""

    def __init__(self, stream: Optional[TextIO] = None) -> None:
        self._stream = stream if stream is not None else sys.stderr
        self._said = time.monotonic()
        self._fractions: dict[str, float] = {}

    def __call__(self, event: Event) -> None:
        kind = event["event"]
        node = event.get("node", "")
        if kind == "node_started":
            self._fractions[node] = 0.0
        elif kind == "node_progress":
            self._fractions[node] = event["fraction"]
            now = time.monotonic()
            if now - self._said >= 10:
                self._said = now
                self._stream.write(f"ballflow: {node} {100 * event['fraction']:.0f} %\n")
        elif kind == "node_finished":
            self._fractions.pop(node, None)
            if event["status"] == "run" and event["seconds"] >= 1:
                self._said = time.monotonic()
                self._stream.write(f"ballflow: {node} done in {event['seconds']:.1f} s\n")

    def close(self) -> None:
        self._stream.flush()


class Bar:
    """A bar of tqdm: nodes done of all that are needed, and what runs."""

    def __init__(self, nodes: int) -> None:
        import importlib

        tqdm = importlib.import_module("tqdm.auto").tqdm  # it may be absent, and has no types

        self._bar = tqdm(total=float(nodes), unit="node", leave=False, bar_format="{desc}: {percentage:3.0f}%|{bar}|")
        self._running: dict[str, float] = {}
        self._done = 0

    def __call__(self, event: Event) -> None:
        kind = event["event"]
        node = event.get("node", "")
        if kind == "node_started":
            self._running[node] = 0.0
        elif kind == "node_progress":
            self._running[node] = event["fraction"]
        elif kind == "node_finished":
            self._running.pop(node, None)
            self._done += 1
        else:
            return
        self._bar.n = self._done + sum(self._running.values())
        self._bar.set_description_str(next(iter(self._running), "ballflow"), refresh=False)
        self._bar.refresh()

    def close(self) -> None:
        self._bar.close()


def display(nodes: int) -> Display:
    """A bar where tqdm is installed, else lines."""
    try:
        return Bar(nodes)
    except ImportError:
        return Lines()

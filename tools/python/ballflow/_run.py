"""Running graphs."""

from __future__ import annotations

import json
import os
import shlex
import warnings
from typing import Any, Callable, Mapping, Optional, Sequence, Union

from . import _core as _core
from . import _inputs, _progress, _session
from ._artifact import Artifact
from ._errors import BallflowWarning, Cancelled, NodeFailed, UsageError
from ._graph import Graph
from ._results import Run
from ._session import Cache, PathLike

Progress = Union[bool, None, Callable[[dict[str, Any]], Any]]
GraphLike = Union[PathLike, Graph]


class _Request:
    """A graph and what its parameters are to be, in the words of the engine."""

    def __init__(self, graph: GraphLike, values: Mapping[str, Any], plugins: Sequence[PathLike]) -> None:
        self.registry = _session.registry(plugins)
        self.base = _session.base_registry(plugins)
        self.plugins = list(plugins)
        self.text: Optional[str] = None
        if isinstance(graph, Graph):
            self.text = graph.to_json()
            self.file = graph.file or "graph"
        else:
            self.file = _session.graph_file(graph)
        self.files = _inputs.Files()
        self.settings: list[tuple[str, str]] = []
        self.axes: list[tuple[str, str]] = []
        self.inputs: list[str] = []
        self.given: dict[str, Any] = {}
        _, params, _ = _core.outline(self.file, self.text)
        self.kinds: dict[str, str] = {name: kind for name, kind, _, _ in params}
        self.params = params
        self._values = values

    def set_all(self) -> None:
        for name, value in self._values.items():
            self.set(name, value)

    def set(self, name: str, value: Any) -> None:
        kind = self.kinds.get(name)
        if value is None:
            raise TypeError(f"{name}: None is no value; leave it out for the default")
        if kind == "artifact" and not isinstance(value, (str, os.PathLike)):
            self.given[name] = self._artifact(name, value)
        elif kind == "files" and isinstance(value, (list, tuple)):
            self.settings.append((name, json.dumps(_inputs.paths_of(value, name, self.files))))
        elif kind in (None, "file") and _inputs.is_geometry(value):
            self.settings.append((name, _inputs.file_of(value, name, self.files)))
        else:
            self.settings.append((name, _inputs.text_of(value, name)))

    def _artifact(self, name: str, value: Any) -> Any:
        if not isinstance(value, Artifact):
            raise TypeError(f"{name} takes an artifact, like ballflow.Balls(...), or the path of one; "
                            f"not a {type(value).__name__}")
        if value._core is None:
            raise TypeError(f"{name}: this artifact was not made by the engine")
        return value._core

    def command(self, options: Any) -> str:
        """The command line that repeats the run; empty where arrays or functions of this process have a part in it."""
        if self.text is not None or self.given or self.files.used or self.registry is not self.base:
            return ""
        words = ["ballflow", "run", self.file]
        words += [part for plugin in self.plugins for part in ("--plugin", os.fspath(plugin))]
        words += [part for name, value in self.settings for part in ("--set", f"{name}={value}")]
        words += [part for name, value in self.axes for part in ("--axis", f"{name}={value}")]
        words += ["--inputs", *self.inputs] if self.inputs else []
        words += ["--seed", str(options.seed)] if options.seed else []
        words += [part for name in options.until for part in ("--until", name)]
        words += [part for name in options.only for part in ("--only", name)]
        return shlex.join(words)

    def load(self, store: Any) -> Any:
        plan = _core.load_plan(self.registry, self.file, self.text, self.settings, self.axes, self.inputs,
                               self.given, store)
        for warning in plan.warnings:
            warnings.warn(warning, BallflowWarning, stacklevel=4)
        return plan


def _names(value: Union[str, Sequence[str], None]) -> list[str]:
    if value is None:
        return []
    return [value] if isinstance(value, str) else [str(name) for name in value]


def _settings(threads: int, memory: Union[str, int, None], seed: int, keep_going: bool, strict: bool,
              until: Any, only: Any, force: Any) -> Any:
    settings = _core.RunSettings()
    if not isinstance(threads, int) or not 0 <= threads <= 4096:
        raise ValueError(f"threads must be 0 (all processors) to 4096, is {threads!r}")
    if not isinstance(seed, int) or not 0 <= seed < 2**64:
        raise ValueError(f"seed must be 0 to 2**64 - 1, is {seed!r}")
    settings.threads = threads
    settings.memory = "" if memory is None else str(memory)
    settings.seed = seed
    settings.keep_going = bool(keep_going)
    settings.strict = bool(strict)
    settings.until = _names(until)
    settings.only = _names(only)
    settings.force = _names(force)
    return settings


def _execute(
    plan: Any, store: Any, settings: Any, cache_size: Optional[str], progress: Progress, command: str
) -> Any:
    display: Optional[_progress.Display] = None
    callback: Optional[Callable[[dict[str, Any]], Any]] = None
    if progress is True:
        display = _progress.display(len(plan.nodes))
        callback = display
    elif callable(progress):
        callback = progress
    elif progress not in (None, False):
        raise TypeError("progress is True, False, or a function that gets events")
    try:
        return _core.run(plan, store, settings, cache_size or "", command, callback)
    finally:
        if display is not None:
            display.close()


def _tell(run: Run, upstream_notes: Sequence[str], stacklevel: int) -> None:
    for text in [*run.warnings, *(f"upstream: {note}" for note in upstream_notes)]:
        warnings.warn(text, BallflowWarning, stacklevel=stacklevel)
    if run._core.trouble:
        warnings.warn(f"not everything could be cached: {run._core.trouble}", BallflowWarning, stacklevel=stacklevel)


def _failure(run: Run) -> Optional[NodeFailed]:
    for path, node in run.report["nodes"].items():
        if node["status"] == "failed":
            return NodeFailed(path, node["error"]["cause"], node["error"]["hint"], run)
    return None


def run(
    graph: GraphLike,
    params: Optional[Mapping[str, Any]] = None,
    *,
    cache: Cache = None,
    cache_size: Optional[str] = None,
    upstream: Optional[PathLike] = None,
    upstream_read_only: bool = False,
    plugins: Sequence[PathLike] = (),
    threads: int = 0,
    memory: Union[str, int, None] = None,
    seed: int = 0,
    keep_going: bool = False,
    strict: bool = False,
    until: Union[str, Sequence[str], None] = None,
    only: Union[str, Sequence[str], None] = None,
    force: Union[str, Sequence[str], None] = None,
    progress: Progress = None,
    **settings: Any,
) -> Run:
    """Runs a graph; what is in the cache is not computed again.

    ``graph``: the name of one that comes with ballflow (``ballflow.graphs()``), a file, or a ``Graph``.
    Parameters are keywords (``epsilon=0.3``) or, where their names are no words of Python, in ``params``
    (``{"prune/greedy.mode": "all"}``). A parameter that is a file takes a path, points (``n x 3``), a mesh as
    ``(points, triangles)`` (``n x 3``, ``m x 3``), objects of trimesh, Open3D and PyVista, or an artifact;
    one that is an artifact takes an artifact or the path of one.

    ``cache``: a folder; None is that of the command line, False none. ``cache_size`` as of the command line
    ("5G"). ``upstream``: a folder or http:// address that several machines share (docs/cluster.md), None is
    $BALLFLOW_UPSTREAM; ``upstream_read_only`` takes from it and publishes nothing. ``plugins``: node libraries. ``threads``: 0 is all processors; results never depend on it.
    ``memory``: what running nodes may take together ("8G", "50%", bytes). ``keep_going``: after a failure go on
    with what does not need the failed node, and return the run instead of raising. ``until``, ``only``,
    ``force``: names of nodes, as of the command line.

    ``progress``: True shows it; a function gets a dict for every event (schemas/run_events.schema.json), in the
    calling thread, and ends the run by returning False. Ctrl-C ends it as well; what is finished is kept.

    Raises GraphError, UsageError, NodeFailed, Cancelled, StoreError, PluginError; TypeError and ValueError for
    values of parameters. Warnings of nodes are Python warnings (BallflowWarning).
    """
    _session.check_process()
    if not isinstance(graph, (str, os.PathLike, Graph)):
        raise TypeError(f"graph is a name, a path or a Graph, not a {type(graph).__name__}")
    request = _Request(graph, {**(params or {}), **settings}, plugins)
    request.set_all()
    store = _session.store(cache, upstream, upstream_read_only)
    noted = len(store.upstream_notes)
    plan = request.load(store)
    if plan.variants:
        raise UsageError(f"{request.file} is a sweep", "use ballflow.sweep()")
    options = _settings(threads, memory, seed, keep_going, strict, until, only, force)
    core = _execute(plan, store, options, cache_size, progress, request.command(options))
    result = Run(plan, core, request.files, cache, plugins)
    _tell(result, store.upstream_notes[noted:], 3)
    if result.status == "cancelled":
        raise Cancelled(result)
    failure = _failure(result)
    if failure is not None and not keep_going:
        raise failure
    return result


__all__ = ["GraphLike", "Progress", "run"]

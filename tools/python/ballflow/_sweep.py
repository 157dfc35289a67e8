"""Running a graph for every combination of values."""

from __future__ import annotations

import importlib
import json
import os
import warnings
from typing import Any, Iterator, Mapping, Optional, Sequence, Union

from . import _inputs, _session
from ._errors import BallflowWarning, Cancelled, UsageError
from ._graph import Graph
from ._results import NodeResult, Outputs, Run
from ._run import GraphLike, Progress, _execute, _Request, _settings, _tell
from ._session import Cache, PathLike


class Variant:
    """One combination: ``name``, ``values`` (by parameter), ``status`` ("ok", "failed", "skipped"), and its outputs,
    as attributes and in ``outputs``."""

    def __init__(self, run: Run, name: str, values: Mapping[str, Any], places: Mapping[str, tuple[str, str]],
                 status: str) -> None:
        self.name = name
        self.values = values
        self.status = status
        self.outputs = Outputs(run, places)
        self._run = run
        self._places = places

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.outputs, name)

    def summary(self, output: str) -> Mapping[str, Any]:
        """The summary of an output, without loading it; empty where it was not made."""
        path, port = self._places[output]
        made = self._run.report["nodes"][path]["outputs"].get(port)
        summary: Mapping[str, Any] = made["summary"] if made is not None else {}
        return summary

    def __repr__(self) -> str:
        return f"<{self.name}: {self.status}>"


class Sweep(Sequence[Variant]):
    """What a sweep made: its variants in order, ``sweep[0]`` or ``sweep["epsilon=0.1,strategy=greedy"]``."""

    def __init__(self, run: Run, variants: Sequence[Variant]) -> None:
        self._run = run
        self._variants = list(variants)
        self.id = run.id
        self.status = run.status
        self.seconds = run.seconds
        self.cpu_seconds = run.cpu_seconds
        self.report = run.report
        self.nodes: Mapping[str, NodeResult] = run.nodes

    def __getitem__(self, which: Any) -> Any:
        if isinstance(which, str):
            for variant in self._variants:
                if variant.name == which:
                    return variant
            raise KeyError(f"there is no variant {which!r}; there are {', '.join(v.name for v in self._variants[:5])}")
        return self._variants[which]

    def __len__(self) -> int:
        return len(self._variants)

    def __iter__(self) -> Iterator[Variant]:
        return iter(self._variants)

    def rows(self) -> list[dict[str, Any]]:
        """A row for every variant: its values, its status, and the numbers of all summaries ("balls.count")."""
        rows = []
        for variant in self._variants:
            row: dict[str, Any] = {**variant.values, "status": variant.status}
            for output in variant._places:
                for key, value in variant.summary(output).items():
                    if isinstance(value, (bool, int, float)) or value is None:
                        row[f"{output}.{key}"] = value
            rows.append(row)
        return rows

    def table(self) -> Any:
        """The rows as a pandas DataFrame where pandas is installed, else as they are."""
        try:
            pandas = importlib.import_module("pandas")
        except ImportError:
            return self.rows()
        return pandas.DataFrame(self.rows())

    def view(self, width: Union[int, str] = "100%", height: int = 600) -> Any:
        """As ``Run.view``."""
        return self._run.view(width, height)

    def __repr__(self) -> str:
        good = sum(variant.status == "ok" for variant in self._variants)
        return f"<sweep of {self.report['graph']}: {good} of {len(self)} variants ok, {self.seconds:.3g} s>"

    def _repr_html_(self) -> Optional[str]:
        table = self.table()
        return table._repr_html_() if hasattr(table, "_repr_html_") else None


def _values(value: Any, name: str, request: _Request) -> Optional[list[Any]]:
    """The values of an axis, as JSON has them; None where the value is one for all variants."""
    kind = request.kinds.get(name)
    if isinstance(value, (str, bytes, os.PathLike)) or not isinstance(value, (list, tuple, range)):
        return None
    if kind in ("list", "files"):  # every value is a list itself
        lists = [list(one) for one in value if isinstance(one, (list, tuple))]
        return [json.dumps(one) for one in lists] if lists and len(lists) == len(value) else None
    if kind == "file" and isinstance(value, tuple) and _inputs.is_geometry(value):
        return None  # one mesh
    return [
        _inputs.file_of(one, name, request.files)
        if kind == "file" and _inputs.is_geometry(one)
        else _inputs.plain(one, name)
        for one in value
    ]


def sweep(
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
    strict: bool = False,
    progress: Progress = None,
    **settings: Any,
) -> Sweep:
    """Runs a graph for every combination of values; what combinations have in common runs once.

    As ``run``, but a list is an axis: ``epsilon=[.1, .3]``. A file parameter takes a pattern (``"scans/*.ply"``)
    or a list of files and meshes. Where no list is given, the graph's own "sweep" counts. A variant that fails
    does not end the others: see its ``status``, and a warning.
    """
    _session.check_process()
    if not isinstance(graph, (str, os.PathLike, Graph)):
        raise TypeError(f"graph is a name, a path or a Graph, not a {type(graph).__name__}")
    request = _Request(graph, {}, plugins)
    for name, value in {**(params or {}), **settings}.items():
        values = _values(value, name, request)
        if values is not None:
            if not values:
                raise UsageError(f"{name}: an axis without values", "give at least one")
            request.axes.append((name, json.dumps(values)))
        elif request.kinds.get(name) == "file" and isinstance(value, (str, os.PathLike)) and _is_pattern(value):
            request.inputs.append(f"{name}={os.fspath(value)}")
        else:
            request.set(name, value)
    store = _session.store(cache, upstream, upstream_read_only)
    noted = len(store.upstream_notes)
    plan = request.load(store)
    if not plan.variants:
        raise UsageError(f"{request.file}: nothing to sweep over", "give a list of values: epsilon=[0.1, 0.3]")
    options = _settings(threads, memory, seed, True, strict, None, None, None)
    core = _execute(plan, store, options, cache_size, progress, request.command(options))
    run = Run(plan, core, request.files, cache, plugins)
    _tell(run, store.upstream_notes[noted:], 3)
    if run.status == "cancelled":
        raise Cancelled(run)
    result = Sweep(run, _variants(plan, run))
    failed = [variant for variant in result if variant.status != "ok"]
    if failed:
        causes = [f"{path}: {node['error']['cause']}" for path, node in run.report["nodes"].items()
                  if node["status"] == "failed"]
        warnings.warn(f"{len(failed)} of {len(result)} variants have not all outputs: {'; '.join(causes[:3])}",
                      BallflowWarning, stacklevel=2)
    return result


def _is_pattern(value: Any) -> bool:
    text = os.fspath(value)
    return any(letter in text for letter in "*?[") and not os.path.exists(text)


def _variants(plan: Any, run: Run) -> list[Variant]:
    places: dict[str, dict[str, tuple[str, str]]] = {}
    for name, path, port, _, _ in plan.outputs:
        variant, _, output = name.partition("/")
        places.setdefault(variant, {})[output] = (path, port)
    variants = []
    for name, values in plan.variants:
        own = places.get(name, {})
        states = [run.nodes[path].status for path, _ in own.values()]
        status = "ok" if all(state in ("hit", "run") for state in states) else (
            "failed" if "failed" in states else "skipped")
        variants.append(Variant(run, name, {key: json.loads(value) for key, value in values}, own, status))
    return variants


__all__ = ["Sweep", "Variant", "sweep"]

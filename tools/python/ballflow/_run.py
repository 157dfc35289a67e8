"""Running graphs."""

from __future__ import annotations

import importlib
import json
import os
import shlex
import subprocess
import tempfile
import warnings
from typing import Any, Callable, Iterable, Iterator, Mapping, Optional, Sequence, Union

from . import _core as _core
from . import _inputs, _progress, _session
from ._artifact import Artifact, class_named
from ._errors import BallflowError, BallflowWarning, Cancelled, NodeFailed, UsageError
from ._graph import Graph
from ._session import Cache, PathLike

Progress = Union[bool, None, Callable[[dict[str, Any]], Any]]
GraphLike = Union[PathLike, Graph]


def _artifact_of(core: Any) -> Artifact:
    return Artifact._of(core.type, core.version, core.arrays(), json.loads(core.summary), core)


class NodeResult:
    """What became of one node: ``path``, ``type``, ``status`` ("hit", "run", "failed", "skipped", "cancelled",
    "pending"), ``reason``, ``seconds`` and ``cpu_seconds`` of this run, ``cost_seconds`` (what computing it took
    once), ``warnings``, ``params``. Its outputs are attributes: ``run["select"].balls``."""

    def __init__(self, run: "Run", path: str, report: Mapping[str, Any]) -> None:
        self._run = run
        self._report = report
        self.path = path
        self.type: str = report["type"]
        self.status: str = report["status"]
        self.reason: str = report["reason"]
        self.seconds: float = report["seconds"]
        self.cpu_seconds: float = report["cpu_seconds"]
        self.cost_seconds: float = report["cost_seconds"]
        self.params: Mapping[str, Any] = report["params"]
        self.warnings: Sequence[str] = report.get("warnings", [])

    @property
    def outputs(self) -> Sequence[str]:
        """The names of its outputs."""
        return list(self._report["outputs"])

    def __getitem__(self, output: str) -> Artifact:
        if output not in self._report["outputs"]:
            raise KeyError(f"{self.path} has no output {output!r}; it has {', '.join(self.outputs) or 'none'}")
        return self._run._load(self.path, output)

    def __getattr__(self, name: str) -> Artifact:
        if name.startswith("_") or name not in self._report["outputs"]:
            raise AttributeError(f"{self.path} has no output {name!r}; it has {', '.join(self.outputs) or 'none'}")
        return self[name]

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *self.outputs})

    def __repr__(self) -> str:
        return f"<{self.path} ({self.type}): {self.status}, {self.seconds:.3g} s>"


class Outputs(Mapping[str, Artifact]):
    """Artifacts by name, loaded when they are looked at; also as attributes."""

    def __init__(self, run: "Run", places: Mapping[str, tuple[str, str]], prefix: str = "") -> None:
        self._run = run
        self._places = places
        self._prefix = prefix

    def __getitem__(self, name: str) -> Artifact:
        if name not in self._places:
            raise KeyError(f"there is no output {name!r}; there are {', '.join(self._places)}")
        return self._run._load(*self._places[name])

    def __getattr__(self, name: str) -> Artifact:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as problem:
            raise AttributeError(problem.args[0]) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *self._places})

    def __repr__(self) -> str:
        return f"<outputs: {', '.join(self._places)}>"


class Run:
    """A run that has ended. Its outputs are attributes and in ``outputs``; ``run["prune/bound"]`` is a node.

    ``id``, ``status`` ("ok", "failed", "cancelled"), ``seconds``, ``cpu_seconds``, ``params`` (of the graph),
    ``nodes`` (by path), ``report`` (everything, as schemas/run_report.schema.json says).
    """

    def __init__(self, plan: Any, core: Any, files: Any, cache: Cache, plugins: Sequence[PathLike]) -> None:
        self._plan = plan
        self._core = core
        self._files = files  # made of arrays: a node that is run again reads them again
        self._cache = cache
        self._plugins = list(plugins)
        self.report: dict[str, Any] = json.loads(core.report)
        self.id: str = core.id
        self.status: str = self.report["status"]
        self.seconds: float = self.report["seconds"]
        self.cpu_seconds: float = self.report["cpu_seconds"]
        self.params: Mapping[str, Any] = self.report["params"]
        self.nodes: Mapping[str, NodeResult] = {
            path: NodeResult(self, path, node) for path, node in self.report["nodes"].items()
        }
        self.outputs = Outputs(self, {name: (path, port) for name, path, port, _, _ in plan.outputs})

    def _load(self, path: str, port: str) -> Artifact:
        node = self.nodes[path]
        if node.status not in ("hit", "run"):
            raise BallflowError(f"{path} was not computed in this run ({node.status})", node.reason)
        return _artifact_of(self._core.artifact(path, port))

    def __getattr__(self, name: str) -> Artifact:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.outputs, name)  # type: ignore[no-any-return]

    def __getitem__(self, path: str) -> NodeResult:
        found = self.nodes.get(path)
        if found is None:
            raise KeyError(f"the run has no node {path!r}; run.nodes lists them")
        return found

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *self.outputs})

    @property
    def warnings(self) -> Sequence[str]:
        """What nodes warned of, with their paths."""
        return [f"{path}: {text}" for path, node in self.nodes.items() for text in node.warnings]

    def _rows(self) -> list[tuple[str, str, str, str]]:
        rows = []
        for name, (path, port) in self.outputs._places.items():
            output = self.report["nodes"][path]["outputs"].get(port)
            if output is None:
                rows.append((name, "", self.nodes[path].status, ""))
                continue
            numbers = ", ".join(
                f"{key} {value:.6g}" if isinstance(value, float) else f"{key} {value}"
                for key, value in output["summary"].items()
                if isinstance(value, (int, float, str)) and not isinstance(value, bool) and len(str(value)) < 60
            )
            rows.append((name, output["type"], self.nodes[path].status, numbers))
        return rows

    def __repr__(self) -> str:
        ran = sum(node.status == "run" for node in self.nodes.values())
        hit = sum(node.status == "hit" for node in self.nodes.values())
        lines = [f"<run of {self.report['graph']}: {self.status}, {ran} run, {hit} from the cache, {self.seconds:.3g} s"]
        lines += [f"  {name}: {kind or status}  {numbers[:100]}" for name, kind, status, numbers in self._rows()]
        return "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        import html

        head = html.escape(repr(self).splitlines()[0].lstrip("<"))
        rows = "".join(
            "<tr>" + "".join(f"<td style='text-align:left'>{html.escape(cell)}</td>" for cell in row) + "</tr>"
            for row in self._rows()
        )
        return f"<div>{head}</div><table><tr><th>output</th><th>type</th><th></th><th>summary</th></tr>{rows}</table>"

    def save(self, folder: PathLike, formats: Optional[Mapping[str, str]] = None) -> None:
        """Writes every output into a folder, in the format that the command line would choose, or in
        ``formats`` ({"balls": "csv"}; ``ballflow export --help`` lists them)."""
        known = formats or {}
        for name in known:
            if name not in self.outputs:
                raise UsageError(f"formats: there is no output {name!r}", f"there are {', '.join(self.outputs)}")
        targets = {}
        for name, (path, port) in self.outputs._places.items():
            output = self.report["nodes"][path]["outputs"].get(port)
            if output is None:
                continue  # of a run that did not reach it
            extension = _core.extension(output["type"], known.get(name, ""))
            targets[name] = os.path.join(os.fspath(folder), name + "." + extension)
        self._spare_inputs(targets)
        for name, target in targets.items():
            os.makedirs(os.path.dirname(target), exist_ok=True)
            self.outputs[name].save(target, known.get(name))

    def _spare_inputs(self, targets: Mapping[str, str]) -> None:
        """Raises where an output would be written over a file that the run has read."""
        read = [
            value
            for node in self.nodes.values()
            for value in node.params.values()
            if isinstance(value, str) and value and os.path.isfile(value)
        ]
        for name, target in targets.items():
            for path in read:
                if os.path.exists(target) and os.path.samefile(target, path):
                    raise UsageError(
                        f"the output {name} would be written over the input {path}", "save it in another folder"
                    )

    def view(self, width: Union[int, str] = "100%", height: int = 600) -> Any:
        """Shows the results: in a notebook the viewer in a frame, else the page in a browser."""
        with tempfile.TemporaryDirectory(prefix="ballflow-") as scratch:
            page = self._page(os.path.join(scratch, "run.html"))
        try:
            shell = importlib.import_module("IPython").get_ipython()
            in_notebook = shell is not None and "IPKernelApp" in shell.config
        except ImportError:
            in_notebook = False
        if in_notebook:
            import html

            return importlib.import_module("IPython.display").HTML(
                f'<iframe srcdoc="{html.escape(page, quote=True)}" width="{width}" height="{height}" '
                'style="border:0" sandbox="allow-scripts allow-downloads"></iframe>'
            )
        import webbrowser

        handle, path = tempfile.mkstemp(prefix="ballflow-", suffix=".html")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(page)
        webbrowser.open("file://" + path)
        return path

    def _page(self, path: str) -> str:
        """The viewer with the results of this run in it, as one HTML page."""
        root = _session.store(self._cache).root
        if self._core.recorded and root:
            _program(["view", self.id, "--cache", root, "--output", path], self._plugins)
        else:
            with tempfile.TemporaryDirectory(prefix="ballflow-") as scratch:
                sources = []
                for name in self.outputs:
                    source = os.path.join(scratch, name.replace("/", "_") + ".safetensors")
                    self.outputs[name].save(source)
                    sources.append(source)
                _program(["view", *sources, "--output", path], self._plugins)
        with open(path, encoding="utf-8") as file:
            return file.read()


def _program(arguments: Sequence[str], plugins: Sequence[PathLike] = ()) -> str:
    program = _session.program()
    if program is None:
        raise BallflowError("the program \"ballflow\" is not beside this package", "install ballflow again")
    command = [str(program)]
    for plugin in plugins:
        command += ["--plugin", os.fspath(plugin)]
    done = subprocess.run([*command, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise BallflowError(f"ballflow {arguments[0]}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


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


__all__ = ["NodeResult", "Outputs", "Run", "run", "class_named"]

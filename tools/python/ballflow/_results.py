"""What runs made: artifacts, nodes, outputs, pages and files."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import tempfile
import webbrowser
from typing import Any, Iterable, Iterator, Mapping, Optional, Sequence, Union

from . import _core as _core
from . import _session
from ._artifact import Artifact
from ._errors import BallflowError, UsageError
from ._session import Cache, PathLike


def artifact_of(core: Any) -> Artifact:
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


class _Frame:
    """A page within a notebook."""

    def __init__(self, page: str, width: Union[int, str], height: int) -> None:
        self._page = page
        self._size = (width, height)

    def _repr_html_(self) -> str:
        import html

        width, height = self._size
        return (
            f'<iframe srcdoc="{html.escape(self._page, quote=True)}" width="{html.escape(str(width))}" '
            f'height="{int(height)}" style="border:0" sandbox="allow-scripts allow-downloads"></iframe>'
        )


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
        return artifact_of(self._core.artifact(path, port))

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
        taken = "shared" if self._cache is False else "from the cache"  # equal nodes of a graph are computed once
        lines = [f"<run of {self.report['graph']}: {self.status}, {ran} run, {hit} {taken}, {self.seconds:.3g} s"]
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
            return _Frame(page, width, height)

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


__all__ = ["NodeResult", "Outputs", "Run", "artifact_of"]

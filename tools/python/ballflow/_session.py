"""What calls share: where ballflow is installed, node libraries, and open caches."""

from __future__ import annotations

import json
import os
import sys
import threading
from pathlib import Path
from typing import Any, Iterable, Optional, Sequence, Union

from . import _artifact
from . import _core as _core
from ._errors import BallflowError, UsageError

PathLike = Union[str, "os.PathLike[str]"]
#: A folder; None for the cache of the command line; False for none.
Cache = Union[PathLike, bool, None]

_PACKAGE = Path(__file__).resolve().parent
_lock = threading.RLock()
_registries: dict[tuple[str, ...], tuple[Any, Any]] = {}
_with_nodes: dict[tuple[str, ...], tuple[tuple[Any, ...], Any]] = {}
_stores: dict[tuple[str, str, bool], Any] = {}
_owner = os.getpid()
_used = False


def _first_folder(candidates: Iterable[Path], what: str) -> Path:
    tried = []
    for candidate in candidates:
        if candidate.is_dir():
            return candidate
        tried.append(str(candidate))
    raise BallflowError(f"{what} of ballflow are not where they belong ({', '.join(tried)})", "install ballflow again")


def _roots() -> list[Path]:
    module = Path(_core.__file__).resolve().parent
    # A wheel has everything below the package, a build tree beside its folder python/, and a system package in
    # /usr/lib/python3/dist-packages, two folders below /usr/lib.
    return [module, module.parent.parent, module.parent.parent.parent.parent]


def library_folder() -> Path:
    """The folder of ballflow's own node libraries."""
    return _first_folder((root / "lib" / "ballflow" for root in _roots()), "the node libraries")


def share_folder() -> Path:
    """The folder that has graphs/, schemas/ and the viewer."""
    return _first_folder((root / "share" / "ballflow" for root in _roots()), "graphs")


def program() -> Optional[Path]:
    """The command line program that belongs to this package; None where there is none."""
    for root in _roots():
        path = root / "bin" / "ballflow"
        if os.access(path, os.X_OK) and path.is_file():
            return path
    return None


def check_process() -> None:
    """Raises where this process is a fork of one that has used ballflow: its threads are not here."""
    global _used
    if os.getpid() != _owner and _used:
        raise BallflowError(
            "ballflow was used before this process was forked, and its threads did not come along",
            'start workers afresh: multiprocessing.get_context("spawn"), or "forkserver" before the first use',
        )
    _used = True


def _forked() -> None:
    global _owner
    if not _used:
        _owner = os.getpid()


os.register_at_fork(after_in_child=_forked)


def base_registry(plugins: Sequence[PathLike] = ()) -> Any:
    """ballflow's node libraries, those of $BALLFLOW_PLUGIN_PATH, and `plugins` (files or folders)."""
    key = tuple(os.fspath(plugin) for plugin in plugins)
    state = _python_files(key)
    with _lock:
        known = _registries.get(key)
        if known is None or known[0] != state:
            if state:
                os.environ.setdefault("BALLFLOW_PYTHON", sys.executable)
            known = (state, _core.load_registry(list(key), str(library_folder())))
            _registries[key] = known
            _with_nodes.pop(key, None)
            _artifact.declare(json.loads(text) for text in known[1].types())
        return known[1]


def _python_files(plugins: Iterable[str]) -> list[tuple[str, int, int]]:
    """The state of the files of nodes in Python, and of what is beside them: they are edited while this lives."""
    folders = {Path(plugin).absolute().parent for plugin in plugins if plugin.endswith(".py")}
    files = [(path, path.stat()) for folder in sorted(folders) for path in sorted(folder.glob("*.py"))]
    return [(str(path), stat.st_mtime_ns, stat.st_size) for path, stat in files]


def registry(plugins: Sequence[PathLike] = ()) -> Any:
    """The same with the nodes that were written in Python in this process."""
    base = base_registry(plugins)
    from . import _local_nodes

    nodes = _local_nodes.current()
    if not nodes:
        return base
    key = tuple(os.fspath(plugin) for plugin in plugins)
    with _lock:
        known = _with_nodes.get(key)
        if known is None or known[0] != nodes:
            known = (nodes, base.with_nodes([_local_nodes.entry(node) for node in nodes]))
            _with_nodes[key] = known
        return known[1]


def store(cache: Cache = None, upstream: Optional[PathLike] = None, upstream_read_only: bool = False) -> Any:
    """The open cache: a folder, None for that of the command line ($BALLFLOW_CACHE), False for none. Behind it
    ``upstream``, None for $BALLFLOW_UPSTREAM."""
    if cache is False:
        if upstream is not None:
            raise UsageError(
                "upstream needs the cache that cache=False forbids",
                "what comes from an upstream lies in the cache before it is used; leave one of them out",
            )
        return _core.open_store("", "", False)
    root = os.path.abspath(os.fspath(cache)) if not isinstance(cache, bool) and cache is not None else ""
    root = root or _core.default_cache()
    place = os.fspath(upstream) if upstream is not None else os.environ.get("BALLFLOW_UPSTREAM", "")
    key = (root, place, bool(upstream_read_only))
    with _lock:
        found = _stores.get(key)
        if found is None or not os.path.isdir(root):
            found = _core.open_store(*key)
            _stores[key] = found
        return found


def graphs_folder() -> str:
    """The folder of the graphs that come with ballflow."""
    return str(share_folder() / "graphs")


def graph_file(graph: PathLike) -> str:
    """The file of a graph: a path, or the name of one that comes with ballflow. A file that is there wins."""
    return _core.find_graph(os.fspath(graph), graphs_folder())


def _seal(name: str, arrays: dict[str, Any]) -> Any:
    return base_registry().make(name, arrays)


_artifact.Artifact._seal = staticmethod(_seal)

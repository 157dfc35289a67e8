"""The process in which the engine runs nodes of a Python file: ``python3 _worker.py PARENT``.

It talks with the engine over the socket that it gets as descriptor 3, in lines of JSON; a line that comes with
arrays comes with a file in memory (a memfd) that holds them. What the file prints goes to the engine, too,
through descriptors 1 and 2, and becomes messages of the node that runs.

    engine: {"file": PATH, "types": [declarations of artifact types]}                            once, first
    worker: {"nodes": [{"declaration": {...}, "digest": HEX}, ...], "version": "Python 3.11.2"}
        or  {"refused": "why"}                                                              and ends itself
    engine: {"number": N, "run": ID, "params": {...}, "seed": n, "threads": n, "memory": n,
             "inputs": {PORT: [ARTIFACT, ...]}}                                               + file
    worker: {"of": N, "progress": 0.5}, {"of": N, "log": TEXT}, {"of": N, "warn": TEXT} any number of these
    worker: {"of": N, "outputs": {PORT: ARTIFACT}}                                            + file
        or  {"of": N, "error": "ValueError: ... (my_nodes.py:12, in Scale)", "hint": TEXT, "trace": [LINES]}

    ARTIFACT: {"type": ID, "version": n, "summary": {...}, "arrays": [ARRAY, ...]}
    ARRAY: {"name": NAME, "dtype": "f64", "shape": [...], "offset": bytes from the start of the file}

Offsets are multiples of 64; arrays are little-endian and in C order.
"""

from __future__ import annotations

import array
import ctypes
import faulthandler
import fcntl
import importlib.abc
import importlib.machinery
import importlib.util
import io
import json
import linecache
import mmap
import os
import signal
import socket
import sys
import threading
import time
import types
import warnings
from pathlib import Path
from typing import Any, Optional, Sequence

CHANNEL = 3
CHANNEL_FROM_NOW_ON = 200  # or the next that is free: out of the way of what a function opens and closes
ALIGNMENT = 64


def end_with(parent: int) -> None:
    """Nothing of this process outlives the engine, not even a function that never returns."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None, use_errno=True).prctl(pr_set_pdeathsig, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        os._exit(1)


class Channel:
    """Lines of JSON, with files."""

    def __init__(self, descriptor: int) -> None:
        self.socket = socket.socket(fileno=fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, CHANNEL_FROM_NOW_ON))
        os.close(descriptor)
        self.text = b""
        self.files: list[int] = []
        self.lock = threading.Lock()  # a function may tell its progress from threads of its own

    def receive(self) -> tuple[Optional[dict[str, Any]], Optional[int]]:
        """The next line, and the file that came with it; None at the end."""
        parts = [self.text]
        while b"\n" not in parts[-1]:
            data, ancillary, _, _ = self.socket.recvmsg(1 << 20, socket.CMSG_SPACE(4))
            for level, kind, content in ancillary:
                if level == socket.SOL_SOCKET and kind == socket.SCM_RIGHTS:
                    descriptors = array.array("i")
                    descriptors.frombytes(content[: len(content) - len(content) % descriptors.itemsize])
                    self.files.extend(descriptors)
            if not data:
                return None, None
            parts.append(data)
        line, _, self.text = b"".join(parts).partition(b"\n")
        return json.loads(line), self.files.pop(0) if self.files else None

    def send(self, message: dict[str, Any], file: Optional[int] = None) -> None:
        data = memoryview(json.dumps(message).encode() + b"\n")
        with self.lock:
            if file is not None:
                data = data[socket.send_fds(self.socket, [data], [file]) :]
            self.socket.sendall(data)


class OwnModules(importlib.abc.MetaPathFinder):
    """Imports modules that are not installed from their source, never from a cached byte code that may be
    older than an edit of the last second, and remembers what it read: the key of a node holds it."""

    def __init__(self, source: types.ModuleType) -> None:
        self.source = source

    def find_spec(self, name: str, path: Optional[Sequence[str]], target: Any = None) -> Any:
        spec = importlib.machinery.PathFinder.find_spec(name, path, target)
        if spec is None or type(spec.loader) is not importlib.machinery.SourceFileLoader:
            return None
        if name.partition(".")[0] in sys.stdlib_module_names or self.source._installed(spec.origin):
            return None
        outer = self

        class Loader(importlib.machinery.SourceFileLoader):
            def get_code(self, fullname: str) -> Any:
                path = self.get_filename(fullname)
                content = outer.source.imported[os.path.realpath(path)] = self.get_data(path)
                return self.source_to_code(content, path)

        spec.loader = Loader(spec.loader.name, spec.loader.path)
        return spec


class Absent:
    """Stands for what of the package a file of nodes may name, and cannot use where nodes run."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        raise RuntimeError(f"ballflow.{self._name} is not there while a node is made or runs")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return Absent(f"{self._name}.{name}")


def make_package() -> types.ModuleType:
    """``ballflow`` as files of nodes see it here: types and the decorator, without the engine."""
    package = types.ModuleType("ballflow")
    package.__path__ = [str(Path(__file__).parent)]
    package.__spec__ = importlib.machinery.ModuleSpec("ballflow", None, is_package=True)
    sys.modules["ballflow"] = package
    from ballflow import _artifact, _node

    for name in (*_node.__all__, "Artifact"):
        setattr(package, name, getattr(_artifact if name == "Artifact" else _node, name))

    def look_up(name: str) -> Any:
        if name.startswith("_"):  # and its own modules, which are then imported
            raise AttributeError(f"module 'ballflow' has no attribute {name!r}")
        return _artifact.class_named(name) or Absent(name)

    setattr(package, "__getattr__", look_up)
    return package


class Refused(Exception):
    pass


def load(file: str) -> dict[str, Any]:
    """Imports the file; its nodes by id. Raises Refused that says what is wrong with it."""
    from ballflow import _failures, _node, _source

    folder, base = os.path.split(file)
    sys.path[0] = folder
    sys.meta_path.insert(0, OwnModules(_source))
    name = base[: -len(".py")]
    if name in sys.modules or name in sys.stdlib_module_names:
        raise Refused(f"has the name of the module {name} of Python: rename it")
    try:
        content = Path(file).read_bytes()
    except OSError as problem:
        raise Refused(f"cannot be read: {problem.strerror}") from None
    module = types.ModuleType(name)
    module.__file__ = file
    sys.modules[name] = module
    try:
        code = compile(content, file, "exec", dont_inherit=True)
        lines = importlib.util.decode_source(content).splitlines(keepends=True)
        linecache.cache[file] = (len(content), None, lines, file)
        exec(code, module.__dict__)
    except BaseException as problem:
        raise Refused(f"cannot be imported: {_failures.failure_of(problem, file)[0]}") from None
    nodes: dict[str, Any] = {}
    for node in _node.registered():
        if node._ballflow_function.__globals__ is not module.__dict__:
            continue  # of a file that it imports
        if node.id in nodes:
            places = [_source.location(one._ballflow_function) for one in (nodes[node.id], node)]
            raise Refused(f"declares the node {node.id} twice, {places[0]} and {places[1]}")
        nodes[node.id] = node
    if not nodes:
        raise Refused("declares no node: decorate a function with @ballflow.node(...)")
    return nodes


def read_artifact(json: dict[str, Any], memory: Any) -> Any:
    import numpy as np
    from ballflow import _artifact

    arrays = {}
    for item in json["arrays"]:
        dtype = _artifact.DTYPES[item["dtype"]]
        count = 1
        for length in item["shape"]:
            count *= length
        if count == 0:
            values = np.empty(item["shape"], dtype)
        else:
            values = np.frombuffer(memory, dtype, count, item["offset"]).reshape(item["shape"])
        values.flags.writeable = False
        arrays[item["name"]] = values
    return _artifact.Artifact._of(json["type"], json["version"], arrays, json["summary"])


def write_artifacts(outputs: dict[str, Any]) -> tuple[dict[str, Any], int]:
    """The artifacts as JSON, and a file with their arrays."""
    from ballflow import _artifact

    names = {dtype: name for name, dtype in _artifact.DTYPES.items()}
    file = os.memfd_create("ballflow outputs", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    end = 0
    described = {}
    for port, artifact in outputs.items():
        arrays = []
        for name, values in artifact.arrays.items():
            shape = list(values.shape)
            values = values.astype(values.dtype.newbyteorder("<"), order="C", copy=False)
            end += -end % ALIGNMENT
            arrays.append({"name": name, "dtype": names[values.dtype], "shape": shape, "offset": end})
            rest = memoryview(values.reshape(-1)).cast("B") if values.size else memoryview(b"")
            while rest:
                written = os.pwrite(file, rest, end)
                end += written
                rest = rest[written:]
        described[port] = {"type": artifact.type, "version": artifact.version, "arrays": arrays}
    return described, file


class Run:
    """What a node that runs says to the engine."""

    def __init__(self, request: dict[str, Any], channel: Channel) -> None:
        self.threads = request["threads"]
        self.memory_bytes = request["memory"]
        self.seed = request["seed"]
        self.number = request["number"]
        self.channel = channel
        self.told = 0.0

    def send(self, message: dict[str, Any], file: Optional[int] = None) -> None:
        self.channel.send({"of": self.number, **message}, file)

    def cancelled(self) -> bool:
        return False  # the engine ends the process

    def progress(self, fraction: float) -> None:
        if time.monotonic() - self.told > 0.02:  # no oftener than somebody looks
            self.told = time.monotonic()
            self.send({"progress": fraction})

    def log(self, text: str, warning: bool) -> None:
        self.send({"warn" if warning else "log": text})


def run(node: Any, request: dict[str, Any], file: Optional[int], channel: Channel, path: str) -> None:
    from ballflow import _failures

    memory: Any = b""
    if file is not None:
        if os.fstat(file).st_size:
            memory = mmap.mmap(file, 0, prot=mmap.PROT_READ)
        os.close(file)
    told = Run(request, channel)

    def show(message: Any, category: Any, filename: str, line: int, *rest: Any) -> None:
        told.log(f"{category.__name__}: {message} ({os.path.basename(filename)}:{line})", True)

    answer: dict[str, Any]
    outputs: Optional[int] = None
    try:
        inputs = {
            port: [read_artifact(artifact, memory) for artifact in artifacts]
            for port, artifacts in request["inputs"].items()
        }
        with warnings.catch_warnings():
            warnings.simplefilter("always")  # what is warned of does not depend on what ran here before
            for category in (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning):
                warnings.simplefilter("ignore", category)
            setattr(warnings, "showwarning", show)
            described, outputs = write_artifacts(node.call(inputs, request["params"], told))
        answer = {"outputs": described}
    except BaseException as problem:
        cause, hint = _failures.failure_of(problem, path)
        answer = {"error": cause, "hint": hint, "trace": _failures.trace_of(problem)}
    sys.stdout.flush()
    sys.stderr.flush()
    told.send(answer, outputs)
    if outputs is not None:
        os.close(outputs)


def main() -> None:
    end_with(int(sys.argv[1]))
    sys.argv[1:] = []
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace", line_buffering=True)
    faulthandler.enable()
    channel = Channel(CHANNEL)
    setup, _ = channel.receive()
    if setup is None:
        return
    path = setup["file"]
    try:
        if sys.version_info < (3, 10):
            raise Refused(f"needs Python 3.10 or later, {sys.executable} is {sys.version.split()[0]}")
        try:
            import numpy  # noqa: F401
        except ImportError:
            raise Refused(f"needs numpy, which {sys.executable} does not have") from None
        make_package()
        from ballflow import _artifact

        _artifact.declare(setup["types"])
        nodes = load(path)
        try:
            listed = [{"declaration": n.declaration, "digest": n.digest} for n in nodes.values()]
        except (ValueError, OSError) as problem:
            raise Refused(f"cannot be used: {problem}") from None
    except Refused as why:
        sys.stdout.flush()
        sys.stderr.flush()
        channel.send({"refused": str(why)})
        return
    channel.send({"nodes": listed, "version": f"Python {sys.version.split()[0]}"})
    while True:
        request, file = channel.receive()
        if request is None:
            return
        run(nodes[request["run"]], request, file, channel, path)


if __name__ == "__main__":
    main()

"""The extension over the engine (tools/python/src/module.cpp); the package around it is what is documented."""

from typing import Any, Callable, Mapping, Optional, Sequence

from numpy.typing import NDArray

version: str

class Artifact:
    type: str
    version: int
    summary: str
    bytes: int
    digest: str
    def arrays(self) -> dict[str, NDArray[Any]]: ...
    def save(self, path: str, format: str) -> None: ...

class Registry:
    def types(self) -> list[str]: ...
    def nodes(self) -> list[str]: ...
    def with_nodes(self, nodes: Sequence[tuple[str, str, str, Callable[..., Any]]]) -> "Registry": ...
    def make(self, type: str, arrays: Mapping[str, NDArray[Any]]) -> Artifact: ...
    def node_markdown(self, id: str) -> str: ...

class Store:
    root: str
    why: str
    upstream_notes: list[str]

class Plan:
    doc: str
    file: str
    params: dict[str, str]
    outputs: list[tuple[str, str, str, str, str]]
    interfaces: list[tuple[str, str, str, str, str]]
    variants: list[tuple[str, list[tuple[str, str]]]]
    nodes: list[tuple[str, str]]
    warnings: list[str]

class RunSettings:
    threads: int
    memory: str
    seed: int
    keep_going: bool
    strict: bool
    until: list[str]
    only: list[str]
    force: list[str]

class Run:
    id: str
    recorded: bool
    report: str
    trouble: str
    def artifact(self, path: str, port: str) -> Artifact: ...

class NodeRun:
    seed: int
    threads: int
    memory_bytes: int
    def cancelled(self) -> bool: ...
    def progress(self, fraction: float) -> None: ...
    def log(self, text: str, warning: bool) -> None: ...

def load_registry(extra: Sequence[str], installed: str) -> Registry: ...
def read_artifact(path: str) -> Artifact: ...
def export_formats(type: str) -> list[str]: ...
def extension(type: str, format: str) -> str: ...
def open_store(root: str, upstream: str, upstream_read_only: bool) -> Store: ...
def default_cache() -> str: ...
def find_graph(text: str, folder: str) -> str: ...
def shipped_graphs(folder: str) -> list[tuple[str, str, str]]: ...
def outline(
    file: str, text: Optional[str] = None
) -> tuple[str, list[tuple[str, str, str, Optional[str]]], list[tuple[str, str]]]: ...
def load_plan(
    registry: Registry,
    file: str,
    text: Optional[str],
    settings: Sequence[tuple[str, str]],
    axes: Sequence[tuple[str, str]],
    inputs: Sequence[str],
    given: Mapping[str, Artifact],
    store: Store,
) -> Plan: ...
def run(
    plan: Plan,
    store: Store,
    settings: RunSettings,
    cache_size: str,
    command: str,
    progress: Optional[Callable[[dict[str, Any]], Any]],
) -> Run: ...

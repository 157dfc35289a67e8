"""Nodes written in Python: the decorator, and what it makes of a function.

    import ballflow as bf

    @bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
    def Scale(balls, factor: float = 2.0):
        "Multiplies every radius."
        return bf.Balls(balls.centers, balls.radii * factor)

Nothing here needs the engine: it runs in the processes that execute nodes of files, too.
"""

from __future__ import annotations

import inspect
import re
import types
import typing
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Callable, Literal, Mapping, Optional, Union

from . import _source
from ._artifact import Artifact, class_named
from ._errors import Cancelled

NodeJson = dict[str, Any]


class Unit(str):
    """The unit of a number, in ``Annotated[float, Unit("mm")]``; "" for a ratio or a count."""


@dataclass(frozen=True)
class Range:
    """Which numbers a parameter may have, in ``Annotated[float, Range(0, 1)]``.

    minimum, maximum: the smallest and the largest; None where there is no end.
    above, below: the same where the end itself is refused.
    """

    minimum: Optional[float] = None
    maximum: Optional[float] = None
    above: Optional[float] = None
    below: Optional[float] = None


class Context:
    """What a running node may ask and tell: a parameter of the function with this annotation gets it.

    threads: how many threads the node may use. Results must not depend on it.
    memory_bytes: what all nodes of the run may take together; 0 when nobody has said.
    """

    def __init__(self, run: Any, uses_seed: bool) -> None:
        self.threads: int = getattr(run, "threads", 1)
        self.memory_bytes: int = getattr(run, "memory_bytes", 0)
        self._seed: Optional[int] = getattr(run, "seed", 0) if uses_seed else None
        self._run = run

    @property
    def seed(self) -> int:
        """The seed of the run, of a node that says ``@node(seed=True)``: only then it is part of the key."""
        if self._seed is None:
            raise AttributeError("the node does not say that it uses the seed: write @node(..., seed=True)")
        return self._seed

    def progress(self, fraction: float) -> None:
        """How much is done, 0 to 1. A good place to be stopped at: raises Cancelled when the run is to end."""
        if self._run.cancelled():
            raise Cancelled()
        self._run.progress(float(fraction))

    def log(self, text: object) -> None:
        """A line for who watches the run. It is not kept with the result."""
        self._run.log(str(text), False)

    def warn(self, text: object) -> None:
        """A line that is kept with the result, and shown whenever it is used again."""
        self._run.log(str(text), True)

    def cancelled(self) -> bool:
        """Whether the run is to end."""
        return bool(self._run.cancelled())


_registered: list["NodeFunction"] = []


def registered() -> list["NodeFunction"]:
    """Every function that was decorated, in order; of two with one id the later counts (a cell that ran again)."""
    return list(_registered)


_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_ID = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z_][A-Za-z0-9_]*)*\Z")


def _stripped(annotation: Any) -> tuple[Any, list[Any]]:
    """Annotated[float, a, b] -> float, [a, b]"""
    if typing.get_origin(annotation) is Annotated:
        inner, *extras = typing.get_args(annotation)
        return inner, extras
    return annotation, []


def _without_none(annotation: Any) -> tuple[Any, bool]:
    """Optional[X] -> X, True"""
    if typing.get_origin(annotation) in (Union, types.UnionType):
        rest = [part for part in typing.get_args(annotation) if part is not type(None)]
        if len(rest) == 1:
            return rest[0], True
    return annotation, False


def _is_artifact(annotation: Any) -> bool:
    inner, _ = _without_none(_stripped(annotation)[0])
    if typing.get_origin(inner) is list and typing.get_args(inner):
        inner = typing.get_args(inner)[0]
    return isinstance(inner, type) and issubclass(inner, Artifact)


class _Declaring:
    """Reads one function; complaints say which, and where it is."""

    def __init__(self, function: types.FunctionType, id: str) -> None:
        self.function = function
        self.id = id
        self.doc = inspect.cleandoc(function.__doc__ or "")

    def wrong(self, why: str) -> TypeError:
        return TypeError(f"node {self.id} ({_source.location(self.function)}): {why}")

    def doc_of(self, name: str) -> str:
        """What the docstring says in a line "name: text" or ":param name: text"."""
        found = re.search(rf"^\s*(?::param\s+)?{re.escape(name)}\s*:\s*(\S.*)$", self.doc, re.MULTILINE)
        return found.group(1).strip() if found else ""

    def port(self, name: str, value: Any, output: bool) -> NodeJson:
        what = f"output {name!r}" if output else f"input {name!r}"
        if not isinstance(name, str) or not _NAME.match(name):
            raise self.wrong(f"{what} has no name of letters, digits and _")
        doc = ""
        if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str):
            value, doc = value
        value, extras = _stripped(value)
        doc = next((extra for extra in extras if type(extra) is str), doc) or self.doc_of(name)
        value, optional = _without_none(value)
        is_list = typing.get_origin(value) is list and len(typing.get_args(value)) == 1
        if is_list:
            value = typing.get_args(value)[0]
        if isinstance(value, str):
            if class_named(value) is None:
                raise self.wrong(f"{what} has the type {value!r}, which no node library declares")
            value = class_named(value)
        declared = value.TYPE if isinstance(value, type) and issubclass(value, Artifact) else None
        if declared is None:
            raise self.wrong(f"{what} is {value!r}, must be an artifact type like ballflow.Balls")
        if output and (optional or is_list):
            raise self.wrong(f"{what} is optional or a list; only inputs may be")
        json: NodeJson = {"name": name, "type": declared["id"], "type_version": declared["version"], "doc": doc}
        if optional:
            json["optional"] = True
        if is_list:
            json["list"] = True
        return json

    def param(self, parameter: inspect.Parameter, annotation: Any) -> NodeJson:
        name = parameter.name
        default = parameter.default
        annotation, extras = _stripped(annotation)
        if annotation is inspect.Parameter.empty and default is not inspect.Parameter.empty:
            annotation = type(default)
        json: NodeJson = {"name": name, "doc": self.doc_of(name)}
        kinds = {float: "number", int: "integer", bool: "boolean", str: "string"}
        if isinstance(annotation, type) and issubclass(annotation, Path):
            json["kind"] = "file"
        elif typing.get_origin(annotation) is Literal:
            choices = typing.get_args(annotation)
            if not all(isinstance(choice, str) for choice in choices):
                raise self.wrong(f"parameter {name!r} has choices that are no texts")
            json["kind"] = "choice"
            json["choices"] = [{"value": choice, "doc": ""} for choice in choices]
        elif isinstance(annotation, type) and annotation in kinds:
            json["kind"] = kinds[annotation]
        else:
            found = "nothing" if annotation is inspect.Parameter.empty else repr(annotation)
            raise self.wrong(
                f"parameter {name!r} is annotated with {found}, must be float, int, bool, str, "
                "typing.Literal of texts, or pathlib.Path; or name it among the inputs"
            )
        for extra in extras:
            if isinstance(extra, Unit):
                json["unit"] = str(extra)
            elif isinstance(extra, str):
                json["doc"] = extra
            elif isinstance(extra, Range):
                ends = {
                    "minimum": extra.minimum,
                    "maximum": extra.maximum,
                    "exclusive_minimum": extra.above,
                    "exclusive_maximum": extra.below,
                }
                json |= {key: end for key, end in ends.items() if end is not None}
        if default is inspect.Parameter.empty:
            json["required"] = True
        elif json["kind"] == "number" and isinstance(default, (int, float)) and not isinstance(default, bool):
            json["default"] = float(default)
        elif json["kind"] == "file" and isinstance(default, Path):
            json["default"] = str(default)
        elif isinstance(default, (str, bool, int)):
            json["default"] = default
        else:
            raise self.wrong(f"parameter {name!r} has the default {default!r}, which is no {json['kind']}")
        return json


class NodeFunction:
    """A function that is a node. Called, it is the function; in a graph it is known by its `id`.

    id: the type of the node in graphs.
    declaration: what the engine is told, as JSON (see node_decl.hpp).
    digest: what the function is made of (see _source.py), part of the key of its results.
    file: where the function is.
    """

    def __init__(
        self,
        function: types.FunctionType,
        inputs: Optional[Mapping[str, Any]],
        outputs: Union[None, Mapping[str, Any], type[Artifact]],
        id: Optional[str],
        version: int,
        seed: bool,
    ) -> None:
        self._ballflow_function = function
        self.__wrapped__ = function
        self.__doc__ = function.__doc__
        self.__name__ = function.__name__
        self.__qualname__ = function.__qualname__
        self.__module__ = function.__module__
        self.id = function.__name__ if id is None else id
        self.file = function.__code__.co_filename
        self._digest: Optional[tuple[str, dict[str, str]]] = None
        self._context: Optional[str] = None
        self._paths: list[str] = []
        self._floats: list[str] = []
        self._declaration = self._declare(inputs, outputs, version, seed)
        _source.remember(function)

    def _declare(self, inputs: Any, outputs: Any, version: int, seed: bool) -> NodeJson:
        function = self._ballflow_function
        reading = _Declaring(function, self.id)
        if not _ID.match(self.id):
            raise reading.wrong("its id has to be letters, digits and _, with a namespace in front: acme.Scale")
        if isinstance(version, bool) or not isinstance(version, int) or version < 1:
            raise reading.wrong(f"its version is {version!r}, must be 1, 2, ...")
        try:
            hints = typing.get_type_hints(function, include_extras=True)
        except Exception as problem:
            raise reading.wrong(f"its annotations cannot be read: {problem}") from None
        signature = inspect.signature(function)
        for parameter in signature.parameters.values():
            if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD, parameter.POSITIONAL_ONLY):
                raise reading.wrong(f"parameter {parameter.name!r} has no name to give it by (*, ** or /)")
        if inputs is None:
            inputs = {
                name: hints[name] for name in signature.parameters if name in hints and _is_artifact(hints[name])
            }
        if outputs is None:
            outputs = hints.get("return")
        if _is_artifact(outputs):
            alone = _without_none(_stripped(outputs)[0])[0]
            alone = (typing.get_args(alone) or (alone,))[0]  # of a list, which is refused below
            outputs = {alone.__name__.lower(): outputs}
        if not isinstance(inputs, Mapping) or not isinstance(outputs, Mapping) or not outputs:
            raise reading.wrong('inputs and outputs are dicts of names and types: {"balls": ballflow.Balls}')
        missing = [name for name in inputs if name not in signature.parameters]
        if missing:
            raise reading.wrong(f"input {missing[0]!r} is no parameter of the function")
        params = []
        for name, parameter in signature.parameters.items():
            annotation = hints.get(name, parameter.annotation)
            if name in inputs:
                continue
            if _stripped(annotation)[0] is Context:
                self._context = name
                continue
            json = reading.param(parameter, annotation)
            if json["kind"] == "file":
                self._paths.append(name)
            if json["kind"] == "number":
                self._floats.append(name)
            params.append(json)
        ports = [reading.port(name, value, False) for name, value in inputs.items()]
        for port in ports:  # a default of None says that the input may be left out
            if signature.parameters[port["name"]].default is None and "list" not in port:
                port["optional"] = True
        summary, _, doc = reading.doc.partition("\n")
        return {
            "id": self.id,
            "version": version,
            "summary": summary or f"A function of {_source.location(function)}, without a docstring.",
            "doc": doc.strip(),
            "uses_seed": bool(seed),
            # A process with numpy; its inputs in memory that it shares, and outputs of about their size.
            "memory": {"fixed": 40e6, "per_input_byte": 2.0},
            "inputs": ports,
            "outputs": [reading.port(name, value, True) for name, value in outputs.items()],
            "params": params,
        }

    def _keyed(self) -> tuple[str, dict[str, str]]:
        if self._digest is None or _source.is_interactive(self._ballflow_function):
            self._digest = _source.digest(self._ballflow_function, self._declaration["version"])
        return self._digest

    @property
    def declaration(self) -> NodeJson:
        """A dict, as plugins hand it over; it names the versions of Python and of installed packages used.

        Raises ValueError where something that the function names cannot be part of a key."""
        return {**self._declaration, "libraries": self._keyed()[1]}

    @property
    def digest(self) -> str:
        """64 hexadecimal digits; raises ValueError like `declaration`."""
        return self._keyed()[0]

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return self._ballflow_function(*args, **kwargs)

    def __repr__(self) -> str:
        return f"<node {self.id} of {_source.location(self._ballflow_function)}>"

    def call(self, inputs: Mapping[str, Any], params: Mapping[str, Any], run: Any) -> dict[str, Artifact]:
        """Runs the function as the engine does.

        inputs: the artifacts that are connected, a list for every port.
        params: every declared parameter, numbers perhaps as ints and files as texts.
        run: how the engine is asked and told: cancelled(), progress(fraction), log(text, warning), and where it
            knows them threads, memory_bytes and seed.

        The outputs by port. Raises TypeError where the function returned something else, and whatever the
        function raises.
        """
        arguments: dict[str, Any] = dict(params)
        signature = inspect.signature(self._ballflow_function)
        for port in self._declaration["inputs"]:
            name = port["name"]
            connected = list(inputs.get(name, ()))
            if port.get("list"):
                arguments[name] = connected
            elif connected:
                arguments[name] = connected[0]
            elif signature.parameters[name].default is inspect.Parameter.empty:
                arguments[name] = None
        for name in self._floats:
            arguments[name] = float(arguments[name])
        for name in self._paths:
            arguments[name] = Path(arguments[name])
        if self._context is not None:
            arguments[self._context] = Context(run, self._declaration["uses_seed"])
        return self._outputs(self._ballflow_function(**arguments))

    def _outputs(self, result: Any) -> dict[str, Artifact]:
        ports = self._declaration["outputs"]
        names = [port["name"] for port in ports]
        if isinstance(result, dict):
            named = dict(result)
        elif isinstance(result, (tuple, list)):
            if len(result) != len(ports):
                raise TypeError(f"{self.id} returned {len(result)} results, it has {len(ports)} outputs: "
                                f"{', '.join(names)}")
            named = dict(zip(names, result))
        elif len(ports) == 1:
            named = {names[0]: result}
        else:
            raise TypeError(f"{self.id} returned {_named(result)}, must be a dict or a tuple of its outputs "
                            f"{', '.join(names)}")
        for name in named:
            if name not in names:
                raise TypeError(f"{self.id} returned {name!r}, which is none of its outputs {', '.join(names)}")
        for port in ports:
            value = named.get(port["name"])
            if not isinstance(value, Artifact) or value.type != port["type"]:
                raise TypeError(
                    f"{self.id} returned {_named(value)} for its output {port['name']!r}, must be ballflow."
                    f"{port['type']}"
                )
        return {name: named[name] for name in names}


def _named(value: Any) -> str:
    if value is None:
        return "nothing"
    return f"a {value.type if isinstance(value, Artifact) else type(value).__name__}"


def node(
    function: Optional[Callable[..., Any]] = None,
    *,
    inputs: Optional[Mapping[str, Any]] = None,
    outputs: Union[None, Mapping[str, Any], type[Artifact]] = None,
    id: Optional[str] = None,
    version: int = 1,
    seed: bool = False,
) -> Any:
    """Makes a node of a function: ``@node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})``.

    inputs: artifact types by the names of parameters; ``Optional[bf.Balls]`` may be left out, ``list[bf.Balls]``
        takes several; ``(bf.Balls, "text")`` documents. Without it, the parameters that are annotated so.
    outputs: artifact types by name. One that is returned alone may be a type; without it, the annotation of
        what is returned.
    id: the type of the node in graphs, with a namespace where others may have one of its name:
        "acme.Scale". Without it the name of the function.
    version: counts in the key; the source does by itself.
    seed: the function uses Context.seed.

    All other parameters are parameters of the node: float, int, bool, str, typing.Literal of texts (a choice),
    pathlib.Path (a file, which counts by content). Annotated adds a Range, a Unit, a text. A parameter that is
    annotated with Context gets that.

    Equal inputs and parameters must give equal results: the engine runs the function once and keeps them.
    Raises TypeError that names the function and what is wrong with it.
    """

    def decorate(decorated: Any) -> NodeFunction:
        if isinstance(decorated, NodeFunction):
            raise TypeError(f"{decorated.id} is a node already")
        if not isinstance(decorated, types.FunctionType):
            raise TypeError(f"a node is made of a function, not of a {type(decorated).__name__}")
        made = NodeFunction(decorated, inputs, outputs, id, version, seed)
        _registered.append(made)
        return made

    return decorate if function is None else decorate(function)


__all__ = ["Context", "NodeFunction", "Range", "Unit", "node"]

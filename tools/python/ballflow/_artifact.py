"""Artifacts: immutable bundles of named arrays with a small summary, one class per artifact type.

The classes are made from the declarations of the types, so that those of a node library from outside look
like ballflow's own. Nothing here needs the engine: a worker process that runs nodes written in Python uses
this module alone.
"""

from __future__ import annotations

import json
from types import MappingProxyType
from typing import Any, Callable, ClassVar, Iterable, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Declaration = Mapping[str, Any]

DTYPES: Mapping[str, np.dtype[Any]] = {
    "f64": np.dtype("<f8"),
    "f32": np.dtype("<f4"),
    "i64": np.dtype("<i8"),
    "i32": np.dtype("<i4"),
    "u32": np.dtype("<u4"),
    "u16": np.dtype("<u2"),
    "u8": np.dtype("u1"),
}


def _shape_text(shape: Sequence[Any]) -> str:
    return " x ".join(str(length) for length in shape) or "one number"


def converted(value: Any, declaration: Declaration, where: str) -> NDArray[Any]:
    """The array that a declared one (of a type) becomes: its dtype, C order, native little-endian bytes.

    Takes whatever numpy makes an array of numbers of: lists, other dtypes and byte orders, Fortran order,
    any strides. The result is a copy that nobody else has. Integers must come through unchanged.

    Raises TypeError for what holds no real numbers, ValueError for a wrong shape or a number that the dtype
    cannot hold; both name `where`.
    """
    if isinstance(value, np.ma.MaskedArray):
        if np.any(np.ma.getmaskarray(value)):  # type: ignore[no-untyped-call]
            raise ValueError(f"{where} has masked entries; fill them or leave their rows out")
        value = value.data
    try:
        array = np.asarray(value)
    except Exception as problem:
        raise TypeError(f"{where} cannot be read as an array: {problem}") from None
    if array.dtype == object:
        try:
            array = array.astype(np.float64)
        except Exception as problem:
            raise TypeError(f"{where} does not hold numbers: {problem}") from None
    wanted = DTYPES[declaration["dtype"]]
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{where} holds {array.dtype}, must hold real numbers ({declaration['dtype']})")

    shape = declaration["shape"]
    if array.size == 0 and array.ndim == 1 and len(shape) > 1:
        array = array.reshape((0, *shape[1:]))  # [] is no rows of any width
    fits = array.ndim == len(shape) and all(
        not isinstance(length, int) or length == found for length, found in zip(shape, array.shape)
    )
    if not fits:
        raise ValueError(f"{where} is {_shape_text(array.shape)}, must be {_shape_text(shape)}")

    if wanted.kind in "iu" and array.dtype != wanted:
        limits = np.iinfo(wanted)
        if array.dtype.kind == "f" and not np.all(np.isfinite(array) & (array == np.floor(array))):
            raise ValueError(f"{where} has numbers that are not whole; it holds {declaration['dtype']}")
        # Compared as Python numbers: 2**64 - 1 and -1 have no common type in numpy.
        if array.size and (int(array.min()) < limits.min or int(array.max()) > limits.max):
            raise ValueError(f"{where} has numbers outside {limits.min} .. {limits.max} ({declaration['dtype']})")
    if wanted.itemsize < array.dtype.itemsize and wanted.kind == "f" and array.size:
        finite = array[np.isfinite(array)]
        if finite.size and float(np.abs(finite).max()) > float(np.finfo(wanted).max):
            raise ValueError(f"{where} has numbers beyond the range of {declaration['dtype']}")
    with np.errstate(all="ignore"):
        result = np.array(array, dtype=wanted, order="C", copy=True)
    result.flags.writeable = False
    return result


class Artifact:
    """What a node made: arrays by name, and a summary. Immutable.

    Arrays are attributes (``balls.centers``) and in ``arrays``; they are read-only and, where they come from
    the engine, its own memory: nothing is copied, and the memory stays as long as an array does.
    """

    TYPE: ClassVar[Optional[Declaration]] = None

    #: Set where the engine is: makes the engine's artifact of the arrays, checked and with its summary.
    _seal: ClassVar[Optional[Callable[[str, dict[str, NDArray[Any]]], Any]]] = None

    _type: str
    _version: int
    _arrays: Mapping[str, NDArray[Any]]
    _summary: Optional[Mapping[str, Any]]
    _core: Any

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        declaration = type(self).TYPE
        if declaration is None:
            raise TypeError("an artifact has a type: make one of a class like ballflow.Balls")
        name = declaration["id"]
        declared = declaration["arrays"]
        if len(args) > len(declared):
            raise TypeError(f"{name} has {len(declared)} arrays, {len(args)} were given")
        given: dict[str, Any] = {}
        for array, value in zip(declared, args):
            given[array["name"]] = value
        names = [array["name"] for array in declared]
        for key, value in kwargs.items():
            if key not in names:
                raise TypeError(f"{name} has no array {key!r}; it has {', '.join(names)}")
            if key in given:
                raise TypeError(f"{name}: {key} was given twice")
            given[key] = value
        arrays: dict[str, NDArray[Any]] = {}
        lengths: dict[str, tuple[int, str]] = {}
        for array in declared:
            key = array["name"]
            value = given.get(key)
            if value is None:
                if array.get("optional", False):
                    continue
                raise TypeError(f"{name} needs the array {key} ({array.get('doc', '') or 'required'})")
            arrays[key] = converted(value, array, f"{name}.{key}")
            self._compare_length(name, array, arrays[key], lengths)
        self._fill(name, int(declaration["version"]), arrays, None, None)
        if Artifact._seal is not None:
            core = Artifact._seal(name, arrays)
            self._fill(name, int(declaration["version"]), core.arrays(), json.loads(core.summary), core)

    @staticmethod
    def _compare_length(
        name: str, array: Declaration, value: NDArray[Any], lengths: dict[str, tuple[int, str]]
    ) -> None:
        shape = array["shape"]
        if not shape or not isinstance(shape[0], str):
            return
        symbol, _, more = shape[0].partition("+")
        length = value.shape[0] - int(more or 0)
        if length < 0:
            raise ValueError(f"{name}.{array['name']} has length {value.shape[0]}, must have {shape[0]}")
        known = lengths.setdefault(symbol, (length, array["name"]))
        if known[0] != length:
            raise ValueError(
                f"{name}.{array['name']} has length {value.shape[0]}, must have {shape[0]}: "
                f"{symbol} = {known[0]} by {name}.{known[1]}"
            )

    def _fill(
        self,
        name: str,
        version: int,
        arrays: Mapping[str, NDArray[Any]],
        summary: Optional[Mapping[str, Any]],
        core: Any,
    ) -> None:
        set_ = object.__setattr__
        set_(self, "_type", name)
        set_(self, "_version", version)
        set_(self, "_arrays", MappingProxyType(dict(arrays)))
        set_(self, "_summary", summary)
        set_(self, "_core", core)

    @classmethod
    def _of(
        cls,
        name: str,
        version: int,
        arrays: Mapping[str, NDArray[Any]],
        summary: Optional[Mapping[str, Any]],
        core: Any = None,
    ) -> "Artifact":
        """An artifact of arrays that are as its type declares them, without a copy."""
        self = object.__new__(class_named(name) or cls)
        self._fill(name, version, arrays, summary, core)
        return self

    @property
    def type(self) -> str:
        """The id of its type, "Balls"."""
        return self._type

    @property
    def version(self) -> int:
        """The version of its type."""
        return self._version

    @property
    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """Its arrays by name, read-only; arrays that are optional and absent are not in it."""
        return self._arrays

    @property
    def summary(self) -> Mapping[str, Any]:
        """A few numbers and words about it, as reports show them. Empty until the engine has seen it."""
        return self._summary if self._summary is not None else {}

    @property
    def digest(self) -> str:
        """SHA-256 of its bytes, 64 hexadecimal digits: its name in the cache."""
        if self._core is None:
            raise AttributeError("an artifact gets its digest from the engine, which has not seen this one yet")
        return str(self._core.digest)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        arrays = self._arrays
        if name in arrays:
            return arrays[name]
        declaration = type(self).TYPE
        if declaration is not None and any(array["name"] == name for array in declaration["arrays"]):
            return None  # optional, and not there
        raise AttributeError(f"{self._type} has no array {name!r}; it has {', '.join(sorted(arrays))}")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"an artifact cannot be changed: make another {self._type}")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"an artifact cannot be changed: make another {self._type}")

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *self._arrays})

    def __len__(self) -> int:
        """How many balls, points, ...: the length of the first array that has one."""
        declaration = type(self).TYPE
        names = [array["name"] for array in declaration["arrays"]] if declaration else list(self._arrays)
        for name in names:
            if name in self._arrays and self._arrays[name].ndim > 0:
                return int(self._arrays[name].shape[0])
        return 0

    def __bool__(self) -> bool:
        return True  # an empty set of balls is a result, too

    def __repr__(self) -> str:
        parts = [f"{name} {_shape_text(array.shape)} {array.dtype.name}" for name, array in self._arrays.items()]
        return f"<{self._type}: {', '.join(parts) or 'no arrays'}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Artifact):
            return NotImplemented
        if self._core is not None and other._core is not None:
            return bool(self._core.digest == other._core.digest)
        return (
            self._type == other._type
            and self._arrays.keys() == other._arrays.keys()
            and all(
                array.shape == other._arrays[name].shape
                and array.tobytes() == other._arrays[name].tobytes()
                for name, array in self._arrays.items()
            )
        )

    def __hash__(self) -> int:
        return hash((self._type, tuple(sorted((name, array.shape) for name, array in self._arrays.items()))))

    def __reduce__(self) -> Any:
        if type(self).TYPE is None:
            raise TypeError(f"{self._type} cannot be pickled: its type is not known here")
        arrays = {name: np.array(array) for name, array in self._arrays.items()}
        return _unpickled, (self._type, arrays)

    def save(self, path: Any, format: Optional[str] = None) -> None:
        """Writes it to a file, in the format of its extension or in ``format``; ``formats`` lists them.

        safetensors is the artifact itself, which graphs and the command line take as a parameter.
        """
        import os

        self._engine("writes artifacts").save(os.fspath(path), format or "")

    @property
    def formats(self) -> list[str]:
        """The formats it can be saved in, the usual one first."""
        self._engine("knows formats")
        from . import _core

        return list(_core.export_formats(self._type))

    def _engine(self, does: str) -> Any:
        if self._core is None:
            raise RuntimeError(f"only the engine {does}, and it is not loaded in this process")
        return self._core


def _unpickled(name: str, arrays: dict[str, NDArray[Any]]) -> Artifact:
    cls = class_named(name)
    if cls is None:
        import ballflow  # declares the types

        cls = getattr(ballflow, name)
    return cls(**arrays)


_classes: dict[str, type[Artifact]] = {}


def _doc(declaration: Declaration) -> str:
    lines = [declaration["doc"], "", "Arrays (attributes, in this order arguments of the constructor):", ""]
    for array in declaration["arrays"]:
        shape = _shape_text(array["shape"])
        optional = ", optional" if array.get("optional", False) else ""
        lines.append(f"    {array['name']}: {shape} {array['dtype']}{optional}: {array.get('doc', '')}")
    if declaration.get("summary"):
        lines += ["", "Summary:", ""]
        lines += [f"    {field['name']}: {field['doc']}" for field in declaration["summary"]]
    return "\n".join(lines)


def declare(declarations: Iterable[Declaration]) -> None:
    """Makes the classes of artifact types from what node libraries declare."""
    for declaration in declarations:
        name = declaration["id"]
        known = _classes.get(name)
        if known is not None and known.TYPE == declaration:
            continue
        _classes[name] = type(
            name.rsplit(".", 1)[-1],
            (Artifact,),
            {"TYPE": declaration, "__doc__": _doc(declaration), "__module__": "ballflow"},
        )


def class_named(name: str) -> Optional[type[Artifact]]:
    """The class of an artifact type, "Balls"; None when nobody has declared it."""
    return _classes.get(name)


def class_names() -> list[str]:
    """The ids of all artifact types that are declared."""
    return sorted(_classes)


__all__ = ["Artifact", "ArrayLike", "class_named", "class_names", "converted", "declare"]

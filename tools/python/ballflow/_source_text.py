"""Texts of what a function written in Python is made of: code without comments and layout, and plain data. What
`_source` puts together and makes a digest of."""

from __future__ import annotations

import ast
import dis
import functools
import hashlib
import importlib.util
import linecache
import os
import re
import types
from pathlib import Path, PurePath
from typing import Any, Iterator, Optional

import numpy as np

#: Source text of files as it was when their nodes were made; a file may be edited afterwards.
texts: dict[str, str] = {}
#: Content of modules of one's own as they were imported, by path, where an importer has told.
imported: dict[str, bytes] = {}
#: The same as it was when it was first looked at, and the module as it was then: a reload makes another spec.
contents: dict[str, tuple[Any, bytes]] = {}


def content_of(path: Path, spec: Any) -> bytes:
    real = os.path.realpath(path)
    if real in imported:
        return imported[real]
    known = contents.get(real)
    if known is None or known[0] is not spec:
        known = contents[real] = (spec, path.read_bytes())
    return known[1]


def text_of(filename: str, names: dict[str, Any]) -> str:
    if filename not in texts:
        texts[filename] = "".join(linecache.getlines(filename, names))
    return texts[filename]


@functools.lru_cache(maxsize=64)
def parsed(text: str) -> Optional[ast.Module]:
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError):
        return None


def normal(text: bytes) -> str:
    try:
        return ast.unparse(ast.parse(text))
    except (SyntaxError, ValueError):
        return hashlib.sha256(text).hexdigest()


def code_text(code: types.CodeType) -> str:
    """Of a function without a source file: its byte code, which differs between versions of Python."""
    parts = [code.co_code.hex(), repr(code.co_names), repr(code.co_varnames), repr(code.co_freevars)]
    for constant in code.co_consts:
        inner = isinstance(constant, types.CodeType)
        parts.append(code_text(constant) if inner else plain(constant) or repr(constant))
    return "\n".join(parts)


def function_text(function: types.FunctionType) -> str:
    code = function.__code__
    tree = parsed(text_of(code.co_filename, function.__globals__))
    found = []
    for node in ast.walk(tree) if tree is not None else ():
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            first = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
            if node.name == code.co_name and first == code.co_firstlineno:
                found.append(ast.unparse(node))
        elif isinstance(node, ast.Lambda) and code.co_name == "<lambda>" and node.lineno == code.co_firstlineno:
            found.append(ast.unparse(node))
    return "\n".join(found) if found else importlib.util.MAGIC_NUMBER.hex() + code_text(code)


def globals_of(code: types.CodeType) -> set[str]:
    """The globals that a function names, and those that functions inside it do."""
    names = {
        instruction.argval
        for instruction in dis.get_instructions(code)
        if instruction.opname in ("LOAD_GLOBAL", "LOAD_NAME", "LOAD_FROM_DICT_OR_GLOBALS")
    }
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            names |= globals_of(constant)
    return names


def imports_of(tree: ast.AST, package: str) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            if node.level:
                parts = package.split(".")
                start = ".".join(parts[: len(parts) - node.level + 1])
                module = f"{start}.{module}".strip(".")
            if module:
                yield module
                yield from (f"{module}.{alias.name}" for alias in node.names)


def plain(value: Any, depth: int = 0) -> Optional[str]:
    """Canonical text of plain data; None for anything else."""
    if depth > 50:
        return None
    kind = type(value)
    if value is None or kind in (bool, int, str, bytes, complex) or value is Ellipsis:
        return repr(value)
    if kind is float:
        return str(value.hex())
    if kind in (tuple, list, set, frozenset, dict):
        parts = [x for item in value.items() for x in item] if kind is dict else list(value)
        texts = [plain(part, depth + 1) for part in parts]
        known = [text for text in texts if text is not None]
        if len(known) != len(texts):
            return None
        return f"{kind.__name__}({', '.join(sorted(known) if kind in (set, frozenset) else known)})"
    if isinstance(value, np.ndarray) and not value.dtype.hasobject:
        digest = hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()
        return f"array({value.dtype.str}, {value.shape}, {digest})"
    if isinstance(value, np.generic) and not isinstance(value, np.object_):
        return f"{value.dtype.str}({value.tobytes().hex()})"
    if isinstance(value, PurePath):
        return f"path({str(value)!r})"
    if isinstance(value, re.Pattern):
        return f"pattern({value.pattern!r}, {value.flags})"
    if kind is range or isinstance(value, np.dtype):
        return repr(value)
    return None

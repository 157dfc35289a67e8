"""Declarations of nodes, and what Python's help() says of them."""

from __future__ import annotations

import difflib
import json
from typing import Any, Mapping, Optional

from . import _session

_parsed: dict[int, tuple[Any, dict[str, Any]]] = {}


def declarations() -> Mapping[str, Any]:
    """All node types by id, as their libraries declare them."""
    registry = _session.registry()
    key = id(registry)
    found = _parsed.get(key)
    if found is None or found[0] is not registry:
        _parsed.clear()
        found = (registry, {one["id"]: one for one in map(json.loads, registry.nodes())})
        _parsed[key] = found
    return found[1]


def declaration(name: str) -> Optional[Any]:
    """The declaration of a node type; None when there is none."""
    return declarations().get(name)


def keyword_of(declared: Mapping[str, Any], param: str) -> str:
    """The keyword of a parameter: its name, with "_" behind it where an input has that name."""
    return param + "_" if any(port["name"] == param for port in declared["inputs"]) else param


def unknown(name: str) -> str:
    """The message for a node type that is not there."""
    near = difflib.get_close_matches(name, list(declarations()), 3)
    hint = f"; did you mean {' or '.join(near)}?" if near else ""
    return f"there is no node type {name!r}{hint}"


def _range(param: Mapping[str, Any]) -> str:
    words = []
    for key, sign in (("minimum", ">="), ("exclusive_minimum", ">"), ("maximum", "<="), ("exclusive_maximum", "<")):
        if param.get(key) is not None:
            words.append(f"{sign} {param[key]}")
    return ", ".join(words)


def doc_of(declared: Mapping[str, Any]) -> str:
    """What help() says: ports with their types, parameters with units and ranges, sources."""
    lines = [declared["summary"]]
    if declared.get("doc"):
        lines += ["", declared["doc"]]
    if declared.get("avoid_when"):
        lines += ["", f"When not to use it: {declared['avoid_when']}"]
    for title, ports in (("Inputs", declared["inputs"]), ("Outputs", declared["outputs"])):
        if not ports:
            continue
        lines += ["", f"{title}:"]
        for port in ports:
            more = (", several in order" if port.get("list") else "") + (", optional" if port.get("optional") else "")
            lines.append(f"    {port['name']} ({port['type']}{more}): {port.get('doc', '')}")
    if declared["params"]:
        lines += ["", "Parameters:"]
    for param in declared["params"]:
        default = "required" if param.get("required") else f"default {json.dumps(param.get('default'))}"
        facts = [fact for fact in (param["kind"], default, param.get("unit", ""), _range(param)) if fact]
        name = keyword_of(declared, param["name"])
        lines.append(f"    {name} ({', '.join(facts)}): {param.get('doc', '')}")
        for choice in param.get("choices", []):
            lines.append(f"        {choice['value']}: {choice.get('doc', '')}")
    if declared.get("cites"):
        lines += ["", "Sources: " + "; ".join(f"{cite['key']}, {cite['where']}" for cite in declared["cites"])]
    return "\n".join(lines)

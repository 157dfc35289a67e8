"""Sweeps: lists are axes."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import ballflow as bf


def test_lists_are_axes(program):
    sweep = bf.sweep("prune", input="shape:sTube", strategy=["greedy", "none"], epsilon=[0.5, 1.0])
    assert len(sweep) == 4 and {variant.status for variant in sweep} == {"ok"}
    names = [variant.name for variant in sweep]
    assert len(set(names)) == 4 and sweep[names[2]] is sweep[2]
    alone = bf.run("prune", input="shape:sTube", strategy="greedy", epsilon=1.0)
    assert not any(node.status == "run" for node in alone.nodes.values())
    same = [v for v in sweep if v.values == {"strategy": "greedy", "epsilon": 1.0}]
    assert len(same) == 1 and same[0].balls == alone.balls
    rows = sweep.rows()
    assert [row["epsilon"] for row in rows] == [variant.values["epsilon"] for variant in sweep]
    assert all(row["balls.count"] == len(v.balls) for row, v in zip(rows, sweep))


def test_files_by_a_pattern_and_arrays_in_a_list():
    for radius in (1, 2):
        with open(f"b{radius}.csv", "w") as file:
            file.write(f"x,y,z,r\n0,0,0,{radius}\n")
    sweep = bf.sweep("balls", file="b*.csv")
    assert [variant.balls.radii.tolist() for variant in sweep] == [[1], [2]]
    clouds = [np.random.default_rng(seed).normal(size=(40, 3)) for seed in (1, 2, 3)]
    points = bf.sweep("dmt_points", input=clouds)
    assert [len(variant.points) for variant in points] == [40, 40, 40]


def test_a_variant_that_fails_leaves_the_others():
    with open("bad.csv", "w") as file:
        file.write("x,y,z,r\n0,0,0,minus\n")
    with pytest.warns(bf.BallflowWarning, match="minus"):
        sweep = bf.sweep("balls", file=["balls:0 0 0 1", "bad.csv"])
    assert [variant.status for variant in sweep] == ["ok", "failed"]
    assert sweep[0].balls.radii.tolist() == [1]


def test_a_table_with_and_without_pandas(monkeypatch):
    sweep = bf.sweep("balls", file=["balls:0 0 0 1", "balls:0 0 0 2"])
    monkeypatch.setitem(sys.modules, "pandas", None)
    assert sweep.table() == sweep.rows() and len(sweep.table()) == 2
    monkeypatch.undo()
    pandas = pytest.importorskip("pandas")
    assert isinstance(sweep.table(), pandas.DataFrame) and "balls.count" in sweep.table().columns


@pytest.mark.parametrize(
    "call, kind, words",
    [
        (lambda: bf.sweep("balls", file="balls:0 0 0 1"), bf.UsageError, "nothing to sweep"),
        (lambda: bf.sweep("balls", file=[]), bf.UsageError, "without values"),
        (lambda: bf.sweep("balls", file="absent/*.csv"), bf.GraphError, "absent"),
        (lambda: bf.sweep("prune", input="shape:sTube", epsilon=[1, -1]), bf.GraphError, "at least 0"),
        (lambda: bf.sweep("balls", file=[object()]), TypeError, "file"),
    ],
)
def test_mistakes_are_named(call, kind, words):
    with pytest.raises(kind, match=words):
        call()

"""Sweeps that nothing happens to: toys, Table 3.3 of the thesis, Snakemake."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from pathlib import Path

from loopback_cluster import HERE, Cluster, digests
from toy_graphs import write_graph


def small(here: Cluster) -> None:
    """A sweep of a few seconds: equal digests, and a second submission sends nothing."""
    graph = write_graph(here.root / "graph", 4, 3, 0.01)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "4", "--watch")
    assert here.results(graph) == expected
    sent = here.arrays()
    assert sent >= 3, sent
    assert "nothing to submit" in here.submit(graph)
    assert here.arrays() == sent


def large(here: Cluster) -> None:
    """51 001 nodes."""
    graph = write_graph(here.root / "graph", 500, 50, 0)
    start = time.monotonic()
    here.submit(graph, "--unit-seconds", "200", "--dry-run")
    planned = time.monotonic() - start
    start = time.monotonic()
    here.submit(graph, "--unit-seconds", "200")
    submitted = time.monotonic() - start
    arrays = here.arrays()
    here.submit(graph, "--unit-seconds", "200", "--watch")
    ran = time.monotonic() - start
    assert here.arrays() == arrays, "nothing had to be sent twice"
    start = time.monotonic()
    assert "nothing to submit" in here.submit(graph)
    nothing = time.monotonic() - start
    print(f"51 001 nodes: planned in {planned:.1f} s, {arrays} sbatch calls, submitted in {submitted:.1f} s, "
          f"ran in {ran:.1f} s, nothing to do in {nothing:.2f} s")
    assert arrays <= 5
    assert len(here.results(graph)) == 51_001


def busy(here: Cluster) -> None:
    """Nodes of 0.1 s: how much longer than a local run on as many processors. The same with units of twice the
    length: the scheduler looks for work once a second, and until then a processor waits."""
    here.slurm("down")
    here.slurm("up", "1", "2", str(here.port))
    graph = write_graph(here.root / "graph", 4, 100, 0.1)
    start = time.monotonic()
    expected = here.local(graph, "--threads", "2")
    alone = time.monotonic() - start
    # A node of an array that never ran counts as a second, so these are units of 5 s and 10 s.
    for unit_seconds in (50, 100):
        start = time.monotonic()
        here.submit(graph, "--unit-seconds", str(unit_seconds), "--watch")
        there = time.monotonic() - start
        print(f"809 nodes, 800 of 0.1 s, units of {unit_seconds / 10:.0f} s: {alone:.1f} s here, "
              f"{there:.1f} s through Slurm, {there / alone:.2f} times as long")
        assert here.results(graph) == expected
        here.forget()


def table(here: Cluster) -> None:
    """Table 3.3 of the thesis for six models: the digests of a local run, byte for byte."""
    graph = HERE.parent.parent / "graphs/experiments/table_3_3.json"
    models = ",".join(f"shape:{name}?n=1200" for name in ("torus", "doubleTorus", "box", "sphere", "3cross", "bracket"))
    out = here.root / "table"
    here.run("sweep", str(graph), "--axis", f"input={models}", "--out", str(out), "--quiet", cache="alone")
    start = time.monotonic()
    here.submit(graph, "--axis", f"input={models}", "--unit-seconds", "20", "--watch", "--out", str(here.root / "there"))
    expected = digests(out / "report.json")
    print(f"table_3_3: {len(expected)} artifacts, {here.arrays()} sbatch calls, {time.monotonic() - start:.0f} s through Slurm")
    assert digests(here.root / "there/report.json") == expected


def real(here: Cluster) -> None:
    """Table 3.3 for six models of $BALLFLOW_TEST_DATA: the digests of a local run, byte for byte."""
    graph = HERE.parent.parent / "graphs/experiments/table_3_3.json"
    folder = Path(os.environ.get("BALLFLOW_TEST_DATA", HERE.parent.parent.parent / "shared/data")) / "models"
    names = [f"{name}.off.gz" for name in ("eight", "three_holes", "anchor_dense", "fertility", "knot2", "fandisk")]
    absent = [name for name in names if not (folder / name).exists()]
    if absent:
        print(f"real: SKIPPED, {folder / absent[0]} is not there")
        return
    models = ",".join(str(folder / name) for name in names)
    out = here.root / "table"
    start = time.monotonic()
    here.run("sweep", str(graph), "--axis", f"input={models}", "--out", str(out), "--quiet", "--threads", "2", cache="alone")
    alone = time.monotonic() - start
    start = time.monotonic()
    here.submit(graph, "--axis", f"input={models}", "--unit-seconds", "20", "--watch", "--out", str(here.root / "there"))
    expected = digests(out / "report.json")
    print(f"table_3_3 of files: {len(expected)} artifacts, {here.arrays()} sbatch calls, {alone:.0f} s here, "
          f"{time.monotonic() - start:.0f} s through Slurm")
    assert digests(here.root / "there/report.json") == expected


def snakemake(here: Cluster) -> None:
    """An exported workflow: with two local processors, resumed, and with its profile for Slurm."""
    if shutil.which("snakemake") is None:
        print("snakemake: skipped, it is not installed")
        return
    graph = write_graph(here.root / "graph", 8, 30, 0)
    expected = here.local(graph)

    def export(name: str) -> Path:
        folder = here.root / name
        here.run("export", str(graph), "--to", "snakemake", "--store", str(here.store), "-o", str(folder), "--unit-seconds", "1")
        return folder

    def snakemake(folder: Path, *words: str) -> None:
        done = subprocess.run(["snakemake", "--snakefile", folder / "Snakefile", "--directory", folder / "profile",
                               "--rerun-triggers", "mtime", *words],
                              env={**here.environment, "CI": "true"}, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr[-3000:]

    folder = export("workflow")
    units = len(list((folder / "units").iterdir()))
    assert units > 250, units
    start = time.monotonic()
    snakemake(folder, "--cores", "2")
    print(f"snakemake: {units} units in {time.monotonic() - start:.0f} s on 2 processors")
    assert here.results(graph) == expected
    lost = sorted((folder / "done").iterdir())[:3]
    for file in lost:
        file.unlink()
    snakemake(folder, "--cores", "2")
    assert all(file.exists() for file in lost)
    here.forget()
    folder = export("workflow-slurm")
    start = time.monotonic()
    snakemake(folder, "--profile", str(folder / "profile"), "--jobs", "50")
    print(f"snakemake: {units} units in {time.monotonic() - start:.0f} s through Slurm")
    assert here.results(graph) == expected

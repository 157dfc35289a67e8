"""Sweeps in which something dies, is cancelled, fills up or is damaged: the same digests at the end."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

from loopback_cluster import Cluster, digests
from toy_graphs import write_graph


def dies(here: Cluster) -> None:
    """A process that exits with 37 in the middle of a unit."""
    graph = write_graph(here.root / "graph", 4, 3, 0.01)
    expected = here.local(graph)
    out = here.submit(graph, "--unit-seconds", "1", "--watch", code=5, BALLFLOW_TOY_DIE="2001")
    assert "nothing came of the jobs" in out or "still missing" in out, out
    # What needs it not is done: all but the step, its metric, the report of its model and the sum.
    assert "29 nodes are done" in here.submit(graph, "--dry-run"), "others complete"
    # What the process said last, and where the rest is.
    said = here.run("status", "--store", str(here.store))
    assert "toy: 2001 is one too many" in said, said
    assert "units ended without a word" in said and "last lines of" in said, said
    here.submit(graph, "--unit-seconds", "1", "--watch")
    assert here.results(graph) == expected


def clock_wrong(here: Cluster) -> None:
    """The clock of jobs on one node is an hour ahead; Slurm itself needs right ones."""
    libraries = sorted(Path("/usr/lib").glob("*/faketime/libfaketime.so.1"))
    if not libraries:
        print("clock_wrong: skipped, libfaketime is not installed")
        return
    here.slurm("down")
    # Files keep their times, as they do on a file server, and durations are right on every node.
    prolog = here.root / "prolog"
    prolog.write_text(f"""#!/bin/sh
[ "$SLURMD_NODENAME" = n1 ] || exit 0
echo "export LD_PRELOAD={libraries[0]}"
echo "export FAKETIME=+1h"
echo "export FAKETIME_DONT_FAKE_MONOTONIC=1"
echo "export NO_FAKE_STAT=1"
""")
    prolog.chmod(0o755)
    here.slurm("up", "4", "2", str(here.port), f"TaskProlog={prolog}")
    clocks = here.root / "clocks"
    clocks.mkdir()
    graph = write_graph(here.root / "graph", 8, 4, 0.1)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "2", "--watch", BALLFLOW_TOY_CLOCK=str(clocks))
    times = {node.name: min(int(line) for line in node.read_text().split()) for node in clocks.iterdir()}
    others = [seen for node, seen in times.items() if node != "n1"]
    assert others and 3500 < times["n1"] - min(others) < 3900, times
    assert here.results(graph) == expected


def cancelled(here: Cluster) -> None:
    """scancel of a task that runs."""
    graph = write_graph(here.root / "graph", 8, 4, 0.3)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "2")
    here.wait(lambda: bool(here.running()))
    here.ask("scancel", here.running()[0])
    here.submit(graph, "--unit-seconds", "2", "--watch")
    assert here.results(graph) == expected


def held(here: Cluster) -> None:
    """Jobs that the scheduler holds: the same submission once more releases them."""
    graph = write_graph(here.root / "graph", 4, 3, 0.2)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "2")
    waiting = here.ask("squeue", "--noheader", "--states=PD", "--format=%A").split()
    here.ask("scontrol", "hold", ",".join(waiting))
    assert "still going" in here.submit(graph, "--unit-seconds", "2"), "it has jobs"
    here.wait(here.is_idle)
    assert "nothing to submit" in here.submit(graph)
    assert here.results(graph) == expected


def node_lost(here: Cluster, with_jobs: bool) -> None:
    graph = write_graph(here.root / "graph", 8, 4, 0.5)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "2")
    here.wait(lambda: bool(here.ask("squeue", "--noheader", "--states=R", "--nodelist=n1", "--format=%i").split()))
    daemon = int((here.root / "slurm/run/slurmd-n1.pid").read_text())
    victims = [daemon]
    if with_jobs:
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            with contextlib.suppress(OSError):
                variables = (entry / "environ").read_bytes().split(b"\0")
                if b"SLURMD_NODENAME=n1" in variables and f"SLURM_CONF={here.environment['SLURM_CONF']}".encode() in variables:
                    victims.append(int(entry.name))
    for process in victims:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    here.submit(graph, "--unit-seconds", "2", "--watch")
    assert here.results(graph) == expected


def node_killed(here: Cluster) -> None:
    """A slurmd and its jobs: the requeued ones run elsewhere."""
    node_lost(here, with_jobs=True)


def slurmd_killed(here: Cluster) -> None:
    """A slurmd alone: its jobs go on as orphans, and run a second time elsewhere."""
    node_lost(here, with_jobs=False)


def controller_restarted(here: Cluster) -> None:
    graph = write_graph(here.root / "graph", 8, 4, 0.3)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "2")
    here.wait(lambda: bool(here.running()))
    pid_file = here.root / "slurm/run/slurmctld.pid"
    os.kill(int(pid_file.read_text()), signal.SIGKILL)
    time.sleep(1)
    subprocess.run(["slurmctld", "-f", here.environment["SLURM_CONF"]], env=here.environment, check=True)
    here.wait(lambda: subprocess.run(["squeue"], env=here.environment, capture_output=True).returncode == 0)
    here.submit(graph, "--unit-seconds", "2", "--watch")
    assert here.results(graph) == expected


def submitter_killed(here: Cluster) -> None:
    """Killed with -9 at several moments; then the same is submitted once."""
    graph = write_graph(here.root / "graph", 8, 4, 0.05)
    expected = here.local(graph)
    for seconds in (0.05, 0.1, 0.2, 1.5):
        process = subprocess.Popen(
            [here.program, "--plugin", here.plugin, "submit", str(graph), "--store", str(here.store), "--unit-seconds", "2",
             "--watch", "--cache", str(here.root / "submitter")],
            env=here.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(seconds)
        process.kill()
        process.wait()
    here.submit(graph, "--unit-seconds", "2", "--watch")
    assert here.results(graph) == expected


def disk_full(here: Cluster) -> None:
    """A store on a disk that is full says so, and goes on when there is room."""
    if os.geteuid() != 0:
        print("skipped: only root mounts a small disk")
        return
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m,mode=700", "tmpfs", here.store], check=True)
    try:
        graph = write_graph(here.root / "graph", 8, 60, 0)
        expected = here.local(graph)
        # Nodes that cannot publish fail (3), or not even the status of a unit can be written (5).
        out = here.submit(graph, "--unit-seconds", "100", "--watch", code=(3, 5))
        assert "No space left" in out, out[-2000:]
        subprocess.run(["mount", "-o", "remount,size=200m", here.store], check=True)
        here.submit(graph, "--unit-seconds", "100", "--watch")
        assert here.results(graph) == expected
    finally:
        subprocess.run(["umount", here.store], check=True)


def damaged(here: Cluster) -> None:
    """Files of the store half written or with a flipped bit."""
    graph = write_graph(here.root / "graph", 4, 3, 0.01)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "4", "--watch")
    files = sorted(f for room in ("ac", "cas") for f in (here.store / room).rglob("*") if f.is_file())
    for i, file in enumerate(files):
        content = bytearray(file.read_bytes())
        file.chmod(0o600)
        if i % 3 == 0:
            file.write_bytes(content[: len(content) // 2])
        elif i % 3 == 1:
            content[len(content) // 2] ^= 1
            file.write_bytes(content)
    shutil.rmtree(here.root / "submitter")
    for cache in here.root.glob("ballflow-*"):
        shutil.rmtree(cache)
    here.submit(graph, "--unit-seconds", "4", "--watch")
    # What nothing read is found damaged by who asks for it.
    report = here.root / "after.json"
    here.run("run", str(graph), "--upstream", str(here.store), "--report", str(report), "--quiet", cache="another")
    assert digests(report) == expected

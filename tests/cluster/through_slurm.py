"""Runs graphs through a Slurm of its own on loopback, and compares what comes of it with local runs.

usage: through_slurm.py PROGRAM PLUGIN SCENARIO...

Exit code 77: Slurm is not here (tools/setup cluster installs it).
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAMS = ("slurmctld", "slurmd", "munged", "sbatch", "squeue")


def write_graph(folder: Path, models: int, variants: int, seconds: float) -> Path:
    """models x (load, variants x (prune, metric), report), and the sum of all."""
    names = [str(i) for i in range(models)]
    inner = {
        "params": {"add": {"kind": "number", "doc": "what is added"}},
        "inputs": {"from": {"type": "toy.Count"}},
        "nodes": {
            "prune": {"type": "toy.Step", "params": {"add": "${add}", "seconds": seconds},
                      "inputs": {"from": "inputs.from"}},
            "metric": {"type": "toy.Step", "params": {"seconds": seconds}, "inputs": {"from": "prune.count"}},
        },
        "outputs": {"count": "metric.count"},
    }
    model = {
        "params": {"model": {"kind": "number", "doc": "a number"}},
        "nodes": {
            "load": {"type": "toy.Load", "params": {"model": "${model}"}},
            "variants": {"map": "variant.json", "over": {"add": [str(i) for i in range(variants)]},
                         "inputs": {"from": "load.count"}},
            "report": {"type": "toy.Sum", "inputs": {"counts": "variants.count"}},
        },
        "outputs": {"sum": "report.sum"},
    }
    top = {
        "nodes": {
            "models": {"map": "model.json", "over": {"model": names}},
            "final": {"type": "toy.Sum", "inputs": {"counts": "models.sum"}},
        },
        "outputs": {"sum": "final.sum"},
    }
    folder.mkdir(parents=True, exist_ok=True)
    for name, graph in (("variant", inner), ("model", model), ("graph", top)):
        (folder / f"{name}.json").write_text(json.dumps(graph))
    return folder / "graph.json"


class Cluster:
    """Four nodes of two processors each, and a store that they share; every node has a cache of its own."""

    def __init__(self, program: str, plugin: str, root: Path) -> None:
        self.program, self.plugin, self.root = program, plugin, root
        self.store = root / "store"
        self.store.mkdir()
        self.environment = dict(os.environ)
        self.environment["PATH"] += ":/usr/sbin:/sbin"
        for name in ("BALLFLOW_CACHE", "BALLFLOW_UPSTREAM"):
            self.environment.pop(name, None)
        self.environment["SLURM_CONF"] = str(root / "slurm" / "slurm.conf")
        self.environment["TMPDIR"] = str(root)
        # A port that nobody else is likely to have, below those that the kernel hands out.
        self.port = random.randrange(20000, 32000)

    def up(self) -> None:
        self.slurm("up", "4", "2", str(self.port))

    def slurm(self, action: str, *more: str) -> None:
        subprocess.run([HERE / "loopback_slurm", action, self.root / "slurm", *more], env=self.environment, check=True)

    def run(self, *words: str, cache: str = "submitter", code: int | tuple[int, ...] = 0, **more: str) -> str:
        command = [self.program, "--plugin", self.plugin, *words]
        environment = {**self.environment, **more, "BALLFLOW_CACHE_SIZE": "none"}
        # Of jobs it would be the cache of all of them: theirs is that of their node, below.
        words_of_cache = ["--cache", str(self.root / cache)] if words[0] in ("submit", "sweep", "run", "plan") else []
        done = subprocess.run([*command, *words_of_cache], env=environment, capture_output=True, text=True)
        codes = code if isinstance(code, tuple) else (code,)
        assert done.returncode in codes, f"{words}: exit code {done.returncode}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
        return done.stdout + done.stderr

    def submit(self, graph: Path, *words: str, code: int | tuple[int, ...] = 0, **more: str) -> str:
        return self.run("submit", str(graph), "--store", str(self.store), "--patience", "2", *words, code=code, **more)

    def ask(self, *words: str) -> str:
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=True).stdout

    def arrays(self) -> int:
        """Calls of sbatch so far."""
        return sum(len(json.loads(file.read_text())["arrays"]) for file in self.store.glob("submissions/*/submission.json"))

    def wait(self, what: Callable[[], bool], seconds: float = 120) -> None:
        end = time.monotonic() + seconds
        while not what():
            assert time.monotonic() < end, "it did not come to that"
            time.sleep(0.1)

    def running(self) -> list[str]:
        return self.ask("squeue", "--noheader", "--array", "--states=R", "--format=%i").split()

    def local(self, graph: Path, *words: str) -> dict[str, str]:
        out = self.root / "local"
        self.run("run", str(graph), "--out", str(out), "--report", str(out) + ".json", "--quiet", *words, cache="alone")
        return digests(Path(str(out) + ".json"))

    def results(self, graph: Path, *words: str) -> dict[str, str]:
        """What the store has, as a run on a machine of its own finds it; nothing is computed."""
        report = self.root / "results.json"
        cache = f"fresh-{random.random()}"
        self.run("run", str(graph), "--upstream", str(self.store), "--report", str(report), "--quiet", *words, cache=cache)
        nodes = json.loads(report.read_text())["nodes"]
        computed = [path for path, node in nodes.items() if node["status"] == "run"]
        assert not computed, f"not in the store: {computed[:3]}"
        return digests(report)


def digests(report: Path) -> dict[str, str]:
    nodes = json.loads(report.read_text())["nodes"]
    return {f"{path}.{port}": output["digest"] for path, node in nodes.items() for port, output in node["outputs"].items()}


@contextlib.contextmanager
def cluster(program: str, plugin: str) -> Iterator[Cluster]:
    root = Path(tempfile.mkdtemp(prefix="ballflow-slurm-"))
    made = Cluster(program, plugin, root)
    try:
        made.up()
        yield made
    finally:
        made.slurm("down")
        shutil.rmtree(root, ignore_errors=True)


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
    here.submit(graph, "--unit-seconds", "200")
    submitted = time.monotonic() - start
    arrays = here.arrays()
    here.submit(graph, "--unit-seconds", "200", "--watch")
    ran = time.monotonic() - start
    assert here.arrays() == arrays, "nothing had to be sent twice"
    start = time.monotonic()
    assert "nothing to submit" in here.submit(graph)
    nothing = time.monotonic() - start
    print(f"51 001 nodes: {arrays} sbatch calls, submitted in {submitted:.1f} s, ran in {ran:.1f} s, "
          f"nothing to do in {nothing:.2f} s")
    assert arrays <= 5
    assert len(here.results(graph)) == 51_001


def busy(here: Cluster) -> None:
    """Nodes of 0.1 s: how much longer than a local run on as many processors."""
    here.slurm("down")
    here.slurm("up", "1", "2", str(here.port))
    graph = write_graph(here.root / "graph", 4, 100, 0.1)
    start = time.monotonic()
    expected = here.local(graph, "--threads", "2")
    alone = time.monotonic() - start
    start = time.monotonic()
    # A node of an array that never ran counts as a second.
    here.submit(graph, "--unit-seconds", "50", "--watch")
    there = time.monotonic() - start
    print(f"809 nodes, 800 of 0.1 s: {alone:.1f} s here, {there:.1f} s through Slurm, {there / alone:.2f} times as long")
    assert here.results(graph) == expected


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
    for room in ("ac", "cas"):
        shutil.rmtree(here.store / room)
    for cache in [here.root / "submitter", *here.root.glob("ballflow-*")]:
        shutil.rmtree(cache, ignore_errors=True)
    folder = export("workflow-slurm")
    start = time.monotonic()
    snakemake(folder, "--profile", str(folder / "profile"), "--jobs", "50")
    print(f"snakemake: {units} units in {time.monotonic() - start:.0f} s through Slurm")
    assert here.results(graph) == expected


def dies(here: Cluster) -> None:
    """A process that exits with 37 in the middle of a unit."""
    graph = write_graph(here.root / "graph", 4, 3, 0.01)
    expected = here.local(graph)
    out = here.submit(graph, "--unit-seconds", "1", "--watch", code=5, BALLFLOW_TOY_DIE="2001")
    assert "nothing came of the jobs" in out or "still missing" in out, out
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


SCENARIOS = {f.__name__: f for f in (small, large, busy, table, real, snakemake, dies, clock_wrong, cancelled, node_killed,
                                     slurmd_killed, controller_restarted, submitter_killed, disk_full, damaged)}


def main() -> int:
    program, plugin, *names = sys.argv[1:]
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    absent = [name for name in PROGRAMS if shutil.which(name, path=path) is None]
    if absent:
        print(f"SKIPPED: {', '.join(absent)} not installed; \"tools/setup cluster\" does")
        return 77
    os.environ["PATH"] = path
    for name in names or SCENARIOS:
        start = time.monotonic()
        with cluster(program, plugin) as here:
            SCENARIOS[name](here)
        print(f"{name}: {time.monotonic() - start:.1f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

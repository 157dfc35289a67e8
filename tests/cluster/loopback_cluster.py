"""A Slurm of its own on loopback with a store that its nodes share, and what is asked of both."""

from __future__ import annotations

import contextlib
import json
import os
import random
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent


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
        self.environment["TMPDIR"] = self.environment["HOME"] = str(root)
        # A port that nobody else is likely to have, below those that the kernel hands out.
        self.port = random.randrange(20000, 32000)

    def up(self) -> None:
        self.slurm("up", "4", "2", str(self.port))

    def slurm(self, action: str, *more: str) -> None:
        words = [HERE / "loopback_slurm", action, self.root / "slurm", *more]
        subprocess.run(words, env=self.environment, check=True)

    def run(self, *words: str, cache: str = "submitter", code: int | tuple[int, ...] = 0, **more: str) -> str:
        command = [self.program, "--plugin", self.plugin, *words]
        environment = {**self.environment, **more, "BALLFLOW_CACHE_SIZE": "none"}
        # Of jobs it would be the cache of all of them: theirs is that of their node, below.
        if words[0] in ("submit", "sweep", "run", "plan"):
            command += ["--cache", str(self.root / cache)]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        codes = code if isinstance(code, tuple) else (code,)
        said = f"{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
        assert done.returncode in codes, f"{words}: exit code {done.returncode}\n{said}"
        return done.stdout + done.stderr

    def submit(self, graph: Path, *words: str, code: int | tuple[int, ...] = 0, **more: str) -> str:
        settings = ("--store", str(self.store), "--patience", "2")
        return self.run("submit", str(graph), *settings, *words, code=code, **more)

    def ask(self, *words: str) -> str:
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=True).stdout

    def submissions(self) -> list[dict[str, Any]]:
        files = self.store.glob("submissions/*/submission.json")
        return [json.loads(file.read_text()) for file in sorted(files)]

    def arrays(self) -> int:
        """Calls of sbatch so far."""
        return sum(len(submission["arrays"]) for submission in self.submissions())

    def ends(self) -> list[str]:
        """States of jobs, the reason and the exit code, each once."""
        jobs = self.ask("scontrol", "--oneliner", "show", "job").splitlines()
        fields = [dict(word.split("=", 1) for word in job.split() if "=" in word) for job in jobs]
        return sorted({f"{job['JobState']} {job['Reason']} {job['ExitCode']}" for job in fields})

    def wait(self, what: Callable[[], bool], seconds: float = 120) -> None:
        end = time.monotonic() + seconds
        while not what():
            assert time.monotonic() < end, "it did not come to that"
            time.sleep(0.1)

    def is_idle(self) -> bool:
        return not self.ask("squeue", "--noheader", "--format=%i").split()

    def running(self) -> list[str]:
        return self.ask("squeue", "--noheader", "--array", "--states=R", "--format=%i").split()

    def forget(self) -> None:
        """Nothing has ever run: an empty store, and empty caches of nodes and of the submitter."""
        for folder in (*self.store.iterdir(), self.root / "submitter", *self.root.glob("ballflow-*")):
            shutil.rmtree(folder, ignore_errors=True)

    def local(self, graph: Path, *words: str) -> dict[str, str]:
        out = self.root / "local"
        settings = ("--out", str(out), "--report", str(out) + ".json", "--quiet")
        self.run("run", str(graph), *settings, *words, cache="alone")
        return digests(Path(str(out) + ".json"))

    def results(self, graph: Path, *words: str) -> dict[str, str]:
        """What the store has, as a run on a machine of its own finds it; nothing is computed."""
        report = self.root / "results.json"
        cache = f"fresh-{random.random()}"
        settings = ("--upstream", str(self.store), "--report", str(report), "--quiet")
        self.run("run", str(graph), *settings, *words, cache=cache)
        nodes = json.loads(report.read_text())["nodes"]
        computed = [path for path, node in nodes.items() if node["status"] == "run"]
        assert not computed, f"not in the store: {computed[:3]}"
        return digests(report)


def digests(report: Path) -> dict[str, str]:
    nodes = json.loads(report.read_text())["nodes"]
    return {f"{path}.{port}": output["digest"]
            for path, node in nodes.items() for port, output in node["outputs"].items()}


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

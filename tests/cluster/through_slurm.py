"""Runs graphs through a Slurm of its own on loopback, and compares what comes of it with local runs.

usage: through_slurm.py PROGRAM PLUGIN SCENARIO...

Exit code 77: Slurm is not here (tools/setup cluster installs it). As root, all scenarios but those that mount disks
are run by the user nobody, with daemons of its own: what users of a cluster may do is enough.
"""

from __future__ import annotations

import os
import pwd
import shutil
import sys
import time
import traceback
from pathlib import Path

import scenarios_failures as failures
import scenarios_limits as limits
import scenarios_work as work
from loopback_cluster import HERE, cluster

PROGRAMS = ("slurmctld", "slurmd", "munged", "sbatch", "squeue")
SCENARIOS = {f.__name__: f for f in (
    work.small, work.large, work.busy, work.table, work.real, work.snakemake,
    failures.dies, failures.clock_wrong, failures.cancelled, failures.held, failures.node_killed,
    failures.slurmd_killed, failures.controller_restarted, failures.submitter_killed, failures.disk_full,
    failures.damaged,
    limits.out_of_memory, limits.loop_signalled, limits.loop_out_of_time, limits.shows_progress)}

AS_ROOT = {"disk_full"}


def is_open_to_all(path: str) -> bool:
    """Whether everybody may read the file, and get there."""
    place = Path(path).resolve()
    reachable = all(folder.stat().st_mode & 0o001 for folder in place.parents)
    return reachable and bool(place.stat().st_mode & 0o004)


def become_nobody() -> None:
    user = pwd.getpwnam("nobody")
    os.setgroups([])
    os.setgid(user.pw_gid)
    os.setuid(user.pw_uid)
    os.environ["USER"] = os.environ["LOGNAME"] = user.pw_name


def run(name: str, program: str, plugin: str) -> None:
    start = time.monotonic()
    with cluster(program, plugin) as here:
        SCENARIOS[name](here)
    print(f"{name}: {time.monotonic() - start:.1f} s", flush=True)


def run_as_nobody(name: str, program: str, plugin: str) -> bool:
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            become_nobody()
            run(name, program, plugin)
            code = 0
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def main() -> int:
    program, plugin, *names = sys.argv[1:]
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    absent = [name for name in PROGRAMS if shutil.which(name, path=path) is None]
    if absent:
        print(f"SKIPPED: {', '.join(absent)} not installed; \"tools/setup cluster\" does")
        return 77
    os.environ["PATH"] = path
    plain = os.geteuid() == 0
    closed = [path for path in (program, plugin, str(HERE / "loopback_slurm")) if not is_open_to_all(path)]
    if plain and closed:
        print(f"as root: only its owner may read {closed[0]}")
        plain = False
    failed = False
    for name in names or SCENARIOS:
        if plain and name not in AS_ROOT:
            failed = not run_as_nobody(name, program, plugin) or failed
        else:
            run(name, program, plugin)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

"""Jobs that run out of memory or time: they get more of it, and loops go on where they were."""

from __future__ import annotations

import re
import time
from pathlib import Path

from loopback_cluster import Cluster
from toy_graphs import write_graph, write_loop


def out_of_memory(here: Cluster) -> None:
    """A node that takes more memory than it says: its unit is killed, and gets twice as much till it is enough."""
    graph = write_graph(here.root / "graph", 2, 2, 0.01, megabytes=700)
    expected = here.local(graph)
    # Slurm looks once a second how much its jobs take.
    here.submit(graph, "--unit-seconds", "1", "--watch", BALLFLOW_TOY_HOLD="4")
    assert here.results(graph) == expected
    asked = sorted({array["memory"] for run in here.submissions() for array in run["arrays"]})
    assert asked[-1] == 2 * asked[0], asked
    rounds = len(here.submissions())
    sizes = " and ".join(f"{memory >> 20} MB" for memory in asked)
    print(f"out_of_memory: {sizes} in {rounds} rounds; ends of jobs: {', '.join(here.ends())}")
    assert rounds == 2, rounds
    # Without --watch, by submitting the same once more.
    here.forget()
    for _ in range(2):
        here.submit(graph, "--unit-seconds", "1", BALLFLOW_TOY_HOLD="4")
        here.wait(here.is_idle)
    assert "nothing to submit" in here.submit(graph)
    assert here.results(graph) == expected


def steps_done(clocks: Path) -> int:
    return sum(len(file.read_text().split()) for file in clocks.iterdir())


def resumed(here: Cluster) -> list[int]:
    """After which iterations jobs went on."""
    logs = "".join(file.read_text() for file in sorted(here.store.glob("submissions/*/log/*.out")))
    return [int(number) for number in re.findall(r"goes on after iteration (\d+)", logs)]


def loop_signalled(here: Cluster) -> None:
    """The signal that comes before a time limit, sent by hand: the next job goes on with the loop."""
    graph = write_loop(here.root / "graph", iterations=60, seconds=0.2)
    expected = here.local(graph)
    clocks = here.root / "clocks"
    clocks.mkdir()
    here.submit(graph, BALLFLOW_TOY_CLOCK=str(clocks))
    for wanted in (20, 40):
        here.wait(lambda: steps_done(clocks) > wanted and bool(here.running()))
        here.ask("scancel", "--batch", "--signal=USR1", *here.running())
        here.wait(here.is_idle)
        here.submit(graph, BALLFLOW_TOY_CLOCK=str(clocks))
    here.submit(graph, "--watch", BALLFLOW_TOY_CLOCK=str(clocks))
    assert here.results(graph) == expected
    after = resumed(here)
    assert len(after) == 2 and after[0] >= 20 and after[1] >= 40, after
    done = steps_done(clocks)
    print(f"loop_signalled: went on after {after}, {done} iterations computed for 60")
    # Each signal costs at most the iteration that it comes in.
    assert 60 <= done <= 62, done
    minutes = [max(array["minutes"] for array in run["arrays"]) for run in here.submissions()]
    assert minutes[1] == 2 * minutes[0], minutes


def loop_out_of_time(here: Cluster) -> None:
    """A loop that takes longer than its time limit of two minutes."""
    graph = write_loop(here.root / "graph", iterations=300, seconds=0.5)
    expected = here.local(graph)
    clocks = here.root / "clocks"
    clocks.mkdir()
    start = time.monotonic()
    here.submit(graph, "--sbatch=--time=2", "--watch", BALLFLOW_TOY_CLOCK=str(clocks))
    assert here.results(graph) == expected
    after = resumed(here)
    assert after and after == sorted(set(after)), after
    done = steps_done(clocks)
    print(f"loop_out_of_time: 150 s of iterations within limits of 120 s: {len(after) + 1} jobs, which went on "
          f"after {after}, {done} iterations computed for 300, {time.monotonic() - start:.0f} s")
    assert 300 <= done <= 300 + len(after), done


def shows_progress(here: Cluster) -> None:
    """Nodes count in the status before their unit ends."""
    graph = write_graph(here.root / "graph", 2, 40, 0.4)
    expected = here.local(graph)
    here.submit(graph, "--unit-seconds", "100")
    said = ""

    def counts() -> bool:
        nonlocal said
        said = here.run("status", "--store", str(here.store))
        return "that have not ended" in said or "that has not ended" in said

    here.wait(counts)
    found = re.search(r"(\d+) of (\d+) nodes are done in \d+ units? that ha(?:s|ve) not ended", said)
    assert found and 0 < int(found[1]) < int(found[2]), said
    step = next(line for line in said.splitlines() if line.startswith("toy.Step"))
    assert "#" in step and "." in step, said
    here.submit(graph, "--watch")
    assert here.results(graph) == expected
    assert not list(here.store.glob("submissions/*/status/*.part"))
    print(f"shows_progress: {found[0]}")

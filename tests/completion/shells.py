#!/usr/bin/env python3
"""shells.py SHELL BALLFLOW: types beginnings of commands and the tab key into the shell, and looks at what
it made of them. Exit code 77: the shell is not here."""

import os
import pty
import select
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# What is typed before the tab key, and the words of the line after it.
CASES: list[tuple[str, list[str]]] = [
    ("ballflow swe", ["ballflow", "sweep"]),
    ("ballflow cache unp", ["ballflow", "cache", "unpin"]),
    ("ballflow run medial_a", ["ballflow", "run", "medial_axis"]),
    ("ballflow run shape --no-c", ["ballflow", "run", "shape", "--no-cache"]),
    ("ballflow run medial_axis --set eps", ["ballflow", "run", "medial_axis", "--set", "epsilon="]),
    (
        "ballflow run medial_axis --set strategy=gre",
        ["ballflow", "run", "medial_axis", "--set", "strategy=greedy"],
    ),
    (
        "ballflow run medial_axis --set input=my_sc",
        ["ballflow", "run", "medial_axis", "--set", "input=my_scan.ply"],
    ),
    ("ballflow run my_gr", ["ballflow", "run", "my_graph.json"]),
    ("ballflow run shape --out my_fo", ["ballflow", "run", "shape", "--out", "my_folder/"]),
    ("ballflow compare --format cs", ["ballflow", "compare", "--format", "csv"]),
    ("ballflow nodes Enla", ["ballflow", "nodes", "Enlarge"]),
]

# A shell without anybody's settings that prints the words of the line, each in brackets, for "words ...".
SET_UP = {
    "bash": "PS1='ready> '; bind 'set enable-bracketed-paste off'; source <(ballflow completion bash)\n",
    "zsh": "PS1='ready> '; unset zle_bracketed_paste; autoload -U compinit; compinit -u -D; "
    "source <(ballflow completion zsh)\n",
}
WORDS = "words() { printf '<%s>' \"$@\"; echo; }\n"
START = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"]}


def read_until(terminal: int, mark: str, seconds: float = 60) -> str:
    """What the shell prints, up to and including `mark`."""
    text = ""
    while mark not in text:
        ready, _, _ = select.select([terminal], [], [], seconds)
        if not ready:
            sys.exit(f"no {mark!r} within {seconds} s in what the shell printed:\n{text}")
        text += os.read(terminal, 4096).decode(errors="replace")
    return text


def typed(shell: str, environment: dict[str, str], folder: str) -> list[list[str]]:
    """The words of every case, as the shell gives them to a function."""
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execvpe(START[shell][0], START[shell], environment)
    results = []
    os.write(terminal, (WORDS + SET_UP[shell] + "echo 'set'' up'\n").encode())
    read_until(terminal, "set up\r\n")
    for line, _ in CASES:
        # Completed; then, at the beginning of the line, the function that shows its words; a mark at the end.
        os.write(terminal, f"{line}\t\x01words \x05\necho 'd''one'\n".encode())
        text = read_until(terminal, "done\r\n")
        shown = [part for part in text.splitlines() if part.startswith("<ballflow>")]
        words = shown[-1].strip("<>").split("><") if shown else [text]
        if shell == "zsh" and os.path.isdir(f"{folder}/{words[-1]}"):
            words[-1] += "/"  # zsh takes it away where no name follows
        results.append(words)
    os.write(terminal, b"exit\n")
    os.close(terminal)
    os.waitpid(child, 0)
    return results


def asked(environment: dict[str, str], folder: str) -> list[list[str]]:
    """Fish says itself what it would complete; one candidate is what the tab key takes."""
    results = []
    for line, expected in CASES:
        script = f"ballflow completion fish | source; complete -C '{line}'"
        run = subprocess.run(
            ["fish", "--no-config", "-c", script],
            env=environment,
            cwd=folder,
            text=True,
            stdout=subprocess.PIPE,
            check=True,
        )
        candidates = [candidate.split("\t")[0] for candidate in run.stdout.splitlines()]
        results.append(line.split()[:-1] + candidates)
    return results


def main() -> None:
    shell, program = sys.argv[1:]
    if not shutil.which(shell):
        print(f"SKIPPED: {shell} is not here")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "my_scan.ply").touch()
        Path(folder, "my_graph.json").touch()
        Path(folder, "my_folder").mkdir()
        environment = {
            "PATH": f"{os.path.dirname(program)}:{os.environ['PATH']}",
            "HOME": folder,
            "TERM": "dumb",
            "LANG": "C.UTF-8",
            "BALLFLOW_CACHE": f"{folder}/cache",
        }
        results = asked(environment, folder) if shell == "fish" else typed(shell, environment, folder)
    failed = 0
    for (line, expected), words in zip(CASES, results):
        if words != expected:
            failed += 1
            print(f"{line}<tab>\n  expected {expected}\n  got      {words}")
    if failed:
        sys.exit(f"{failed} of {len(CASES)} lines are completed wrongly")
    print(f"{len(CASES)} lines, as expected")


main()

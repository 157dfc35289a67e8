"""Reads exported files by their specifications and compares them with the artifacts they were made from.

check_exports.py FOLDER: for every NAME.safetensors in the folder, every other NAME.FORMAT must hold the same
numbers, to the last bit where the format has doubles and to the nearest float where it has floats. Prints one
line per file that was compared; exit code 1 when one differs. Uses nothing but the standard library, and none
of the code that wrote the files.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # the tests leave no files among the sources

from exports import glb, meshes, planar, robots, tables  # noqa: E402
from exports.artifact import Artifact  # noqa: E402

CHECKS = {name.removeprefix("check_"): check
          for subject in (glb, meshes, planar, robots, tables)
          for name, check in vars(subject).items() if name.startswith("check_")}


def main(folder):
    failed = False
    for source in sorted(pathlib.Path(folder).glob("*.safetensors")):
        artifact = Artifact(source)
        for path in sorted(source.parent.glob(source.stem + ".*")):
            if path == source:
                continue
            kind = path.suffix[1:]
            try:
                CHECKS[kind](path.read_bytes(), artifact)
                print("equal", artifact.type, kind)
            except Exception as error:  # every way of being wrong is a difference
                failed = True
                print("DIFFERENT", path.name, artifact.type, kind, type(error).__name__, error)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

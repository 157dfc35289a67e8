"""Runs the checker of certificates in docs/set_cover.md on true and on forged ones."""
import re
import sys
from collections import Counter

page = open(sys.argv[1], encoding="utf-8").read()
(source,) = re.findall(r"```python\n(listed = .*?)```", page, re.S)
UNIT = 2**20


def accepts(samples, prices, groups, instance):
    names = dict(Counter=Counter, samples=samples, prices=prices, groups=groups, instance=instance, print=lambda *_: None)
    try:
        exec(source, names)
    except AssertionError:
        return False
    return True


# Three balls over five samples; samples 5 and 6 are in none.
balls = [{0, 1}, {1, 2}, {3, 4}]
true = ([0, 2, 3], [UNIT, UNIT, UNIT], [0, 1, 2])
cases = {
    "a true certificate": (True, *true),
    "no certificate": (True, [], [], []),
    "prices above 1 in a ball": (False, [0, 1], [UNIT, 1], [0, 0]),
    "samples of two groups in a ball": (False, [0, 1], [1, 1], [0, 1]),
    "samples in no ball": (False, true[0] + [5, 6], true[1] + [UNIT, UNIT], true[2] + [3, 4]),
    "a sample listed twice": (False, true[0] + [3], true[1] + [UNIT], true[2] + [3]),
    "a price below 0": (False, [0, 1], [2 * UNIT, -UNIT], [0, 0]),
}
wrong = [name for name, (right, *certificate) in cases.items() if accepts(*certificate, balls) != right]
for name in wrong:
    print("docs/set_cover.md judges wrongly:", name)
sys.exit(bool(wrong))

"""validate.py SOURCE-FOLDER BALLFLOW: the JSON schemas, judged by a validator that knows nothing of ballflow.

Every graph, subgraph and body in graphs/ fits schemas/graph.schema.json, and its nodes fit schemas/nodes.schema.json. Every
wrong graph in the list below is refused by the schema and by the program. Reports of runs fit schemas/run_report.schema.json.
Exit code 77: python3-jsonschema is absent.
"""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("skipped: the Python package jsonschema is absent (python3-jsonschema)")
    sys.exit(77)

source, program = pathlib.Path(sys.argv[1]), sys.argv[2]
failures = 0


def fail(text):
    global failures
    failures += 1
    print("FAILED:", text)


def without_comments(text):
    """Graph files may have // and /* */ comments; texts may contain both."""
    pattern = r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/'
    return re.sub(pattern, lambda m: m[0] if m[0].startswith('"') else " ", text, flags=re.S)


def load(path):
    return json.loads(without_comments(path.read_text()))


def validator(name):
    schema = json.loads((source / "schemas" / name).read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


graphs, nodes, reports = map(validator, ["graph.schema.json", "nodes.schema.json", "run_report.schema.json"])


def why_not(schema, document):
    return "; ".join("/".join(map(str, e.absolute_path)) + ": " + e.message[:200] for e in schema.iter_errors(document))


def ballflow(*arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


files = sorted((source / "graphs").rglob("*.json"))
if len(files) < 8:
    fail(f"only {len(files)} graphs")
for path in files:
    graph = load(path)
    if why := why_not(graphs, graph):
        fail(f"{path}: {why}")
    for name, node in graph["nodes"].items():
        if why := why_not(nodes, node):
            fail(f"{path}, node {name}: {why}")

# The examples of the node pages are entries of "nodes".
examples = re.findall(r"```json\n(.*?)```", (source / "nodes/README.md").read_text(), flags=re.S)
pages = re.findall(r"^### ", (source / "nodes/README.md").read_text().split("\n# Types")[0], flags=re.M)
if len(examples) != len(pages):
    fail(f"{len(pages)} node pages, {len(examples)} examples")
for example in map(json.loads, examples):
    for name, node in example.items():
        if why := why_not(nodes, node):
            fail(f"example {name}: {why}")

# One change makes each of these graphs wrong: (graph, what is wrong, where, new value).
medial_axis = load(source / "graphs/medial_axis.json")
hybrid = load(source / "graphs/strategies/hybrid.json")
REMOVE = object()
mutations = [
    (medial_axis, "unknown key of a graph", ["node"], {}),
    (medial_axis, "no nodes", ["nodes"], REMOVE),
    (medial_axis, "nodes that are a list", ["nodes"], []),
    (medial_axis, "unknown node type", ["nodes", "enlarge", "type"], "Enlarg"),
    (medial_axis, "neither type nor graph", ["nodes", "enlarge", "type"], REMOVE),
    (medial_axis, "type and graph", ["nodes", "enlarge", "graph"], "dmt.json"),
    (medial_axis, "unknown key of a node", ["nodes", "enlarge", "input"], {}),
    (medial_axis, "a required input is missing", ["nodes", "enlarge", "inputs", "balls"], REMOVE),
    (medial_axis, "unknown input", ["nodes", "enlarge", "inputs", "ball"], "dmt.inner"),
    (medial_axis, "an edge without a port", ["nodes", "enlarge", "inputs", "balls"], "dmt"),
    (medial_axis, "an edge that is a number", ["nodes", "enlarge", "inputs", "balls"], 3),
    (medial_axis, "unknown parameter", ["nodes", "enlarge", "params", "epsilons"], 1),
    (medial_axis, "a number out of range", ["nodes", "enlarge", "params", "epsilon"], -0.5),
    (medial_axis, "a number that is a text", ["nodes", "enlarge", "params", "epsilon"], "0.3"),
    (medial_axis, "a number that is null", ["nodes", "enlarge", "params", "epsilon"], None),
    (medial_axis, "a choice that does not exist", ["nodes", "enlarge", "params", "mode"], "additiv"),
    (medial_axis, "a node named inputs", ["nodes", "inputs"], {"type": "Shape"}),
    (medial_axis, "a node name with a slash", ["nodes", "a/b"], {"type": "Shape"}),
    (medial_axis, "a subgraph that is a number", ["nodes", "prune", "graph"], 1),
    (medial_axis, "a subgraph parameter that is a list of lists", ["nodes", "prune", "params"], {"x": [[1]]}),
    (medial_axis, "a subgraph parameter that is a table", ["nodes", "prune", "params"], {"x": {}}),
    (medial_axis, "an output that is no edge", ["outputs", "balls"], "select"),
    (medial_axis, "an output with an unknown key", ["outputs", "balls"], {"from": "select.balls", "format": "ply"}),
    (medial_axis, "a parameter without a kind", ["params", "epsilon", "kind"], REMOVE),
    (medial_axis, "an unknown kind of parameter", ["params", "epsilon", "kind"], "float"),
    (medial_axis, "a minimum that is a text", ["params", "epsilon", "minimum"], "0"),
    (medial_axis, "an empty list of choices", ["params", "labels", "choices"], []),
    (medial_axis, "a parameter with an unknown key", ["params", "epsilon", "units"], "%"),
    (medial_axis, "a parameter name with a dash", ["params", "a-b"], {"kind": "number", "default": 0}),
    (hybrid, "an input of an unknown type", ["inputs", "cover", "type"], "CoverStat"),
    (hybrid, "an input without a type", ["inputs", "cover", "type"], REMOVE),
    (hybrid, "optional that is a text", ["inputs", "cover", "optional"], "yes"),
    (hybrid, "a loop without until", ["nodes", "rounds", "until"], REMOVE),
    (hybrid, "a loop of 0 iterations", ["nodes", "rounds", "max_iterations"], 0),
    (hybrid, "a loop of half an iteration", ["nodes", "rounds", "max_iterations"], 0.5),
    (hybrid, "a loop with an unknown limit", ["nodes", "rounds", "at_limit"], "warn"),
    (hybrid, "a loop with an unknown setting", ["nodes", "rounds", "iterations"], 5),
]
with tempfile.TemporaryDirectory() as folder:
    # Beside copies of the subgraphs, so that only the change is wrong.
    for path in files:
        copy_path = pathlib.Path(folder) / path.relative_to(source / "graphs")
        copy_path.parent.mkdir(parents=True, exist_ok=True)
        copy_path.write_text(path.read_text())
    for base, what, where, value in mutations:
        wrong = copy.deepcopy(base)
        owner = wrong
        for step in where[:-1]:
            owner = owner[step]
        if value is REMOVE:
            del owner[where[-1]]
        else:
            owner[where[-1]] = value
        if graphs.is_valid(wrong):
            fail(f"the schema accepts {what}")
        name = pathlib.Path(folder) / ("strategies/certified.json" if base is hybrid else "wrong.json")
        name.write_text(json.dumps(wrong))
        check = ballflow("check", pathlib.Path(folder) / "medial_axis.json" if base is hybrid else name)
        if check.returncode != 2:
            fail(f"the program accepts {what}: {check.stdout}{check.stderr}")

    # Reports: a run, and a run that fails.
    report = pathlib.Path(folder) / "report.json"
    hybrid_run = ["--set", "strategy=hybrid", "--set", "input=shape:torus?n=600"]
    for arguments, code in [(hybrid_run, 0), (["--set", "input=/nowhere.off"], 3)]:
        run = ballflow("run", source / "graphs/medial_axis.json", "--no-cache", "--quiet", "--report", report, *arguments)
        if run.returncode != code:
            fail(f"run {arguments}: exit code {run.returncode}: {run.stderr}")
        elif why := why_not(reports, json.loads(report.read_text())):
            fail(f"report of run {arguments}: {why}")

print(f"{len(files)} graphs, {len(examples)} examples, {len(mutations)} wrong graphs")
sys.exit(1 if failures else 0)

"""Running graphs: inputs, results, cache, errors, progress, cancelling."""

from __future__ import annotations

import gc
import json
import os
import shlex
import shutil
import signal
import threading
import time
import warnings

import numpy as np
import pytest

import ballflow as bf
from conftest import in_child


def off_text(vertices, triangles):
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, row)) for row in vertices.tolist()]
    lines += ["3 " + " ".join(map(str, row)) for row in triangles.tolist()]
    return "\n".join(lines) + "\n"


def digests(run):
    return {
        f"{path}.{port}": output["digest"]
        for path, node in run.report["nodes"].items()
        for port, output in node["outputs"].items()
    }


def test_a_shipped_graph_runs_by_its_name_and_comes_from_the_cache_again():
    first = bf.run("shape")
    again = bf.run("shape", params=dict(first.params))
    assert first.status == again.status == "ok"
    assert {node.status for node in again.nodes.values()} <= {"hit", "pending"}
    assert digests(first) == digests(again)


def test_digests_are_those_of_the_command_line(program):
    run = bf.run("prune", input="shape:sTube", epsilon=1.0, strategy="greedy")
    program("run", bf._session.graph_file("prune"), "--set", "input=shape:sTube", "--set", "epsilon=1", "--set",
            "strategy=greedy", "--cache", "other", "--report", "report.json", "--quiet")
    report = json.load(open("report.json"))
    of_program = {
        f"{path}.{port}": output["digest"]
        for path, node in report["nodes"].items()
        for port, output in node["outputs"].items()
    }
    assert of_program and digests(run) == of_program
    # And the command line finds what Python has put into its cache.
    printed = program("run", bf._session.graph_file("prune"), "--set", "input=shape:sTube", "--set", "epsilon=1",
                      "--set", "strategy=greedy", "--json")
    assert '"status":"run"' not in printed


def test_the_report_has_the_command_that_repeats_the_run(program, tmp_path):
    (tmp_path / "a b.csv").write_text("x,y,z,r\n0,0,0,1\n")
    run = bf.run("balls", {"diagram.tolerance": "polar"}, file=tmp_path / "a b.csv", seed=3)
    words = shlex.split(run.report["command"])
    assert words[:2] == ["ballflow", "run"]
    program(*words[1:], "--report", "again.json", "--cache", "other", "--quiet")
    again = json.load(open("again.json"))
    assert again["nodes"]["load"]["outputs"] == run.report["nodes"]["load"]["outputs"]
    assert "command" not in bf.run("dmt_points", input=np.random.default_rng(5).normal(size=(50, 3))).report
    program("report", run.id)


def test_a_mesh_of_arrays_is_the_mesh_of_a_file(box, tmp_path):
    vertices, triangles = box
    (tmp_path / "box.off").write_text(off_text(vertices, triangles))
    of_file = bf.run("dmt", input=tmp_path / "box.off", sampling="surface")
    of_arrays = bf.run("dmt", input=box, sampling="surface")
    assert of_file.inner == of_arrays.inner
    assert 0.45 < of_arrays.inner.radii.max() < 0.51  # of a box of 2 x 1 x 1, by its samples

    class Mesh:
        pass

    mesh = Mesh()
    mesh.vertices, mesh.faces = vertices.astype(np.float32), triangles.astype(np.uint8)
    assert bf.run("dmt", input=mesh, sampling="surface").inner == of_file.inner
    assert bf.run("dmt", input=bf.TriangleMesh(vertices, triangles), sampling="surface").inner == of_file.inner


def test_the_same_arrays_are_a_hit():
    points = np.random.default_rng(1).normal(size=(300, 3))
    first = bf.run("dmt_points", input=points)
    again = bf.run("dmt_points", input=np.asfortranarray(points.copy()))
    assert any(node.status == "run" for node in first.nodes.values())
    assert not any(node.status == "run" for node in again.nodes.values())


def test_results_are_read_only_and_share_the_memory_of_the_cache(balls):
    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1")
    centers = run.balls.centers
    assert centers.dtype == np.float64 and centers.shape == (2, 3)
    with pytest.raises(ValueError):
        centers[0, 0] = 7
    with pytest.raises(ValueError):
        centers.flags.writeable = True
    artifact = run.balls
    assert artifact.centers.__array_interface__["data"] == artifact.arrays["centers"].__array_interface__["data"]
    # Two looks at one artifact of a cache are the same file in memory, and no copies on the heap.
    maps = open("/proc/self/maps").read()
    address = artifact.centers.__array_interface__["data"][0]
    inside = [
        line
        for line in maps.splitlines()
        if int(line.split("-")[0], 16) <= address < int(line.split()[0].split("-")[1], 16)
    ]
    again = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1").balls
    address = again.centers.__array_interface__["data"][0]
    maps = open("/proc/self/maps").read()
    mapped = [
        line
        for line in maps.splitlines()
        if int(line.split("-")[0], 16) <= address < int(line.split()[0].split("-")[1], 16)
    ]
    assert len(inside) == len(mapped) == 1
    assert "/cache/cas/" in mapped[0]


def test_a_million_points_out_are_no_copy():
    points = np.random.default_rng(2).random((1_000_000, 3))
    cloud = bf.PointSet(points)
    assert cloud.points.base is not None
    assert not np.shares_memory(cloud.points, points), "what the caller changes later must not change the artifact"
    assert np.shares_memory(cloud.points, cloud.arrays["points"])
    kept = cloud.points
    address = kept.__array_interface__["data"][0]
    del cloud
    gc.collect()
    assert kept.__array_interface__["data"][0] == address and np.array_equal(kept, points)


def test_arrays_outlive_the_run_and_the_cache(tmp_path):
    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1; 9 9 9 2")
    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1; 9 9 9 2")  # mapped
    radii, axis = run.balls.radii, run.medial_axis
    del run
    shutil.rmtree(tmp_path / "cache")
    gc.collect()
    assert radii.tolist() == [1, 1, 2]
    assert len(axis.arrays) > 0 and all(array.tobytes() is not None for array in axis.arrays.values())


def test_nodes_of_a_run():
    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1")
    load = run["load"]
    assert (load.type, load.status) == ("LoadBalls", "run") and load.seconds >= 0
    assert load.balls == run.balls == load["balls"]
    assert "load" in repr(load) and "balls" in repr(run) and "<table>" in run._repr_html_()
    with pytest.raises(KeyError, match="lode"):
        run["lode"]
    with pytest.raises(AttributeError, match="no output 'bals'"):
        run.bals
    with pytest.raises(KeyError, match="no output"):
        run.outputs["bals"]
    assert run.balls.summary["count"] == 2
    assert "balls" in dir(run) and "balls" in dir(run["load"])


def test_without_a_cache_nothing_is_written(tmp_path):
    run = bf.run("balls", file="balls:0 0 0 1", cache=False)
    assert run.balls.radii.tolist() == [1]
    assert not (tmp_path / "cache").exists()
    assert bf.run("balls", file="balls:0 0 0 1", cache=False)["load"].status == "run"


def test_an_upstream_has_what_another_cache_made(tmp_path):
    (tmp_path / "shared").mkdir(mode=0o700)
    first = bf.run("balls", file="balls:0 0 0 1", cache="one", upstream="shared")
    again = bf.run("balls", file="balls:0 0 0 1", cache="two", upstream="shared")
    assert {node.status for node in again.nodes.values()} == {"hit"} and again.balls == first.balls
    with pytest.raises(bf.UsageError, match="upstream needs the cache"):
        bf.run("balls", file="balls:0 0 0 1", cache=False, upstream="shared")
    with pytest.raises(bf.StoreError, match="absent"):
        bf.run("balls", file="balls:0 0 0 1", upstream="absent")


def test_outputs_as_files(tmp_path, program):
    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1")
    run.save(tmp_path / "out", {"balls": "csv"})
    assert (tmp_path / "out" / "balls.csv").read_text().count("\n") == 3
    assert (tmp_path / "out" / "medial_axis.ply").exists()
    run.balls.save("balls.safetensors")
    again = bf.load("balls.safetensors")
    assert again == run.balls and again.digest == run.balls.digest
    with pytest.raises(bf.UsageError, match="svgx|cannot"):
        run.balls.save("balls.svgx")
    with pytest.raises(bf.UsageError, match="no output 'bals'"):
        run.save(tmp_path / "out", {"bals": "csv"})


def test_an_input_is_never_overwritten(tmp_path):
    (tmp_path / "balls.csv").write_text("x,y,z,r\n0,0,0,1\n")
    run = bf.run("balls", file=tmp_path / "balls.csv")
    with pytest.raises(bf.UsageError, match="over the input"):
        run.save(tmp_path, {"balls": "csv"})
    assert (tmp_path / "balls.csv").read_text() == "x,y,z,r\n0,0,0,1\n"


@pytest.mark.parametrize(
    "call, kind, words",
    [
        (lambda: bf.run("medial_axes"), bf.UsageError, "medial_axis"),
        (lambda: bf.run("absent/graph.json"), bf.BallflowError, "absent/graph.json"),
        (lambda: bf.run(17), TypeError, "a name, a path or a Graph"),
        (lambda: bf.run("balls", fill=3), bf.GraphError, "file"),
        (lambda: bf.run("prune", input="shape:torus", epsilon=-1), bf.GraphError, "at least 0"),
        (lambda: bf.run("prune", input="shape:torus", epsilon=None), TypeError, "None"),
        (lambda: bf.run("prune", input="shape:torus", epsilon={}), TypeError, "epsilon"),
        (lambda: bf.run("prune", input=np.zeros((5, 2))), ValueError, "n x 3"),
        (lambda: bf.run("prune", input=(np.zeros((5, 3)), [[0, 1, 5]])), ValueError, "triangle 0"),
        (lambda: bf.run("prune", input=np.array([[0, 0, np.nan]])), ValueError, "point 0"),
        (lambda: bf.run("prune", input="shape:torus", until="prone"), bf.UsageError, "prone"),
        (lambda: bf.run("prune", input="shape:torus", threads=-1), ValueError, "threads"),
        (lambda: bf.run("prune", input="shape:torus", memory="much"), bf.UsageError, "memory"),
        (lambda: bf.run("prune", input="shape:torus", cache_size="much"), bf.UsageError, "cache_size"),
        (lambda: bf.run("prune", input="shape:torus", progress=3), TypeError, "progress"),
        (lambda: bf.run("shape_instance", prior="absent"), bf.GraphError, "absent"),
        (lambda: bf.run("experiments/table_3_1"), bf.UsageError, "sweep"),
        (lambda: bf.load("absent.safetensors"), bf.BallflowError, "absent"),
        (lambda: bf.run("balls", plugins=["absent.so"]), bf.PluginError, "absent.so"),
    ],
)
def test_what_is_wrong_is_named(call, kind, words):
    with pytest.raises(kind, match=words):
        call()


def test_a_node_that_fails_is_named_and_the_rest_is_kept():
    with pytest.raises(bf.NodeFailed) as caught:
        bf.run("prune", input="/absent/scan.ply")
    assert "scan.ply" in str(caught.value)
    (open("bad.csv", "w")).write("x,y,z,r\n0,0,0,minus\n")
    with pytest.raises(bf.NodeFailed) as caught:
        bf.run("balls", file="bad.csv")
    assert caught.value.node == "load" and "minus" in caught.value.cause
    assert caught.value.run["load"].status == "failed"
    kept = bf.run("balls", file="bad.csv", keep_going=True)
    assert kept.status == "failed"
    with pytest.raises(bf.BallflowError, match="was not computed"):
        kept.balls


def test_warnings_of_nodes_are_warnings(box, tmp_path):
    vertices, triangles = box
    with pytest.warns(bf.BallflowWarning):
        bf.run("dmt", input=(vertices, triangles[:-1]), sampling="surface")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bf.run("balls", file="balls:0 0 0 1")


def test_progress_tells_every_node_in_the_calling_thread():
    events = []

    def told(event):
        assert threading.current_thread() is threading.main_thread()
        events.append(event)

    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1", progress=told)
    finished = [event["node"] for event in events if event["event"] == "node_finished"]
    assert sorted(finished) == sorted(path for path, node in run.nodes.items() if node.status == "run")
    assert events[0]["event"] == "run_started" and events[-1]["event"] == "run_finished"


def test_progress_is_shown_where_asked(capsys):
    bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1", progress=True)
    from ballflow._progress import Lines

    lines = Lines()
    lines({"event": "node_started", "node": "a"})
    lines({"event": "node_finished", "node": "a", "status": "run", "seconds": 2.5})
    lines.close()
    assert "a done in 2.5 s" in capsys.readouterr().err


def test_the_callback_ends_a_run_and_what_is_done_stays():
    seen = []

    def stop_after_first(event):
        seen.append(event["event"])
        return "node_finished" not in seen

    with pytest.raises(bf.Cancelled) as caught:
        bf.run("medial_axis", input="shape:sTube", progress=stop_after_first)
    done = [path for path, node in caught.value.run.nodes.items() if node.status == "run"]
    assert done and caught.value.run.status == "cancelled"
    again = bf.run("medial_axis", input="shape:sTube", until=done[0], progress=lambda event: None)
    assert again.nodes[done[0]].status == "hit"


def test_an_exception_of_the_callback_ends_the_run_and_is_raised():
    def broken(event):
        raise ZeroDivisionError("in the callback")

    with pytest.raises(ZeroDivisionError, match="in the callback"):
        bf.run("medial_axis", input="shape:sTube", progress=broken)


def test_ctrl_c_ends_a_run():
    # In a process of its own, so that the signal meets nobody else.
    done = in_child(
        """
import os, signal, threading, time
import ballflow as bf
started = threading.Event()
def interrupt():
    started.wait(); os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
def told(event):
    if event["event"] == "node_finished": started.set()
begin = time.process_time()
try:
    bf.run("medial_axis", input="shape:doubleTorus", epsilon=.05, delta=.05, progress=told)
    print("ended")
except KeyboardInterrupt:
    print("interrupted")
run = bf.run("balls", file="balls:0 0 0 1")
print(run.status)
"""
    )
    assert done.stdout.split() == ["interrupted", "ok"], done.stderr


def test_four_threads_share_a_cache():
    results, failures = {}, []

    def work(i):
        try:
            for epsilon in (0.5, 1.0):
                run = bf.run("prune", input="shape:sTube", epsilon=epsilon, strategy="greedy")
                results[i, epsilon] = run.balls.digest
        except BaseException as problem:
            failures.append(problem)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
    for epsilon in (0.5, 1.0):
        assert len({results[i, epsilon] for i in range(4)}) == 1


def test_other_threads_go_on_while_nodes_run():
    counted = 0
    stop = threading.Event()

    def count():
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    bf.run("medial_axis", input="shape:sTube", epsilon=0.7)
    stop.set()
    thread.join()
    assert counted > 5


def test_a_fork_leaves_the_parent_alone_and_says_what_to_do():
    done = in_child(
        """
import os, sys
import ballflow as bf
first = bf.run("balls", file="balls:0 0 0 1")
child = os.fork()
if child == 0:
    try:
        bf.run("balls", file="balls:0 0 0 1")
        code = 1
    except bf.BallflowError as error:
        code = 0 if "spawn" in str(error) else 2
    assert first.balls.radii.tolist() == [1]  # what is in memory stays usable
    del first
    sys.stdout.flush()
    os._exit(code)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
print(bf.run("balls", file="balls:0 0 0 1").status)
""",
    )
    assert done.stdout.split() == ["0", "ok"], done.stderr


def test_a_fork_before_the_first_use_works():
    done = in_child(
        """
import multiprocessing
import ballflow as bf
def work(radius):
    return bf.run("balls", file=f"balls:0 0 0 {radius}").balls.radii.tolist()
if __name__ == "__main__":
    with multiprocessing.get_context("fork").Pool(2) as pool:
        print(pool.map(work, [1, 2, 3]))
"""
    )
    assert done.stdout.strip() == "[[1.0], [2.0], [3.0]]", done.stderr


def test_the_viewer_shows_a_run(monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    run = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1")
    page = open(run.view(), encoding="utf-8").read()
    assert "<html" in page and opened and opened[0].startswith("file://")
    uncached = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1", cache=False)
    assert "<html" in open(uncached.view(), encoding="utf-8").read()
    for url in opened:
        os.remove(url[len("file://") :])
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_notebook_gets_a_frame(monkeypatch):
    import html
    import sys
    import types

    kernel = types.SimpleNamespace(config={"IPKernelApp": {}})
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: kernel))
    monkeypatch.setattr("webbrowser.open", lambda url: pytest.fail("a browser was opened"))
    frame = bf.run("balls", file="balls:0 0 0 1; 1.5 0 0 1").view(height=300)._repr_html_()
    assert frame.startswith('<iframe srcdoc="') and 'height="300"' in frame
    page = html.unescape(frame[len('<iframe srcdoc="') : frame.index('" width=')])
    assert page.lstrip().lower().startswith("<!doctype html>") and "balls" in page

"""The Python package beside a run of the program (SCENE, its folder), then the examples (their folder), small."""

import csv
import importlib.metadata
import sys
import threading
from pathlib import Path

import numpy as np
import orzo

SCENE, RUN, EXAMPLES = sys.argv[1:]


def fails(error, words, call):
    try:
        call()
    except error as told:
        assert words in str(told), told
        return
    raise AssertionError(f"expected {error.__name__}: {words}")


def places(friction):
    with orzo.Scene(SCENE, settings={"contact.friction": friction}) as scene:
        scene.run_to(0.03)
        return scene.position


def test_bytes_of_the_program():
    """Grains at the end are final.csv's to the bit, columns those of series.csv as written."""
    with orzo.Scene(SCENE) as scene:
        rows = [scene.row() for _ in scene.times(every=scene.period / 2)]
        with open(Path(RUN) / "final.csv") as file:
            final = list(csv.DictReader(file))
        for name, values in (("x y z", scene.position), ("vx vy vz", scene.velocity)):
            expected = [[float(row[key]) for key in name.split()] for row in final]
            assert np.array_equal(values, expected), name
        with open(Path(RUN) / "series.csv") as file:
            series = list(csv.DictReader(file))
        assert len(rows) == len(series) and list(rows[0]) == list(series[0]) == scene.columns
        for row, expected in zip(rows, series):
            for name, text in expected.items():
                assert (f"{row[name]:.9g}" == text) or (text == "" and np.isnan(row[name])), name


def test_arrays():
    with orzo.Scene(SCENE) as scene:
        scene.run_to(0.011)
        out = np.empty((30, 3))
        assert scene.read("axis", out) is out and np.allclose(np.linalg.norm(out, axis=1), 1)
        contacts = scene.contacts()
        assert contacts.dtype == orzo.CONTACT and len(contacts) > 0
        assert np.allclose(np.linalg.norm(contacts["normal"], axis=1), 1)
        assert len(scene) == 30 and scene.mass.shape == scene.length.shape == (30,)
        assert "friction: 0" in scene.text
        fails(ValueError, "contiguous", lambda: scene.read("axis", np.empty((30, 4))))
        fails(KeyError, "expected one of position", lambda: scene.read("axes"))


def test_version():
    assert importlib.metadata.version("orzo") == orzo.version()


def test_failures():
    fails(orzo.InputError, "nowhere.yaml", lambda: orzo.Scene("nowhere.yaml"))
    fails(orzo.InputError, "contact.frction", lambda: orzo.Scene(SCENE, settings={"contact.frction": 1}))
    with orzo.Scene(SCENE) as scene:
        fails(orzo.InputError, "scene's end", lambda: scene.run_to(1))
    fails(ValueError, "closed", lambda: scene.run_to(0.01))


def test_threads():
    """Two scenes in threads of their own: the bits of one after the other."""
    together = [None, None]

    def run(k):
        together[k] = places((0.2, 0.5)[k])

    threads = [threading.Thread(target=run, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k in range(2):
        assert np.array_equal(together[k], places((0.2, 0.5)[k]))
    assert not np.array_equal(*together)


def test_outside():
    """Changed, driven and pushed while it runs; a state goes on to the bit."""
    with orzo.Scene(SCENE) as scene:
        scene.run_to(0.005)
        scene["contact.friction"] = 0.4
        offset = scene.wall(0)[0]
        scene.drive_wall(0, 0.05)
        scene.push([[0, 0, 1e-5], [0, 0, 2e-5]], grains=[3, 4])
        scene.run_to(0.01)
        scene.save("python.h5")
        assert abs(scene.wall(0)[0] - offset - 0.05 * 0.005) < 1e-12
        scene.run_to(0.02)
        with orzo.Scene.load("python.h5") as other:
            other.run_to(0.02)
            assert np.array_equal(scene.position, other.position)
        scene.push(None)
        fails(ValueError, "as many", lambda: scene.push([[0, 0, 1]], grains=[1, 2]))


def test_picture():
    with orzo.Scene(SCENE, settings={"movie": {"size": [160, 120]}}) as scene:
        picture = scene.draw()
        assert picture.shape == (120, 160, 4) and len(np.unique(picture.reshape(-1, 4), axis=0)) > 50


def test_examples():
    sys.path.insert(0, EXAMPLES)
    import calibrate_friction
    import calibrate_with_grainlearning
    import control_floor
    import plot_angle
    import to_pandas

    plot_angle.main(3)
    assert Path("angle.png").stat().st_size > 5000
    late, wanted, rest = control_floor.main(60)
    assert abs(late - wanted) < 0.2 * (wanted - rest)  # a tap of 30 grains scatters by that
    series, grains = to_pandas.main(SCENE)
    assert len(series) == 17 and len(grains) == 30 and series["angle"].between(0, 90).all()
    # the heap of friction 0.3, whose angle is then asked for
    angle = calibrate_friction.mean_angle(0.3, 2)[0]
    friction = calibrate_friction.main(angle, steps=4, seeds=2)
    assert abs(friction - 0.3) < 0.15  # two seeds tell an angle to 0.5 degrees, friction to 0.05; the last interval is 0.06 wide
    angle, reach = calibrate_friction.heaps(0.3, 2).mean(axis=0)
    friction, spread = calibrate_with_grainlearning.main(angle, reach, iterations=2, samples=8, seeds=2)
    assert abs(friction - 0.3) < 0.15 and 0 < spread < 0.2  # as above; the second samples are drawn from the first eight


def test_notebook():
    """The angle is plotted in one place of a notebook, again and again."""
    import nbclient
    import nbformat

    cell = f"import sys; sys.path.insert(0, {EXAMPLES!r}); import plot_angle; plot_angle.main(3)"
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell)])
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    outputs = notebook.cells[0].outputs
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == 1 and any("3 taps" in output.get("text", "") for output in outputs)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print(name)

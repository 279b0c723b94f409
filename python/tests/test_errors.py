# SPDX-License-Identifier: Apache-2.0
"""What is not clear is asked for, what is wrong is said with the command's words, and Ctrl-C ends work."""
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import trueaxis as ta

ROOT = Path(__file__).resolve().parents[2]
COMMAND = os.environ["TRUEAXIS_COMMAND"]
STREAM = ROOT / "data/streams/shaft_cone_seat.csv"
UNITS = {"x_unit": "mm radius", "c_unit": "rad", "z_unit": "mm"}


def cylinder(n=400):
    c, z = np.linspace(0.0, 60.0, n), np.linspace(0.0, 30.0, n)
    return 20.0 + 0.05 * np.cos(c), c, z


@pytest.mark.parametrize("left_out", ["x_unit", "c_unit", "z_unit"])
def test_no_unit_is_guessed(left_out):
    x, c, z = cylinder()
    units = {key: unit for key, unit in UNITS.items() if key != left_out}
    with pytest.raises(ta.InputError, match="say what x is"):
        ta.fit(x, c, z, surface="cylinder", **units)


@pytest.mark.parametrize("x_unit", ["mm", "radius", "furlong radius"])
def test_a_unit_must_say_all(x_unit):
    x, c, z = cylinder()
    with pytest.raises(ta.InputError):
        ta.fit(x, c, z, surface="cylinder", **{**UNITS, "x_unit": x_unit})


def test_radius_or_diameter_is_not_guessed_from_a_column():
    x, c, z = cylinder()
    with pytest.raises(ta.InputError, match="X_M"):
        ta.fit({"X_M[mm]": x, "C[rad]": c, "Z[mm]": z}, surface="cylinder")


def test_wrong_arrays_are_refused():
    x, c, z = cylinder()
    with pytest.raises(ta.InputError, match="equal length"):
        ta.fit(x, c[:-1], z, surface="cylinder", **UNITS)
    for value in (np.nan, np.inf, 1e301):
        broken = x.copy()
        broken[7] = value
        with pytest.raises(ta.InputError, match=r"^x\[7\]: "):
            ta.fit(broken, c, z, surface="cylinder", **UNITS)
    with pytest.raises(ta.InputError, match="C never moves"):
        ta.fit(x, 0 * c, z, surface="cylinder", **UNITS)
    with pytest.raises(ValueError):
        ta.fit(["a"], ["b"], ["c"], surface="cylinder", **UNITS)


def test_rows_without_a_value_are_left_out_if_asked():
    x, c, z = cylinder()
    x[[7, 9]] = np.nan
    with pytest.raises(ta.InputError) as error:  # no command could read an array
        ta.stream(x, c, z, **UNITS)
    assert "2 rows have no value: drop_invalid=True excludes them" in str(error.value) and "import" not in str(error.value)
    stream = ta.stream(x, c, z, drop_invalid=True, **UNITS)
    assert len(stream) == len(x) - 2 and stream.read_as


@pytest.mark.parametrize("option", [{"surface": "coin"}, {"loss": "none"}, {"noise_um": -1.0}, {"noise_um": np.nan},
                                    {"ball_radius_mm": -1.0}, {"coverage_factor": 0.0}])
def test_wrong_options_are_refused(option):
    x, c, z = cylinder()
    with pytest.raises(ta.InputError):
        ta.fit(x, c, z, **{"surface": "cylinder", **UNITS, **option})


def test_the_text_is_that_of_the_command():
    words = [COMMAND, "fit", "data/streams/none.csv", "--surface", "cone"]
    said = subprocess.run(words, capture_output=True, text=True, cwd=ROOT).stderr.strip()
    os.chdir(ROOT)
    with pytest.raises(ta.InputError) as error:
        ta.fit("data/streams/none.csv", surface="cone")
    assert str(error.value) == said


def test_what_is_not_determined_is_an_error_with_what_is():
    x, c, z = cylinder()
    with pytest.raises(ta.NumericalError) as error:  # a cylinder of no length has no direction
        ta.fit(x, c, 0 * z, surface="cylinder", **UNITS)
    result = error.value.result
    assert result.status == "rank_deficient" and not np.isfinite(result.l.u)


def test_few_readings_are_an_input_error():
    x, c, z = cylinder(4)
    with pytest.raises(ta.InputError, match="probe more"):
        ta.fit(x, c, z, surface="cylinder", **UNITS)


def test_points_have_three_coordinates():
    with pytest.raises(ta.InputError, match="x, y, z"):
        ta.associate(np.zeros((5, 2)), element="circle")
    with pytest.raises(ta.InputError):
        ta.associate(np.zeros((5, 3)), element="circle", criterion="best")
    with pytest.raises(ta.InputError, match="material"):
        ta.associate(np.zeros((5, 3)), element="circle", criterion="constrained")


def test_progress_is_called_and_may_end_the_work():
    seen = []

    class Enough(Exception):
        pass

    def progress(seconds, share):
        seen.append(seconds)
        raise Enough

    scenario = ROOT / "data/sweeps/noise.toml"
    with pytest.raises(Enough):
        ta.sweep(scenario, progress=progress)
    assert seen and 0.0 < seen[0] < 1.0


def test_progress_has_the_share_that_is_done(tmp_path):
    """Of fewer repeats the work takes seconds, which is some tens of calls."""
    text = (ROOT / "data/sweeps/noise.toml").read_text().replace("repeats = 2000", "repeats = 300")
    (tmp_path / "noise.toml").write_text(text.replace("../scenarios", str(ROOT / "data/scenarios")))
    shares = []
    ta.sweep(tmp_path / "noise.toml", progress=lambda _, share: shares.append(share))
    counted = [one for one in shares if one is not None]
    assert len(set(counted)) > 2 and all(0.0 <= one <= 1.0 for one in counted)
    assert counted == sorted(counted)


LONG = {
    "fit": "ta.fit(stream, surface='cone')",
    "sweep": "ta.sweep('data/sweeps/table1.toml')",
    "plan": "ta.plan(goal_um=0.2, free={'readings_per_revolution': (4, 400)}, repeats=100000)",
    "form": "ta.form('data/streams/shaft_cone_seat.csv', trials=1000000, band_upr=(1, 15))",
    "diagnose": "ta.diagnose(x, c, z, surface='cone', x_unit='mm radius', c_unit='rad', z_unit='mm')",
    "run_job": "ta.run_job('data/jobs/shaft.toml')",
}


@pytest.mark.parametrize("work", LONG)
def test_ctrl_c_ends_work(work):
    """A process of its own is told to stop 0.3 s after it began; its own clock says what it then takes."""
    made = """
import time, signal, threading, os, numpy as np, trueaxis as ta
n = %s
c, z = np.linspace(0, 3000, n), np.linspace(0, 60, n)
x = 25 + z / 8 + 0.05 * np.cos(c) + 1e-3 * np.random.default_rng(1).normal(size=n) + 2e-3 * np.cos(3 * c)
stream = ta.stream(x, c, z, x_unit='mm radius', c_unit='rad', z_unit='mm')
told = []
def tell():
    time.sleep(0.3); told.append(time.process_time()); os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=tell).start()
try:
    %s
    print("ended before")
except KeyboardInterrupt:
    print((time.process_time() - told[0]) / os.cpu_count())
""" % (3000000 if work == "fit" else 300000, LONG[work])
    ran = subprocess.run([sys.executable, "-c", made], capture_output=True, text=True, cwd=ROOT, timeout=60)
    if ran.stdout.strip() == "ended before":
        pytest.skip("this machine is quicker than 0.3 s")
    # Promised are 0.2 s on an idle machine: as much processor time of each core, whatever else the machine does.
    assert ran.stdout and float(ran.stdout) < 0.2, ran.stdout + ran.stderr


def test_other_threads_of_python_go_on():
    beats = []
    ended = threading.Event()

    def beat():
        while not ended.is_set():
            beats.append(time.perf_counter())
            time.sleep(0.005)

    thread = threading.Thread(target=beat)
    thread.start()
    begun = time.perf_counter()
    ta.diagnose(STREAM, surface="cone")
    passed = time.perf_counter() - begun
    ended.set()
    thread.join()
    during = [one for one in beats if begun < one < begun + passed]
    assert len(during) > 0.1 * passed / 0.005


def test_commands_in_threads_do_not_mix_their_words():
    results = {}

    def plan(goal_um):
        results[goal_um] = ta.plan(goal_um=goal_um, free={"readings_per_revolution": (4, 200)}, repeats=100)

    threads = [threading.Thread(target=plan, args=(goal,)) for goal in (1.0, 2.0)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for goal_um, found in results.items():
        assert f"{goal_um:g} µm" in str(found)


def test_a_value_that_is_hidden_missing_or_no_number_is_no_reading():
    pandas = pytest.importorskip("pandas")
    x, c, z = cylinder()
    hidden = np.ma.masked_greater(x + np.where(np.arange(len(x)) == 7, 5.0, 0.0), 24.0)
    missing = pandas.Series(x).astype("Float64")
    missing[7] = pandas.NA
    for broken in (hidden, missing):
        with pytest.raises(ta.InputError, match=r"^x\[7\]: "):
            ta.fit(broken, c, z, surface="cylinder", **UNITS)
        assert len(ta.stream(broken, c, z, drop_invalid=True, **UNITS)) == len(x) - 1
    for broken in (x + 0j, ["a"] * len(x), x > 0):
        with pytest.raises(ta.InputError, match="^x: not.*numbers"):
            ta.fit(broken, c, z, surface="cylinder", **UNITS)
    points = np.ma.masked_greater(np.random.default_rng(1).normal(size=(30, 3)), 1.5)
    for function in (ta.associate, ta.form):
        with pytest.raises(ta.InputError, match=r"^points\[\d+\]:.*not finite"):
            function(points, element="plane")
    with pytest.raises(ta.InputError, match="^t_s: not.*numbers"):
        ta.fit(x, c, z, surface="cylinder", t_s=pandas.date_range("2026-01-01", periods=len(x)), **UNITS)


def test_columns_whose_indexes_differ_are_not_mixed_up():
    pandas = pytest.importorskip("pandas")
    x, c, z = (pandas.Series(one) for one in cylinder())
    kept = z > 5.0
    ta.fit(x[kept], c[kept], z[kept], surface="cylinder", **UNITS)
    with pytest.raises(ta.InputError, match="indexes"):
        ta.fit(x.sort_values(), c, z, surface="cylinder", **UNITS)


@pytest.mark.parametrize("readings", ["a.csv", cylinder()[0]])
def test_an_argument_that_is_not_there_is_named(readings):
    with pytest.raises(ta.InputError, match="zunit.*it takes"):
        ta.fit(readings, surface="cylinder", zunit="mm")
    with pytest.raises(ta.InputError, match="radius: .*radius_mm"):
        ta.plan(surface="cylinder", radius=20.0, goal_um=1.0)
    with pytest.raises(ta.InputError, match="length_mm.*range"):
        ta.plan(goal_um=1.0, free={"length_mm": 10})


@pytest.mark.parametrize("named, said", [({"c_unit": "rad"}, r"c_unit: not for a file.*C\[rad\].*columns="),
                                         ({"surface": "cylinder"}, r"surface: there is no such argument.*help\(\)")])
def test_an_argument_that_does_not_go_with_a_file_has_its_remedy(named, said):
    with pytest.raises(ta.InputError, match=said):
        ta.form("data/streams/shaft_cone_seat.csv", **named)


def test_an_element_is_for_points():
    with pytest.raises(ta.InputError, match="element: .*leave it out"):
        ta.form("data/streams/shaft_cone_seat.csv", element="cylinder")


@pytest.mark.parametrize("named, said", [({"c_unit": "rad"}, "c_unit: a stream has its units.*leave"),
                                         ({"surface": "cylinder"}, r"surface: there is no such argument.*help\(\)")])
def test_an_argument_that_does_not_go_with_a_stream_has_its_remedy(named, said):
    x, c, z = cylinder()
    with pytest.raises(ta.InputError, match=said):
        ta.form(ta.stream(x, c, z, **UNITS), **named)


def test_a_file_without_units_is_read_in_those_stated_of_its_names(tmp_path):
    x, c, z = cylinder()
    x = x + np.random.default_rng(2).normal(0.0, 1e-3, len(x))
    path = tmp_path / "export.csv"
    np.savetxt(path, np.stack([2 * x, c, z], axis=1), delimiter=",", header="Dia,Angle,Pos", comments="", fmt="%.9f")
    fit = ta.fit(path, surface="cylinder", x="diameter", columns="X=Dia,C=Angle[rad],Z=Pos")
    # Nine decimals: x0 moves by less than the largest rounding, of C by 0.05 mm × 5e-10.
    assert fit.x0.value == pytest.approx(ta.fit(x, c, z, surface="cylinder", **UNITS).x0.value, abs=1e-8)


def test_a_refusal_says_why():
    """The part slips by 40 µm in the middle of the readings."""
    x, c, z = cylinder(800)
    moved = x + np.where(np.arange(len(x)) < 400, 0.0, 0.04) * np.cos(c)
    with pytest.raises(ta.Refused, match="(?s)not known.*slipped") as error:
        ta.fit(moved + np.random.default_rng(1).normal(0.0, 1e-3, len(x)), c, z, surface="cylinder", **UNITS)
    assert error.value.result.to_dict()["parameters"]["x0"]["value"] is None



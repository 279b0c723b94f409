# SPDX-License-Identifier: Apache-2.0
"""A message names what was given: an argument and an index of an array, a key of a dictionary; no line of a file that nobody wrote."""
import numpy as np
import pytest
import trueaxis as ta
from trueaxis._words import in_python

UNITS = {"x_unit": "mm radius", "c_unit": "rad", "z_unit": "mm"}
PART = {"surface": "cylinder", "radius_mm": 20}
PASS = {"z_start_mm": 5, "z_end_mm": 65}


def cylinder(n=1000, rpm=60.0):
    """Twenty revolutions with 1 µm of noise, and their times in s."""
    c, z = np.linspace(0.0, 40.0 * np.pi, n), np.linspace(0.0, 30.0, n)
    x = 25.0 + 0.04 * np.cos(c) + np.random.default_rng(1).normal(0.0, 1e-3, n)
    return x, c, z, c / (2.0 * np.pi) * 60.0 / rpm


def message(call):
    with pytest.raises(ta.TrueAxisError) as error:
        call()
    return str(error.value)


def with_value(column, at, value):
    changed = np.array(column)
    changed[at] = value
    return changed


def test_an_array_has_its_argument_and_its_index():
    x, c, z, t = cylinder()
    assert message(lambda: ta.fit(with_value(x, 7, np.nan), c, z, surface="cylinder", **UNITS)).startswith("x[7]: ")
    assert message(lambda: ta.fit(x, c, with_value(z, 9, np.inf), surface="cylinder", **UNITS)).startswith("z[9]: ")
    assert message(lambda: ta.fit(x, c, z, t_s=with_value(t, 5, -1.0), surface="cylinder", **UNITS)).startswith("t_s[5]: falls")
    lost_points = with_value(x, [100, 300, 500, 700], 10.0 * x[[100, 300, 500, 700]])
    assert "at index 100)" in message(lambda: ta.fit(lost_points, c, z, surface="cylinder", **UNITS))
    assert message(lambda: ta.stream(x, c, z[:-1], **UNITS)).endswith("x (1000,), c (1000,), z (999,)")


def test_a_table_has_its_columns():
    x, c, z, _ = cylinder()
    table = {"X_M[mm dia]": with_value(2.0 * x, 7, np.nan), "C[rad]": c, "Z[mm]": z}
    assert message(lambda: ta.fit(table, surface="cylinder")).startswith("X_M[7]: ")
    assert "C[rad]" in message(lambda: ta.fit({"X_M[mm dia]": 2.0 * x, "C[deg]": c, "Z[mm]": z}, surface="cylinder"))


@pytest.mark.parametrize("as_stream", [False, True])
def test_a_unit_is_that_of_the_argument(as_stream):
    x, c, z, _ = cylinder()
    units = {**UNITS, "c_unit": "deg"}
    readings = (ta.stream(x, c, z, **units),) if as_stream else (x, c, z)
    text = message(lambda: ta.fit(*readings, surface="cylinder", **({} if as_stream else units)))
    assert 'c_unit="rad"' in text and "C[" not in text


def test_an_option_is_an_argument():
    x, c, z, _ = cylinder()
    with_gap = with_value(x, 7, np.nan)
    text = message(lambda: ta.fit(with_gap, c, z, surface="cylinder", **UNITS))
    assert "drop_invalid=True" in text and "--" not in text
    assert 'surface="section"' in message(lambda: ta.fit(x, c, surface="cylinder", x_unit="mm radius", c_unit="rad"))
    for text, said in (("50 UPR (--upr 1-10)", "50 UPR (band_upr=(1, 10))"), ("use --force", "use force=True"),
                       ("`trueaxis fit A --surface cone` or --nominal-radius-mm 3", "`trueaxis fit A --surface cone` or nominal_radius_mm=3")):
        assert in_python(text, None) == in_python(said, None) == said


def test_a_file_has_the_arguments_that_read_it(tmp_path):
    x, c, z, _ = cylinder()
    path = tmp_path / "export.csv"
    np.savetxt(path, np.stack([c, z, 2.0 * x], axis=1), delimiter=",", header="winkel,pos,dia", comments="", fmt="%.7f")
    text = message(lambda: ta.fit(path, surface="cylinder"))
    assert text.splitlines()[-1] == f'{path}: the arguments that would read it: columns="X=3,C=1,Z=2"'
    said = "the command that would read it: trueaxis import 'a b.csv' --columns 'X=1[mm],C=2' --skip 3 -o a_stream.csv --diameter (or --radius)"
    assert in_python(said, None) == 'the arguments that would read it: columns="X=1[mm],C=2", skip=3, x="diameter" (or x="radius")'


def test_a_table_whose_names_say_nothing_is_asked_for_its_columns():
    x, c, z, _ = cylinder()
    text = message(lambda: ta.fit({"dia": 2.0 * x, "angle": c, "pos": z}, surface="cylinder"))
    assert "table['dia']" in text and "X_M[mm dia]" in text and "dia, angle, pos" in text


def test_exchanged_columns_are_arguments():
    x, c, z, _ = cylinder()
    assert "exchange the arguments" in message(lambda: ta.fit(x, z, np.degrees(c) % 360, surface="cylinder", **{**UNITS, "c_unit": "deg"}))


def test_a_screen_has_no_option_of_the_command():
    x, c, z, _ = cylinder()
    for found in (ta.form(x, c, z, **UNITS), ta.diagnose(x, c, z, surface="cylinder", **UNITS)):
        assert "--" not in str(found)


def test_metadata_are_an_argument():
    x, c, z, _ = cylinder()
    assert 'metadata={"spindle_rpm": 60}' in message(lambda: ta.stream(x, c, z, metadata={"spindle_rp": 60}, **UNITS))


def test_milliseconds_as_seconds_are_refused():
    x, c, z, t = cylinder()
    text = message(lambda: ta.fit(x, c, z, t_s=1e3 * t, surface="cylinder", **UNITS))
    assert "0.06 rpm" in text and "divide t_s by 1000" in text
    assert "60000 rpm" in message(lambda: ta.stream(x, c, z, t_s=1e-3 * t, **UNITS))
    ta.stream(x, c, z, t_s=t, **UNITS)
    ta.stream(x, c, z, t_s=1e3 * t, metadata={"spindle_rpm": 0.06}, **UNITS)  # who states it means it


@pytest.mark.parametrize("document, place", [
    ({"part": PART, "pass": [PASS], "nois": {}}, "scenario: the top level has no key `nois`"),
    ({"part": {**PART, "radius": 3}, "pass": [PASS]}, 'scenario["part"]["radius"]: '),
    ({"part": PART, "pass": [PASS, {**PASS, "feed": 1}]}, 'scenario["pass"][1]["feed"]: '),
    ({"part": PART, "pass": [PASS], "noise": {"sigma_um": None}}, 'scenario["noise"]["sigma_um"]: None is not')])
def test_a_dictionary_has_its_keys(document, place):
    for call in (lambda: ta.simulate(document), lambda: ta.plan(document, goal_um=1.0)):
        text = message(call)
        assert text.startswith(place) and ".toml" not in text


def test_a_point_has_its_index_and_an_element_its_argument():
    points = np.random.default_rng(1).normal(size=(30, 3))
    points[5, 1] = np.nan
    for function in (ta.associate, ta.form):
        assert message(lambda: function(points, element="plane")).startswith("points[5]: ")
    assert message(lambda: ta.associate(points[:5], element="plain")).startswith("'plain' is not an element: use one of")


def test_what_is_missing_at_the_top_of_a_dictionary_is_not_of_its_first_key():
    text = message(lambda: ta.Machine({"axis": [{"name": "X"}]}))
    assert all(line.startswith("machine: ") for line in text.splitlines()) and "`program` in the top level" in text


def test_a_dictionary_of_a_sweep_names_the_axis():
    grid = [{"key": "noise.sigma_um", "values": [1, 2]}, {"key": "noise.sigma_um", "value": [1]}]
    assert 'sweep["axis"][1]' in message(lambda: ta.sweep({"part": PART, "pass": [PASS], "repeats": 2, "axis": grid}))


@pytest.mark.parametrize("known, said", [
    ({"height": "0±0.1"}, "known: there is no key `height`, did you mean `height_mm`?"),
    ({"lag_m": "0.4±0.1"}, "known: there is no key `lag_m`, did you mean `lag_ms`?"),
    ({"lag_ms": "0.4"}, "known: `lag_ms` needs its standard uncertainty: write lag_ms=0.4±u")])
def test_a_known_value_has_one_complaint(known, said):
    x, c, z, _ = cylinder()
    text = message(lambda: ta.diagnose(x, c, z, surface="cylinder", known=known, **UNITS))
    assert text.startswith(said) and "\n" not in text

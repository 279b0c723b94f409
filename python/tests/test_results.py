# SPDX-License-Identifier: Apache-2.0
"""Results: values, units, arrays and JSON, against the truth of made readings and against the command."""
import copy
import html
import json
import os
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest
import trueaxis as ta
from trueaxis._toml import to_toml

ROOT = Path(__file__).resolve().parents[2]
COMMAND = os.environ["TRUEAXIS_COMMAND"]
SIGMA_MM = 1e-3


def cone(n=2000, seed=3, half_angle_deg=7.0, offset_mm=0.08):
    """Readings of a cone of 25 mm at Z = 0 whose axis is parallel to the spindle, by Eq. 7 written out:
    the probe along Y = 0 meets radius r about a centre (a cos C, a sin C) at X = a cos C + sqrt(r² − a² sin² C)."""
    rng = np.random.default_rng(seed)
    c, z = np.linspace(0.0, 2.0 * np.pi * n / 40.0, n), np.linspace(0.0, 40.0, n)
    r = 25.0 + z * np.tan(np.radians(half_angle_deg))
    x = offset_mm * np.cos(c) + np.sqrt(r**2 - (offset_mm * np.sin(c)) ** 2)
    return x + rng.normal(0.0, SIGMA_MM, n), c, z


UNITS = {"x_unit": "mm radius", "c_unit": "rad", "z_unit": "mm"}


def test_a_fit_finds_the_part_within_its_uncertainty():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    # P(|error| > 4.5 u) = 7e-6 for a normal error; the seed is fixed.
    for name, truth in (("half_angle", 7.0), ("x0", 0.08), ("y0", 0.0), ("l", 0.0), ("m", 0.0)):
        one = getattr(fit, name)
        assert abs(one.value - truth) < 4.5 * one.u, name
    assert fit.half_angle.unit == "deg" and fit.x0.unit == "mm"
    assert fit.half_angle.U == 2.0 * fit.half_angle.u
    # RMS of n readings less 6 parameters: σ within 5/√(2n) of itself.
    assert abs(fit.rms.value / SIGMA_MM - 1.0) < 5.0 / np.sqrt(2 * len(x))


def test_a_stated_noise_counts_if_it_is_the_larger():
    x, c, z = cone()
    u = {noise_um: ta.fit(x, c, z, surface="cone", noise_um=noise_um, **UNITS).x0.u for noise_um in (None, 0.5, 2.0, 4.0)}
    assert u[0.5] == u[None]  # the readings show 1 µm
    assert u[4.0] == pytest.approx(2.0 * u[2.0], rel=1e-9)  # u is proportional to σ
    assert u[2.0] > u[None]


def test_the_units_of_the_arrays_are_those_said():
    x, c, z = cone()
    first = ta.fit(x, c, z, surface="cone", **UNITS)
    same = [ta.fit(2.0 * x, np.degrees(c), z / 25.4, surface="cone", x_unit="mm diameter", c_unit="deg", z_unit="in"),
            ta.fit({"X_M[um dia]": 2000.0 * x, "C[rev]": c / (2.0 * np.pi), "Z[mm]": z}, surface="cone")]
    for other in same:
        assert other.half_angle.value == pytest.approx(first.half_angle.value, abs=1e-9)
        assert other.x0.value == pytest.approx(first.x0.value, abs=1e-9)


def test_arrays_are_views_and_do_not_change():
    x, c, z = cone()
    stream = ta.stream(x, c, z, **UNITS)
    fit = ta.fit(stream, surface="cone")
    residual = fit.residual_mm
    assert residual.shape == x.shape and not residual.flags.writeable and not residual.flags.owndata
    assert np.sqrt(np.mean(residual**2)) == pytest.approx(fit.rms.value, rel=1e-12)
    assert np.array_equal(stream.reading_mm, x)
    del fit, stream
    assert np.isfinite(residual).all()
    with pytest.raises(ValueError):
        residual[0] = 1.0


def test_results_do_not_change():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    for change in (lambda: setattr(fit, "rms", 0.0), lambda: setattr(fit.noise, "sigma", 0.0),
                   lambda: setattr(fit.x0, "value", 0.0)):
        with pytest.raises(AttributeError):
            change()
    before = fit.to_dict()
    before["parameters"].clear()
    assert fit.to_dict()["parameters"]
    with pytest.raises(AttributeError, match="half_angle"):
        fit.half_anlge


def test_the_covariance_has_names():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    covariance = fit.covariance
    assert covariance.names == ("x0", "y0", "l", "m", "k", "half_angle")
    for i, name in enumerate(covariance.names):
        assert np.sqrt(covariance.matrix[i, i]) == pytest.approx(getattr(fit, name).u, rel=1e-9)
    assert np.allclose(np.diag(covariance.correlation()), 1.0)
    assert covariance.between("x0", "l") == covariance.matrix[0, 2]


def command(*words, code=0):
    ran = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True, cwd=ROOT)
    assert ran.returncode == code, ran.stderr
    return ran.stdout


STREAM = ROOT / "data/streams/shaft_cone_seat.csv"


def test_to_dict_is_the_json_of_the_command():
    path = "data/streams/shaft_cone_seat.csv"
    os.chdir(ROOT)
    assert ta.fit(path, surface="cone").to_dict() == json.loads(command("fit", path, "--surface", "cone", "--json", "-"))
    assert ta.fit(path, surface="cone", loss="huber", noise_um=3).to_json() == command(
        "fit", path, "--surface", "cone", "--loss", "huber", "--noise-um", "3", "--json", "-")
    assert ta.diagnose(path, surface="cone").to_json() == command(
        "diagnose", path, "--surface", "cone", "--json", "-")
    assert ta.form(path, band_upr=(1, 15)).to_json() == command("form", path, "--upr", "1-15", "--json", "-")


def test_print_shows_the_screen_of_the_command():
    os.chdir(ROOT)
    fit = ta.fit("data/streams/shaft_cone_seat.csv", surface="cone")
    lines = str(fit).splitlines()
    shown = command("fit", "data/streams/shaft_cone_seat.csv", "--surface", "cone").splitlines()
    assert lines[0] == shown[0]
    assert lines[0] in repr(fit)


def test_pandas_has_every_quantity():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    table = fit.to_pandas()
    assert table.loc["parameters.half_angle", "unit"] == "deg"
    assert table.loc["parameters.half_angle", "U"] == fit.half_angle.U
    diagnosis = ta.diagnose(STREAM, surface="cone")
    assert len(diagnosis.to_pandas()) > len(table)


def test_pandas_has_what_an_entry_of_a_list_is_of():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    assert fit.to_pandas().loc["budget.0.u.x0", "of"] == fit.budget[0].source != ""
    form = ta.form(x, c, z, **UNITS)
    circles = form.to_pandas().filter(regex=r"^sections\.0\.circles\.\d\.radius$", axis="index")["of"]
    assert list(circles) == [one.reference for one in form.sections[0].circles] and len(set(circles)) == len(circles) > 1
    diagnosis = ta.diagnose(STREAM, surface="cone")
    table = diagnosis.to_pandas()
    for i, finding in enumerate(diagnosis.findings):
        assert set(table.filter(regex=rf"^findings\.{i}\.parameters", axis="index")["of"]) == {finding.effect}


def test_the_circle_around_a_profile_has_no_peak_and_the_circle_in_it_no_valley():
    """By their definitions: RONp of MCCI and RONv of MICI are 0, and no rounding of the radius."""
    x, c, z = cone(half_angle_deg=0.0)
    for section in ta.form(x + 3e-3 * np.cos(5 * c), c, z, **UNITS).sections:
        for one in (section.values.RONp_MCCI, section.values.RONv_MICI):
            assert (one.value, one.u) == (0.0, 0.0) and str(one) == "0 mm"


def test_a_sweep_without_noise_has_no_spread():
    found = ta.sweep({"part": {"surface": "cylinder", "radius_mm": 20}, "pass": [{"z_start_mm": 5, "z_end_mm": 65}], "repeats": 10})
    table = found.to_pandas()
    assert table[["sd", "u_bias", "q05", "coverage", "mean_u"]].isna().all(axis=None)
    assert (table[["bias", "rmse"]] == 0.0).all(axis=None)  # the lathe and the fit have the same cylinder
    assert "e-" not in str(found) and "%" not in str(found)


def test_a_notebook_shows_headline_and_chart():
    found = ta.diagnose(STREAM, surface="cone")
    said, chart = found._repr_html_().split("</pre>")
    assert said.startswith("<pre") and str(found).splitlines()[0] in html.unescape(said)
    assert chart.startswith("<svg") and "max-width: 100%" in chart.split(">")[0]


def test_points_are_associated():
    rng = np.random.default_rng(5)
    angle, height = rng.uniform(0, 2 * np.pi, 400), rng.uniform(0, 30, 400)
    points = np.stack([1.0 + 10.0 * np.cos(angle), 2.0 + 10.0 * np.sin(angle), height], axis=1)
    found = ta.associate(points, element="cylinder", criterion="minimum_zone")
    assert abs(found.to_dict()["radius"]["value"] - 10.0) < 1e-9
    assert np.abs(found.distance_mm).max() < 1e-9
    circle = ta.form(points[:, :3] * [1, 1, 0], element="circle", band_upr=(1, 15))
    assert "RONt" in circle.to_json()


def test_values_of_a_form_have_their_names():
    """Three lobes of 2 µm: 4 µm from peak to valley, of which a Gaussian filter of 50 UPR passes 2^−(3/50)² (ISO 16610-21)."""
    x, c, z = cone(half_angle_deg=0.0)
    form = ta.form(x + 2e-3 * np.cos(3 * c - 1.0), c, z, **UNITS)
    roundness = form.sections[0].values.RONt_LSCI
    assert abs(roundness.value - 4e-3 * 2.0 ** -((3 / 50) ** 2)) < 4.5 * roundness.u  # as above
    assert form.to_pandas().loc["sections.0.values.RONt_LSCI", "value"] == roundness.value
    for values, written in zip((form.sections[0].values, form.groups[0].values),
                               (form.to_dict()["sections"][0]["values"], form.to_dict()["groups"][0]["values"])):
        assert len(values) == len(written) > 10
        for one in written:
            found = values["_".join(filter(None, (one["name"], one.get("reference"))))].value
            assert found == one["value"] or (np.isnan(found) and one["value"] is None)


def test_a_simulation_knows_its_truth():
    made = ta.simulate({"part": {"surface": "cylinder", "radius_mm": 20.0, "x0_mm": 0.05},
                        "noise": {"sigma_mm": 1e-3},
                        "pass": [{"z_start_mm": 0, "z_end_mm": -20, "feed_mm_per_rev": 1.0, "speed_rpm": 60,
                                  "readings_per_revolution": 40}]}, seed=7)
    assert made.truth.clean_mm.shape == made.stream.reading_mm.shape
    assert json.loads(str(made.truth)) == made.truth.to_dict()  # no screen of a command: its JSON
    left = made.stream.reading_mm - made.truth.clean_mm
    assert abs(left.std() / 1e-3 - 1.0) < 5.0 / np.sqrt(2 * len(left))
    fit = ta.fit(made.stream, surface="cylinder")
    assert abs(fit.x0.value - 0.05) < 4.5 * fit.x0.u


@pytest.mark.parametrize("job", ["shaft", "blade"])
def test_a_job_is_the_command_s(job, tmp_path):
    os.chdir(ROOT)
    found = ta.run_job(f"data/jobs/{job}.toml")
    command("run", f"data/jobs/{job}.toml", "-o", tmp_path / "run")
    assert found.to_json() == (tmp_path / "run/result.json").read_text()
    assert set(found.files) == {one.name for one in (tmp_path / "run").iterdir()}
    assert found.files["report.html"] == (tmp_path / "run/report.html").read_text()
    assert repr(found).startswith("<trueaxis.")


def test_a_correction_is_that_of_a_job(tmp_path):
    """The table of a diagnosis in memory, against the table of the command's job with the same reference and target."""
    os.chdir(ROOT)
    target = {"target": {"surface": "cylinder", "radius_mm": 24, "z_start_mm": 40, "z_end_mm": 10,
                         "coaxiality_tolerance_um": 20, "stock_um": 8000},
              "cut": {"speed_rpm": 600, "sense": "-c", "feed_mm_per_rev": 0.1, "nose_radius_mm": 0.4}}
    job = {"reference": [{"name": "seat", "stream": STREAM, "surface": "cone"}], **target}
    of_job = ta.run_job(job)
    found = ta.correct(ta.diagnose(STREAM, surface="cone"), target)

    def rows(text):
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        return np.array([line.split(",") for line in lines[1:]], dtype=float)

    expected, here = rows(of_job.files["table.csv"]), rows(found.files["table.csv"])
    assert expected.shape == here.shape and len(here) == len(found.wanted_mm)
    assert np.abs(expected - here).max() <= 1e-6  # the last printed digit of Z and C
    assert found.plot().axes


def test_nothing_of_a_result_can_be_changed_or_taken_out():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    for change in (lambda: delattr(fit, "stream"), lambda: delattr(fit.axis, "x"), lambda: delattr(fit.axis, "_items")):
        with pytest.raises(AttributeError):
            change()
    for change in (lambda: fit.axis._items.update(x=1), lambda: fit.files.update(a="b")):
        with pytest.raises(AttributeError):
            change()
    with pytest.raises(ValueError):
        fit.covariance.matrix.flags.writeable = True


def test_parts_are_copied_and_pickled_and_a_result_says_why_not():
    x, c, z = cone()
    fit = ta.fit(x, c, z, surface="cone", **UNITS)
    assert copy.copy(fit) is fit and copy.deepcopy(fit) is fit
    for part in (fit.x0, fit.axis):
        for other in (copy.deepcopy(part), pickle.loads(pickle.dumps(part))):
            assert str(other) == str(part)
    covariance = pickle.loads(pickle.dumps(fit.covariance))
    assert np.array_equal(covariance.matrix, fit.covariance.matrix) and not covariance.matrix.flags.writeable
    with pytest.raises(TypeError, match="to_dict"):
        pickle.dumps(fit)
    assert dict(fit.axis)["x"] == fit.axis.x


def test_a_quantity_takes_a_format():
    one = ta.Quantity(1.23456, 0.01, "mm")
    assert f"{one:.2f}" == "1.23" and f"{one}" == "1.235 ± 0.020 mm"


@pytest.mark.parametrize("value, u, text", [(3.55e-15, 3e-19, "0 mm"), (20.0000123, 1e-14, "20.0000123 mm"),
                                            (1e-15, np.nan, "1e-15 mm"), (1.0, 5e-12, "1.000000000000 ± 0.000000000010 mm")])
def test_a_quantity_has_no_digits_of_rounding(value, u, text):
    assert str(ta.Quantity(value, u, "mm")) == text


def test_a_figure_has_titles_units_and_a_closed_curve():
    x, c, z = cone()
    for figure in (ta.fit(x, c, z, surface="cone", **UNITS).plot(), ta.form(x, c, z, **UNITS).plot()):
        for axes in figure.axes:
            said = axes.get_title() + axes.get_xlabel() + axes.get_ylabel()
            assert "µm" in said or "mm" in said, said
    profile = figure.axes[0].lines[-1].get_xydata()
    assert np.array_equal(profile[0], profile[-1])


def test_a_refused_fit_shows_that_its_axis_is_not_known_and_a_form_without_profile_no_figure():
    x, c, z = cone()
    with pytest.raises(ta.NumericalError) as error:
        ta.fit(x, c, 0.0 * z, surface="cone", **UNITS)
    assert "not known" in [text.get_text() for axes in error.value.result.plot().axes for text in axes.texts]
    points = np.random.default_rng(1).normal(size=(50, 3)) * [10.0, 10.0, 1e-3]
    plane = ta.form(points, element="plane")
    assert plane._repr_html_().endswith("</pre>")
    with pytest.raises(ta.TrueAxisError, match="no figure"):
        plane.plot()


def test_a_stream_says_what_it_is():
    x, c, z = cone(n=200)
    assert "200 readings of arrays" in repr(ta.stream(x, c, z, **UNITS))


def test_file_names_in_a_dictionary_are_relative_to_the_working_directory(tmp_path, monkeypatch):
    (tmp_path / "seat.csv").write_text(STREAM.read_text())
    monkeypatch.chdir(tmp_path)
    job = {"reference": [{"name": "seat", "stream": "seat.csv", "surface": "cone"}]}
    found = ta.run_job(job)
    assert "report.html" in found.files and "/tmp" not in str(found).replace(str(tmp_path), "")
    (tmp_path / "part.toml").write_text(to_toml({
        "part": {"surface": "cylinder", "radius_mm": 20.0}, "noise": {"sigma_mm": 1e-3},
        "pass": [{"z_start_mm": 0, "z_end_mm": -20, "feed_mm_per_rev": 1, "speed_rpm": 60, "readings_per_revolution": 20}]}))
    grid = [{"key": "noise.sigma_mm", "values": [0.001, 0.002]}]
    swept = ta.sweep({"scenario": "part.toml", "repeats": 4, "axis": grid})
    table = swept.to_pandas()
    assert "\n".join([",".join(table.columns), ""]) in swept.files["sweep.csv"]
    # Two cells of 4 repeats each with the noise of its cell, and the same parameters in both.
    assert list(table.groupby("cell")["noise.sigma_mm"].unique().map(list)) == [[0.001], [0.002]]
    assert set(table["repeats"]) == {4} and not table.duplicated(["cell", "parameter"]).any()

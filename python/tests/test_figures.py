# SPDX-License-Identifier: Apache-2.0
"""Figures of what commands compute show its numbers."""
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import trueaxis as ta

DATA = Path(__file__).resolve().parents[2] / "data"


def expect_legend_inside(sheet):
    """Everything of the legend is on the sheet, and is not wider than it."""
    FigureCanvasAgg(sheet).draw()
    (axes,) = sheet.axes
    box, (width, height) = axes.get_legend().get_window_extent(), sheet.bbox.size
    assert 0.0 <= box.x0 and box.x1 <= width and 0.0 <= box.y0 and box.y1 <= height, (box, width, height)
    assert axes.get_position().width > 0.6  # the chart is not squeezed by it


def test_a_job_shows_the_axis_of_each_seat_and_the_table():
    job = ta.run_job(DATA / "jobs/shaft.toml")
    cone, cylinder, table = job.plot().axes
    assert cone.get_title().startswith("cone seat: Axis") and cylinder.get_title().startswith("cylinder seat: Axis")
    rows = [line.split(",") for line in job.files["table.csv"].splitlines() if line[0].isdigit()]
    wanted_um = sorted(1000.0 * float(row[3]) for row in rows if row[0] == "0")
    assert np.allclose(sorted(table.get_lines()[0].get_ydata()), wanted_um, rtol=0.0, atol=1e-9)
    assert (np.diff(table.get_lines()[0].get_xdata()) > 0.0).all()


def test_a_job_of_a_machine_has_its_report_only():
    with pytest.raises(ta.TrueAxisError, match="machine_run/1 has no figure; its report is"):
        ta.run_job(DATA / "jobs/blade.toml").plot()


def test_a_calibration_shows_every_error_with_U():
    found = ta.calibrate(DATA / "five_axis/trunnion_ac_ball.csv", DATA / "five_axis/trunnion_ac.toml")
    shown = {}
    for axes in found.plot().axes:
        points, _, (bars,) = axes.containers[0]
        for label, value, segment in zip(axes.get_yticklabels(), points.get_xdata(), bars.get_segments()):
            shown[label.get_text()] = (value, np.ptp(segment[:, 0]) / 2.0)
    assert shown.keys() == set(found.parameters)
    for name, (value, half) in shown.items():
        assert value == pytest.approx(1000.0 * found.parameters[name].value)
        assert half == pytest.approx(2000.0 * found.parameters[name].u)


def test_a_plan_shows_the_goal_and_each_recommendation():
    plan = ta.plan(goal_um=0.05, surface="cylinder", radius_mm=20.0, length_mm=30.0, sigma_um=1.0, feed_mm=0.5,
                   per_revolution=36, speed_rpm=60, repeats=100, free={"readings_per_revolution": (4, 400), "sigma_um": (0.1, 2)})
    sheet = plan.plot()
    expect_legend_inside(sheet)
    (axes,) = sheet.axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["as given", *(one.what for one in plan.recommended)]
    goal = next(line for line in axes.get_lines() if line.get_label() == "goal")
    assert list(goal.get_xdata()) == [0.05, 0.05]


def test_a_sweep_shows_the_ratio_of_each_row():
    sweep = ta.sweep({"name": "two levels", "repeats": 20, "scenario": str(DATA / "scenarios/shaft_cone_seat.toml"),
                      "axis": [{"key": "noise.sigma_um", "values": [1.0, 2.0]}]})
    sheet = sweep.plot()
    expect_legend_inside(sheet)
    (axes,) = sheet.axes
    shown = sorted(float(y) for bars in axes.containers for y in bars[0].get_ydata())
    assert shown and shown == sorted(row.ratio.value for cell in sweep.cells for row in cell.rows if row.ratio.value is not None)

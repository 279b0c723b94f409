# SPDX-License-Identifier: Apache-2.0
"""Figures of results, with matplotlib; one function a kind of chart."""
from __future__ import annotations

import io
import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import TrueAxisError
from ._figure import GREY as _GREY
from ._figure import LINE as _LINE
from ._figure import OTHER as _OTHER
from ._figure import UM as _UM
from ._figure import figure as _figure
from ._plot_studies import of_calibration, of_plan, of_sweep
from ._values import frozen

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ._result import Result

def _over_c_and_z(axes: Axes, result: Result, residual_mm: Any, title: str) -> None:
    """Residuals over C and Z, µm; of one section over C alone."""
    stream = result.stream
    assert stream is not None
    c_deg = np.degrees(stream.c_rad) % 360.0
    residual_um = _UM * np.asarray(residual_mm)
    largest = float(np.quantile(np.abs(residual_um), 0.99)) or 1.0
    if len(stream.position_mm):
        points = axes.scatter(c_deg, stream.position_mm, c=residual_um, s=5, cmap="RdBu_r", vmin=-largest, vmax=largest)
        axes.figure.colorbar(points, ax=axes, label="residual, µm")
        axes.set_ylabel("X, mm" if stream.is_face else "Z, mm")
    else:
        axes.plot(c_deg, residual_um, ".", ms=2, color=_LINE)
        axes.set_ylabel("residual, µm")
    axes.set(title=title, xlabel="C, degrees", xlim=(0, 360), xticks=range(0, 361, 90))


def _polar(axes: Axes, angle_rad: Any, values_mm: Any, title: str, **style: Any) -> None:
    """A profile about a circle, in µm, magnified so that its range is a third of the radius."""
    angle_rad, values_um = np.asarray(angle_rad), _UM * np.asarray(values_mm)
    if style.get("ls") != "":  # a curve is closed
        angle_rad, values_um = np.append(angle_rad, angle_rad[:1]), np.append(values_um, values_um[:1])
    axes.plot(angle_rad, values_um, **{"lw": 0.8, "color": _LINE, **style})
    span = float(np.ptp(values_um)) or 1.0
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, values_um.min() - 2.0 * span), max(high, values_um.max() + 0.2 * span))
    axes.set_title(title)
    low, high = axes.get_ylim()
    step = 10.0 ** np.floor(np.log10(span))
    step *= next(times for times in (1.0, 2.0, 5.0) if span <= 2.0 * times * step or times == 5.0)
    axes.set_yticks([tick for tick in (-step, 0.0, step) if low < tick < high])
    axes.tick_params(labelsize=7)
    axes.set_rlabel_position(22.5)
    axes.set_axisbelow(False)  # circles and their values are read above the points
    axes.grid(lw=0.5, alpha=0.6)
    for label in axes.get_yticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5})


def _round(axes: Axes, result: Result, residual_mm: Any) -> None:
    assert result.stream is not None
    angle = result.stream.c_rad % (2.0 * np.pi)
    _polar(axes, angle, residual_mm, "The same around C, µm", ls="", marker=".", ms=2)


def _axis(axes: Axes, fit: Any) -> None:
    """The axis over Z with a band of ± U; a word if it is not known."""
    if np.isnan([float(fit.axis[name]) for name in ("x", "y", "slope_x", "slope_y")]).any():
        axes.set(title="Axis", xticks=[], yticks=[])
        axes.text(0.5, 0.5, "not known", ha="center", va="center", transform=axes.transAxes)
        return
    axis, low, high = fit.axis, fit.range.min.value, fit.range.max.value
    z = np.linspace(low, high, 50) if high > low else np.array([low - 0.5, low + 0.5])
    h = z - axis.z_ref.value
    k = getattr(fit, "coverage_factor", 2.0)
    for name, slope, colour, row in (("x", "slope_x", _LINE, 0), ("y", "slope_y", _OTHER, 1)):
        value = axis[name].value + h * axis[slope].value
        cov = axis.covariance.matrix
        u = np.sqrt(np.maximum(cov[row, row] + 2 * h * cov[row, row + 2] + h * h * cov[row + 2, row + 2], 0.0))
        axes.plot(z, _UM * value, color=colour, label=name)
        axes.fill_between(z, _UM * (value - k * u), _UM * (value + k * u), color=colour, alpha=0.25, lw=0)
    axes.set(title=f"Axis ± U (k = {k:g})", xlabel="Z, mm", ylabel="offset from the spindle axis, µm")
    if not high > low:
        axes.set(xlabel="one section", xticks=[])
    axes.legend(frameon=False)


def _spectrum(axes: Axes, result: Result) -> None:
    axes.vlines(result.spectrum_order, 0, _UM * result.spectrum_before_mm, color=_GREY, lw=2, label="before")
    axes.vlines(result.spectrum_order, 0, _UM * result.spectrum_after_mm, color=_LINE, lw=1, label="after")
    largest = _UM * max(*result.spectrum_before_mm, *result.spectrum_after_mm, 0.0, 1e-9)
    axes.set(title="Spectrum of the residuals", xlabel="undulations per revolution", ylabel="amplitude, µm",
             ylim=(0.0, 1.25 * largest))
    axes.legend(frameon=False, ncols=2, loc="upper right")


def _of_fit(result: Result) -> Figure:
    figure, (over, around, axis) = _figure("", "polar", "")
    _over_c_and_z(over, result, result.residual_mm, "Residuals")
    _round(around, result, result.residual_mm)
    if result.stream is not None and result.stream.is_face:
        figure.delaxes(axis)
    else:
        _axis(axis, result)
    return figure


def _of_diagnosis(result: Result) -> Figure:
    figure, (over, around, spectrum, axis) = _figure("", "polar", "", "")
    _over_c_and_z(over, result, result.residual_before_mm, "Residuals of the ideal fit")
    _round(around, result, result.residual_before_mm)
    _spectrum(spectrum, result)
    if result.stream is not None and result.stream.is_face:
        figure.delaxes(axis)
    else:
        _axis(axis, result.extended)
    return figure


def _of_form(result: Result) -> Figure | None:
    if not hasattr(result, "angle_rad_0"):
        return None  # a plane has no profile
    figure, (around,) = _figure("polar")
    section = len(result.sections) // 2
    angle, raw, filtered = (getattr(result, f"{name}_{section}") for name in ("angle_rad", "raw_mm", "filtered_mm"))
    at = result.sections[section]
    where = f" at Z {at.z.value:.4g} mm" if "z" in at and not np.isnan(float(at.z)) else ""
    if result.options.filter.kind == "none":
        _polar(around, angle, raw, f"Profile{where} without a filter, µm")
        return figure
    _polar(around, angle, raw, "", color=_GREY, lw=2.4, label="before the filter")
    _polar(around, angle, filtered, f"Profile{where}, µm", label="after the filter")
    around.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.08), ncols=2, fontsize=8)
    return figure


def _of_spindle(result: Result) -> Figure:
    figure, (motion, form) = _figure("polar", "polar")
    _polar(motion, result.angle_rad, result.motion_mm, "Error motion of the spindle, µm")
    if len(result.form_mm):
        _polar(form, result.angle_rad, result.form_mm, "Form of the part, µm")
    return figure


def _courses(axes: Axes, c_deg: Any, wanted_mm: Any, command_mm: Any) -> None:
    in_order = np.argsort(c_deg, kind="stable")  # C may begin anywhere and run down
    for values_mm, colour, label in ((wanted_mm, _GREY, "wanted"), (command_mm, _LINE, "command")):
        axes.plot(np.asarray(c_deg)[in_order], _UM * np.asarray(values_mm)[in_order], color=colour, label=label)
    axes.set(title="Correction, first revolution", xlabel="C, degrees", ylabel="X_fts, µm")
    axes.legend(frameon=False)


def _of_correction(result: Result) -> Figure:
    figure, (axes,) = _figure("")
    turns = result.c_rad / (2.0 * np.pi)
    once = np.abs(turns - turns[0]) <= 1.0
    _courses(axes, np.degrees(result.c_rad[once]), result.wanted_mm[once], result.command_mm[once])
    return figure


def _of_run(result: Result) -> Figure | None:
    if "c_rad" not in result._found.arrays:
        return _of_job(result)
    return _of_correction(result) if len(result.c_rad) else None


def _of_job(result: Result) -> Figure | None:
    """The final axis of each seat, and the table over one revolution if there is one."""
    seats = [one for one in result.references if one.fit.surface != "plane"]
    table = result.files.get("table.csv", "").splitlines()
    if not seats and not table:
        return None
    figure, charts = _figure(*[""] * (len(seats) + bool(table)))
    for axes, seat in zip(charts, seats):
        file = seat.diagnosis.file if "diagnosis" in seat else ""
        _axis(axes, frozen(json.loads(result.files[file])).extended if file in result.files else seat.fit)
        axes.set_title(f"{seat.name}: {axes.get_title()}")
    if table:
        rows = [line.split(",") for line in table if not line.startswith("#")]
        c_deg, wanted, command = (rows[0].index(name) for name in ("C[deg]", "X_fts[mm]", "X_command[mm]"))
        once = [[float(value) for value in row] for row in rows[1:] if row[0] == rows[1][0]]
        _courses(charts[-1], *([row[k] for row in once] for k in (c_deg, wanted, command)))
    return figure


def _of_association(result: Result) -> Figure:
    figure, (axes,) = _figure("")
    axes.plot(_UM * result.distance_mm, ".", ms=2, color=_LINE)
    axes.set(title="Distances from the element", xlabel="point", ylabel="distance, µm")
    return figure


_KINDS: dict[str, Callable[[Result], Figure | None]] = {
    "trueaxis.fit": _of_fit, "trueaxis.diagnosis": _of_diagnosis, "trueaxis.form": _of_form,
    "trueaxis.spindle": _of_spindle, "trueaxis.run": _of_run, "trueaxis.association": _of_association,
    "trueaxis.sweep": of_sweep, "trueaxis.plan": of_plan, "trueaxis.calibration": of_calibration,
}


def figure_of(result: Result) -> Figure:
    """Returns the figure of a result."""
    draw = _KINDS.get(str(result.schema).split("/")[0])
    figure = draw(result) if draw else None
    if figure is None:
        report = '; its report is result.files["report.html"]' if "report.html" in result.files else ""
        raise TrueAxisError(f"{result.schema} has no figure{report}")
    return figure


def svg_of(result: Result) -> str:
    """Returns the figure as SVG for a notebook; empty without matplotlib or a figure."""
    try:
        text = io.StringIO()
        figure_of(result).savefig(text, format="svg")
    except (ImportError, TrueAxisError):
        return ""
    svg = text.getvalue()
    return svg[svg.index("<svg"):].replace("<svg", '<svg style="max-width: 100%; height: auto"', 1)

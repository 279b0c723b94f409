# SPDX-License-Identifier: Apache-2.0
"""Figures of sweeps, plans and calibrations."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ._figure import GREY, LINE, OTHER, UM, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ._result import Result

_COLOURS = (LINE, OTHER, GREY, "#2a7f4f", "#7a4fa0", "#b08a00")
_MARKERS = "os^Dv"


def of_sweep(result: Result) -> Figure | None:
    """Error over the Cramér-Rao bound in each cell, with its 95 % interval, a colour for each parameter."""
    rows = [(i, cell, row) for i, cell in enumerate(result.cells) for row in cell.rows
            if "ratio" in row and row.ratio.value is not None]
    if not rows:
        return None
    sheet, (axes,) = figure("")
    sheet.set_size_inches(max(6.4, 0.6 * len(result.cells) + 2.0), 4.2)  # at least the width of the legend
    names = list(dict.fromkeys(row.parameter for _, _, row in rows))
    for k, name in enumerate(names):
        of = [(i, row.ratio.value, row.ratio.interval_95) for i, _, row in rows if row.parameter == name]
        at = [i + 0.6 * ((k + 0.5) / len(names) - 0.5) for i, _, _ in of]
        ratio = np.array([value for _, value, _ in of])
        ends = np.array([(value, value) if ends is None else ends for _, value, ends in of])
        axes.errorbar(at, ratio, yerr=[ratio - ends[:, 0], ends[:, 1] - ratio], fmt=_MARKERS[k // len(_COLOURS) % len(_MARKERS)], ms=3, lw=0.8,
                      label=name, color=_COLOURS[k % len(_COLOURS)])
    axes.axhline(1.0, color="black", lw=0.6)
    axes.set(title="RMS error over the Cramér-Rao bound", ylabel="ratio, 95 % interval",
             xlabel=", ".join(axis.name for axis in result.axes))
    cells = {i: "\n".join([*(str(cell.at[name]) for name in cell.at)]) for i, cell, _ in rows}
    axes.set_xticks(list(cells), list(cells.values()), fontsize=7)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.25), ncols=5, fontsize=7, frameon=False)
    return sheet


def of_plan(result: Result) -> Figure | None:
    """U of the plan as given and of each recommended plan, with what its simulation confirmed, and the goal."""
    plans = [("as given", result.as_given.U.value, None)] if "U" in result.as_given else []
    plans += [(one["what"], one["plan"]["U"]["value"], one["confirmed"]["U"].get("interval_95"))
              for one in result.to_dict()["recommended"]]
    if not plans:
        return None
    sheet, (axes,) = figure("")
    sheet.set_size_inches(6.4, 3.6)
    for i, (_, stated, confirmed) in enumerate(plans):
        axes.plot(UM * stated, i, "o", color=LINE, label="U of the plan" if i == 0 else None)
        if confirmed is not None:
            axes.plot([UM * end for end in confirmed], [i, i], color=OTHER, lw=3, alpha=0.5)
    axes.axvline(UM * result.goal.value, color="black", lw=0.8, label="goal")
    axes.plot([], [], color=OTHER, lw=3, alpha=0.5, label="simulated, 95 % interval")
    title = "U of the axis over the length" if result.of == "axis" else "U of the height of the face"
    axes.set(title=title, xlabel="µm", ylim=(len(plans) - 0.5, -0.5))
    axes.set_yticks(range(len(plans)), [name for name, _, _ in plans], fontsize=8)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3, fontsize=7, frameon=False)
    return sheet


def of_calibration(result: Result) -> Figure | None:
    """Each error that was estimated with ± U (k = 2): lengths and angles."""
    kinds = [(unit, [(name, one) for name in result.parameters if (one := result.parameters[name]).unit == unit])
             for unit in ("mm", "deg")]
    kinds = [(unit, errors) for unit, errors in kinds if errors]
    if not kinds:
        return None
    sheet, charts = figure(*[""] * len(kinds))
    for axes, (unit, errors) in zip(charts, kinds):
        axes.errorbar([1000.0 * one.value for _, one in errors], range(len(errors)),
                      xerr=[1000.0 * one.U for _, one in errors], fmt="o", ms=3, color=LINE)
        axes.axvline(0.0, color="black", lw=0.6)
        axes.set(title="Location errors ± U", xlabel="µm" if unit == "mm" else "0.001°", ylim=(len(errors) - 0.5, -0.5))
        axes.set_yticks(range(len(errors)), [name for name, _ in errors], fontsize=8)
    return sheet

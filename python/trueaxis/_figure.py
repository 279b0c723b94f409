# SPDX-License-Identifier: Apache-2.0
"""The sheet that figures of results are drawn on."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

UM = 1000.0
LINE, OTHER, GREY = "#1f5fa8", "#c8501e", "#808080"  # told apart in print and without colour vision


def figure(*kinds: str) -> tuple[Figure, list[Axes]]:
    """Returns a figure with a chart for each kind: "polar" or ""."""
    from matplotlib.figure import Figure

    rows = 2 if len(kinds) == 4 else 1  # so that it is read in the width of a page
    across = len(kinds) // rows
    sheet = Figure(figsize=(4.2 * across, 3.6 * rows), layout="constrained")
    return sheet, [sheet.add_subplot(rows, across, i + 1, projection="polar" if kind == "polar" else None)
                   for i, kind in enumerate(kinds)]

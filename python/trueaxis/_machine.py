# SPDX-License-Identifier: Apache-2.0
"""A machine of three to six axes with its errors."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import one_of, with_checked_arguments
from ._errors import InputError
from ._streams import Path, numbers_of
from ._toml import Document, as_file
from ._values import Floats


class Poses(NamedTuple):
    """Where the tool is in the part.

    Attributes
    ----------
    tip_mm : ndarray, shape (n, 3)
        Tip in the program frame in force, mm.
    direction : ndarray, shape (n, 3)
        Unit vector from the tip to the holder.
    """

    tip_mm: Floats
    direction: Floats


class Machine:
    """A machine as a chain from the workpiece to the tool, with the errors of its axes.

    Parameters
    ----------
    machine : path or Mapping
        The machine (``trueaxis.machine/1``).
    errors : sequence of paths
        Its errors (``errors.toml`` of a calibration, ISG or Etalon); several files add.
    sign : str, optional
        "moving_part" or "tool_minus_workpiece", of ISG and Etalon files.
    work_offset : str
        "G54" to "G59".

    Attributes
    ----------
    axes : tuple of str
        Names of the axes in the order of X Y Z A B C.
    notes : tuple of str
        What the files do not say.
    """

    __slots__ = ("_machine", "name", "chain", "axes", "notes")

    @with_checked_arguments
    def __init__(self, machine: Document, *, errors: Sequence[Path] = (), sign: str | None = None,
                 large_errors: bool = False, work_offset: str = "G54") -> None:
        if sign is not None:
            one_of("sign", sign, ("moving_part", "tool_minus_workpiece"))
        one_of("work_offset", work_offset, ("G54", "G55", "G56", "G57", "G58", "G59"))
        with as_file(machine, "machine") as path:
            self._machine = _core.open_machine(path, [os.fspath(one) for one in errors], sign or "", large_errors,
                                               work_offset)
        self.name: str = self._machine.name
        self.chain: str = self._machine.chain
        self.axes: tuple[str, ...] = tuple(self._machine.axes)
        self.notes: tuple[str, ...] = tuple(self._machine.notes)

    @with_checked_arguments
    def pose(self, *, nominal: bool = False, **positions: npt.ArrayLike) -> Poses:
        """Computes where the tool is in the part.

        Parameters
        ----------
        nominal : bool
            Of the machine without its errors.
        **positions
            Each axis with its unit: ``x_mm=…, y_mm=…, z_mm=…, a_deg=…, c_deg=…``, numbers or arrays of
            shape (n,). All axes must be given.

        Raises
        ------
        Refused
            If a position lies where the errors were not measured.
        """
        names = [f"{axis.lower()}_{'mm' if axis in 'XYZ' else 'deg'}" for axis in self.axes]
        if set(positions) != set(names):
            raise InputError(f"give a position of each axis, with its unit: {', '.join(names)}")
        columns = np.broadcast_arrays(*(numbers_of(name, positions[name]) for name in names))
        rows = np.stack([column.reshape(-1) for column in columns], axis=1)
        if not np.isfinite(rows).all():
            raise InputError("a position is not finite")
        return Poses(*self._machine.poses(rows, nominal))

    def __repr__(self) -> str:
        return f"<Machine {self.name}: {self.chain}>"

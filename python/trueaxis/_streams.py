# SPDX-License-Identifier: Apache-2.0
"""Streams of probe readings, from arrays or from files."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import with_checked_arguments
from ._errors import InputError
from ._values import Floats
from ._words import argument_of, made_of_table

Stream = _core.Stream
setattr(Stream, "__repr__", lambda one: f"<trueaxis.Stream: {len(one)} readings of {one.source}>")
Path = Union[str, "os.PathLike[str]"]
Readings = Union[Stream, Path, "npt.ArrayLike", Mapping[str, "npt.ArrayLike"]]

_SAY_X = ('say what x is: x_unit="mm radius" or "mm diameter" (um, m and in too), '
          'c_unit="deg", "rad" or "rev", z_unit="mm"')


def numbers_of(name: str, column: Any) -> Floats:
    """Returns readings or points as numbers; a value that is hidden or missing is NaN, which no fit takes for a reading."""
    if isinstance(column, np.ma.MaskedArray):
        masked: Any = column
        column = masked.astype(np.float64).filled(np.nan)
    try:
        given = column if hasattr(column, "dtype") else np.asarray(column)
        if getattr(given.dtype, "kind", "f") in "mMcb":
            raise ValueError(f"it is {given.dtype}")
        if hasattr(given, "isna"):  # of pandas, whose missing values may be no floats
            given = given.to_numpy(dtype=np.float64, na_value=np.nan)
        return np.ascontiguousarray(given, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: not an array of numbers: {error}") from None


def _expect_same_rows(columns: Mapping[str, Any]) -> None:
    """Readings go together by position. Series whose indexes differ would be mixed up."""
    indexes = [column.index for column in columns.values() if hasattr(column, "isna")]
    if any(len(one) == len(indexes[0]) and not one.equals(indexes[0]) for one in indexes):
        raise InputError("the indexes of the columns differ: take them from one table, or give x.to_numpy() and so on "
                         "if they go together by position")


def _x_header(name: str, x_unit: str) -> str:
    unit, _, kind = str(x_unit).partition(" ")
    if kind not in ("radius", "diameter"):
        raise InputError(f"x_unit {x_unit!r}: {_SAY_X}")
    return f"{name}[{unit} dia]" if kind == "diameter" else f"{name}[{unit}]"


def _named_columns(x: npt.ArrayLike, c: npt.ArrayLike | None, z: npt.ArrayLike | None, t_s: npt.ArrayLike | None,
                   x_unit: str | None, c_unit: str | None, z_unit: str | None,
                   several: bool) -> dict[str, npt.ArrayLike]:
    if c is None:
        raise InputError("c is missing: give x, c and z as three arrays, as table[:, 0], table[:, 1], table[:, 2]; or a "
                         "DataFrame or dictionary whose names say what they are: X_M[mm dia], C[deg], Z[mm]")
    units = {"x_unit": x_unit is None, "c_unit": c_unit is None, "z_unit": z is not None and z_unit is None}
    left_out = [name for name, missing in units.items() if missing]
    if x_unit is None or left_out:
        raise InputError(f"{', '.join(left_out)} missing; {_SAY_X}")
    if several:
        sensors = numbers_of("x", x)
        if sensors.ndim != 2:
            raise InputError("x: an array of shape (n, sensors) goes with sensor_angles_deg")
        columns: dict[str, npt.ArrayLike] = {
            _x_header(f"X_M{i + 1}", x_unit): sensors[:, i] for i in range(sensors.shape[1])}
    else:
        columns = {_x_header("X_M", x_unit): x}
    columns[f"C[{c_unit}]"] = c
    if z is not None:
        columns[f"Z[{z_unit}]"] = z
    if t_s is not None:
        columns["t[s]"] = t_s
    return columns


@with_checked_arguments
def stream(x: npt.ArrayLike | Mapping[str, npt.ArrayLike], c: npt.ArrayLike | None = None,
           z: npt.ArrayLike | None = None, *, x_unit: str | None = None, c_unit: str | None = None,
           z_unit: str | None = None, t_s: npt.ArrayLike | None = None, relative: bool = False,
           nominal_radius_mm: float | None = None, sensor_angles_deg: Sequence[float] = (),
           metadata: Mapping[str, object] | None = None, drop_invalid: bool = False,
           source: str = "arrays") -> Stream:
    """Makes a stream of arrays. They are copied once; fits of the stream copy nothing.

    Parameters
    ----------
    x : array_like, shape (n,) or (n, sensors), or Mapping
        Position of the contact. A mapping (a DataFrame too) holds all columns by the names of a
        stream's header: ``{"X_M[mm dia]": ..., "C[deg]": ..., "Z[mm]": ...}``, of a face
        ``{"Z_M[mm]", "C[deg]", "X[mm]"}``.
    c : array_like, shape (n,)
        Spindle angle, wrapped or running.
    z : array_like, shape (n,), optional
        Position along the spindle; without it the stream is one section.
    x_unit : str
        "mm radius", "mm diameter", or the same of "um", "m", "in". There is no default.
    c_unit : str
        "deg", "rad", "mrad" or "rev". There is no default.
    z_unit : str
        "mm", "um", "m" or "in"; needed if ``z`` is given.
    t_s : array_like, shape (n,), optional
        Time in s.
    relative : bool
        The readings are those of a gauge; it needs ``nominal_radius_mm``.
    nominal_radius_mm : float, optional
        Nominal radius in mm.
    sensor_angles_deg : sequence of float
        Of several sensors, from +X towards +Y, in degrees.
    metadata : Mapping, optional
        Further keys of a stream: ``{"sensor_noise": "2 um", "spindle_rpm": 60}``.
    drop_invalid : bool
        Leave out rows with a value that is NaN, infinite, missing or masked. Arrays of the result then
        have the rows that are left, as ``stream.reading_mm`` has.
    source : str
        Name of the readings in messages and results.

    Returns
    -------
    Stream
        With the read-only arrays ``reading_mm`` (a radius), ``c_rad`` (running), ``position_mm``,
        ``time_s``, shape (n,) each.

    Raises
    ------
    InputError
        If a unit is not said, a length differs, or a reading is not finite.
    """
    if isinstance(x, (Stream, str)):
        raise InputError("x is not an array: give a stream or a path to the function itself, or read() it")
    several = len(sensor_angles_deg) > 0
    table = isinstance(x, Mapping) or hasattr(x, "columns")
    if isinstance(x, Mapping) or table:
        named: Any = x
        if x_unit is not None or c is not None:
            raise InputError("the names of a table's columns say their units, X_M[mm dia], C[deg], Z[mm]: leave c, z and "
                             "the units out; or give its columns with their units: table[\"x\"], table[\"c\"], table[\"z\"]")
        names = [str(name) for name in (named if isinstance(x, Mapping) else named.columns)]
        columns = {name: named[name] for name in names}
        is_face = any(name.lstrip().startswith("Z_M") for name in names)
        if not is_face and not any(name.lstrip().startswith("X_M") for name in names):
            raise InputError(f"no column is called X_M, and the names are {', '.join(names)}: name them X_M[mm dia], C[deg], "
                             f"Z[mm], t[s], or give the columns with their units: table[{names[0]!r}] and so on, {_SAY_X}"
                             if names else "the table has no columns")
    else:
        columns = _named_columns(x, c, z, t_s, x_unit, c_unit, z_unit, several)
        is_face = False
    labels = [name if table else argument_of(name) for name in columns]
    numbers = [numbers_of(label, column) for label, column in zip(labels, columns.values())]
    sizes = [one.shape for one in numbers]
    if any(one.ndim != 1 for one in numbers) or len(set(sizes)) != 1:
        given = ", ".join(f"{label} {size}" for label, size in zip(labels, sizes))
        raise InputError(f"arrays must be one-dimensional and of equal length, but are {given}")
    _expect_same_rows(columns)
    radius = x_unit is not None and x_unit.endswith("radius")
    said = "".join(f"# {key}: {value}\n" for key, value in (metadata or {}).items())
    made = _core.stream_of(said + ",".join(columns) + "\n", numbers, source, False if radius else None, relative,
                           nominal_radius_mm, drop_invalid, list(sensor_angles_deg))
    if not made.x_said and not is_face and x_unit is None:
        raise InputError("say what X_M is: name the column X_M[mm dia], or metadata={'x_convention': 'radius'}")
    made_of_table[made] = table
    return made


@with_checked_arguments
def read(path: Path, *, x: str | None = None, relative: bool = False, nominal_radius_mm: float | None = None,
         columns: str = "", skip: int = 0, z_from_mm: float | None = None, z_to_mm: float | None = None,
         drop_invalid: bool = False, sensor_angles_deg: Sequence[float] = ()) -> Stream:
    """Reads a stream (CSV) or another program's recording, as the command does.

    Parameters
    ----------
    path : str or path
        The file.
    x : str, optional
        "radius" or "diameter", if the file does not say it.
    relative, nominal_radius_mm, drop_invalid, sensor_angles_deg
        As in :func:`stream`.
    columns : str
        Columns of another program's file by name or number, with a unit if the file states none:
        ``"X=Diameter,C=Angle[rad],Z=3[mm]"``.
    skip : int
        Lines above the table.
    z_from_mm, z_to_mm : float, optional
        Range of Z to use, mm.
    """
    if x not in (None, "radius", "diameter"):
        raise InputError(f'x {x!r}: write "radius" or "diameter"')
    return _core.read_stream(os.fspath(path), columns, skip, z_from_mm, z_to_mm,
                             None if x is None else x == "diameter", relative, nominal_radius_mm, drop_invalid,
                             list(sensor_angles_deg))


def _expect_known(known: Iterable[str], given: str, units: Iterable[str]) -> None:
    unknown = [name for name in units if name not in known]
    if not unknown:
        return
    if given == "a file" and all(name.endswith("_unit") for name in unknown):
        raise InputError(f'{", ".join(unknown)}: not for a file: write units in its header, as C[rad] and t[ms], or in '
                         'columns="X=1[mm],C=2[rad],Z=3[mm]"')
    raise InputError(f"{', '.join(unknown)}: there is no such argument for {given}; in addition to those that help() of "
                     f"the function lists it takes {', '.join(known) or 'none'}")


def taken(readings: Any, c: Any, z: Any, units: dict[str, Any]) -> Stream:
    """Returns the stream that a function was given, whatever it was given as."""
    if isinstance(readings, Stream):
        if c is not None or z is not None:
            raise InputError("a stream has its own columns: leave c and z out")
        if any(name in stream.__kwdefaults__ or name in read.__kwdefaults__ for name in units):
            raise InputError(f"{', '.join(units)}: a stream has its units and what else it was read with: leave them out")
        _expect_known((), "a stream", units)
        return readings
    if isinstance(readings, (str, os.PathLike)):
        if c is not None or z is not None:
            raise InputError("a file has its own columns: leave c and z out")
        _expect_known(read.__kwdefaults__, "a file", units)
        return read(readings, **units)
    _expect_known(stream.__kwdefaults__, "arrays", units)
    return stream(readings, c, z, **units)

# SPDX-License-Identifier: Apache-2.0
"""Readings of a lathe: fit, diagnosis, form, spindle, correction and simulation."""
from __future__ import annotations

import functools
import os
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import number, one_of, with_checked_arguments
from ._errors import InputError
from ._result import Result, result_of
from ._streams import Path, Readings, Stream, numbers_of, taken
from ._toml import Document, as_file, as_text
from ._work import Progress, Shown

_LOSSES = ("plain", "huber", "tukey")


def _seed(seed: int) -> int:
    if not 0 <= seed < 2**64:
        raise InputError(f"seed: {seed} is not a whole number from 0 to 2^64 - 1")
    return int(seed)


@functools.lru_cache(64)
def _association(surface: str, loss: str, bore: bool, ball_radius_mm: float, noise_um: float | None,
                 coverage_factor: float, known: tuple[str, ...] = ()) -> _core.Association:
    """What a caller states, of which fits in a row state the same."""
    if noise_um is not None:
        number("noise_um", noise_um, 0.0)
    return _core.Association(
        surface, one_of("loss", loss, _LOSSES), bore, number("ball_radius_mm", ball_radius_mm, 0.0), noise_um,
        list(known), number("coverage_factor", coverage_factor, 0.0, 100.0, above=True))


@with_checked_arguments
def fit(readings: Readings, c: npt.ArrayLike | None = None, z: npt.ArrayLike | None = None, *, surface: str,
        loss: str = "plain", bore: bool = False, ball_radius_mm: float = 0.0, noise_um: float | None = None,
        coverage_factor: float = 2.0, checked: bool = True, progress: Progress = None, **units: Any) -> Result:
    """Fits a reference surface to readings: no starting values, uncertainties included.

    Parameters
    ----------
    readings : Stream, path, or array_like of shape (n,)
        Readings, or the position of the contact with ``c`` and ``z`` as in :func:`stream`.
    c, z : array_like, shape (n,), optional
        Spindle angle and position along the spindle.
    surface : str
        "cone", "cylinder", "section" (without z), "plane", "sphere" or "torus".
    loss : str
        Weight of outlying readings: "plain", "huber" or "tukey".
    bore : bool
        The part is probed from inside.
    ball_radius_mm : float
        Radius of the ball in mm if x is that of its centre.
    noise_um : float, optional
        Standard deviation of one reading in µm. A value below that of the residuals does not lower u.
    coverage_factor : float
        k of U = k u.
    checked : bool
        Look first, as the command does, whether the readings are those of one surface whose part did
        not move. This takes longer than the fit itself; leave it out for simulated readings only.
    progress : callable, optional
        Called with the seconds since the beginning and the share that is done: 0 to 1 for the present step of `sweep`
        and `plan`, None for work that does not count. What it raises ends the work.
    **units
        For arrays: ``x_unit`` ("mm radius" or "mm diameter"; um, m and in too), ``c_unit`` ("deg", "rad"
        or "rev"), ``z_unit`` ("mm", "um", "m" or "in") and all else that :func:`stream` takes. For a
        path: ``x`` ("radius" or "diameter"), ``columns`` and all else that :func:`read` takes.

    Returns
    -------
    Result
        ``trueaxis.fit/1``. Parameters are attributes with ``value``, ``u``, ``U`` and ``unit``;
        ``covariance`` has ``names`` and ``matrix``; ``residual_mm`` (reading less surface) has shape (n,).
        ``x0`` and ``y0`` are those of the axis at Z = 0: x ≈ radius + x0 cos C + y0 sin C.

    Raises
    ------
    InputError
        If the readings are not those of this surface, or too few.
    NumericalError
        If the fit did not converge or is not determined, or if a unit or column looks wrong;
        ``error.result`` has what is known.
    Refused
        If the axis is not known; ``error.result`` says why.
    """
    stream = taken(readings, c, z, units)
    association = _association(surface, loss, bore, ball_radius_mm, noise_um, coverage_factor)
    with Shown("fit", progress) as shown:
        return result_of(_core.fit(stream, association, checked, shown), stream)


@with_checked_arguments
def diagnose(readings: Readings, c: npt.ArrayLike | None = None, z: npt.ArrayLike | None = None, *, surface: str,
             loss: str = "plain", bore: bool = False, ball_radius_mm: float = 0.0, noise_um: float | None = None,
             known: Mapping[str, str] | None = None, coverage_factor: float = 2.0, false_alarm: float = 0.01,
             progress: Progress = None, **units: Any) -> Result:
    """Finds and names what the ideal surface gets wrong, and the axis that follows.

    Parameters
    ----------
    readings, c, z, surface, loss, bore, ball_radius_mm, noise_um, coverage_factor, progress, **units
        As in :func:`fit`; surfaces are "cone", "cylinder", "section" and "plane".
    known : Mapping of str to str, optional
        Known values with u, as ``{"lag_ms": "0.4±0.1"}``; keys as in ``[sensor]`` of a job.
    false_alarm : float
        Probability of a false alarm in readings without a cause.

    Returns
    -------
    Result
        ``trueaxis.diagnosis/3``: ``verdict``, ``findings``, ``baseline``, ``extended`` (the final axis),
        ``gain``; arrays ``residual_before_mm``, ``residual_after_mm``, ``effect_mm`` of shape (n,)
        and ``spectrum_order``, ``spectrum_before_mm``, ``spectrum_after_mm``.
    """
    stream = taken(readings, c, z, units)
    stated = tuple(f"{key}={value}" for key, value in (known or {}).items())
    association = _association(surface, loss, bore, ball_radius_mm, noise_um, coverage_factor, stated)
    number("false_alarm", false_alarm, 0.0, 0.5, above=True)
    with Shown("diagnosis", progress) as shown:
        return result_of(_core.diagnose(stream, association, false_alarm, shown), stream)


@with_checked_arguments
def form(readings: Readings, c: npt.ArrayLike | None = None, z: npt.ArrayLike | None = None, *,
         element: str | None = None, filter: str = "gaussian", band_upr: tuple[float, float] = (1.0, 50.0),
         bore: bool = False, ball_radius_mm: float = 0.0, noise_um: float | None = None,
         spindle_range_um: float = 0.0, datum: Stream | Path | None = None, datum_association: str = "gaussian",
         coverage_factor: float = 2.0, trials: int = 400, seed: int = 12181, threads: int = 0,
         progress: Progress = None, **units: Any) -> Result:
    """Evaluates roundness, cylindricity, flatness, straightness and run-out with U (ISO 12181, 1101).

    Parameters
    ----------
    readings, c, z, bore, ball_radius_mm, noise_um, coverage_factor, progress, **units
        As in :func:`fit`. With ``element`` the readings are points x, y, z in mm, shape (n, 3).
    element : str, optional
        "circle", "cylinder", "plane" or "line" of points.
    filter : str
        "gaussian", "robust_gaussian", "spline" or "none".
    band_upr : tuple of float
        Pass band in undulations per revolution.
    spindle_range_um : float
        Range of an unknown synchronous error motion in µm; it enters U.
    datum : Stream or path, optional
        Readings of the datum in the same clamping; otherwise the spindle axis.
    datum_association : str
        "gaussian", "minimum_zone", "minimum_circumscribed" or "maximum_inscribed".
    trials, seed : int
        Monte Carlo for U.
    threads : int
        0: as many as there are. The result does not depend on it.

    Returns
    -------
    Result
        ``trueaxis.form/1``; values by name and reference, ``sections[0].values.RONt_LSCI`` and
        ``groups[0].values.CYLt_LSCY``; arrays ``angle_rad_0``, ``raw_mm_0``, ``filtered_mm_0`` of the first section,
        ``…_1`` of the next, before and after the filter.
    """
    if np.shape(band_upr) != (2,) or not 1.0 <= band_upr[0] < band_upr[1] <= 1500.0:
        raise InputError(f"band_upr: {band_upr} is not a pass band such as (1, 50)")
    options = _core.FormOptions(
        filter, (float(band_upr[0]), float(band_upr[1])), bore, number("ball_radius_mm", ball_radius_mm, 0.0),
        None if noise_um is None else number("noise_um", noise_um, 0.0),
        number("spindle_range_um", spindle_range_um, 0.0), datum_association,
        number("coverage_factor", coverage_factor, 0.0, 100.0, above=True), int(number("trials", trials, 10)), _seed(seed),
        int(number("threads", threads, 0, 4096)))
    if element is not None:
        if isinstance(readings, (Stream, str, os.PathLike)):
            raise InputError("element: it is for an array of points x, y, z; leave it out for readings of a lathe")
        if c is not None or z is not None or units or datum is not None:
            raise InputError("points are rows x, y, z in mm: leave c, z, units and datum out")
        with Shown("form", progress) as shown:
            return result_of(_core.form_of_points(numbers_of("points", readings), element, options, shown))
    stream = taken(readings, c, z, units)
    about = None if datum is None else taken(datum, None, None, {})
    with Shown("form", progress) as shown:
        return result_of(_core.form(stream, about, options, shown), stream)


@with_checked_arguments
def associate(points: npt.ArrayLike | Path, *, element: str, criterion: str = "gaussian", material: str | None = None,
              unit: str | None = None, array: str = "", threads: int = 0, progress: Progress = None) -> Result:
    """Fits an element to Cartesian points in any orientation, without starting values (ISO 17450-1).

    Parameters
    ----------
    points : array_like, shape (n, 3), or path
        Points x, y, z in mm (an array), or a file (text, X3P, HDF5, MATLAB, NumPy).
    element : str
        "line", "circle", "plane", "sphere", "cylinder", "cone" or "torus".
    criterion : str
        "gaussian", "minimum_zone", "minimum_circumscribed", "maximum_inscribed" or "constrained".
    material : str, optional
        "inside" or "outside", for "constrained" only.
    unit : str, optional
        Of a file's points.
    array : str
        Array or three columns of a file's.
    threads : int
        0: as many as there are. The result does not depend on it.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.association/1``; ``distance_mm`` has shape (n,).
    """
    if (criterion == "constrained") == (material is None):
        raise InputError('material: say "inside" or "outside" with criterion "constrained", and with no other')
    number("threads", threads, 0, 4096)
    side = one_of("material", material or "inside", ("inside", "outside"))
    with Shown("association", progress) as shown:
        if isinstance(points, (str,)) or hasattr(points, "__fspath__"):
            return result_of(_core.associate_file(str(points), unit or "", array, element, criterion, side, threads,
                                                  shown))
        if unit not in (None, "mm"):
            raise InputError("unit: an array of points is in mm")
        rows = numbers_of("points", points)
        return result_of(_core.associate(rows, element, criterion, side, threads, shown))


@with_checked_arguments
def spindle(streams: Stream | Path | Sequence[Stream | Path], *, order_max: int = 100,
            sensitive_direction_deg: float | None = None, u_angle_deg: float = 0.5, u_reindex_deg: float = 0.5,
            largest_condition: float = 100.0, coverage_factor: float = 2.0, progress: Progress = None) -> Result:
    """Separates the form of a part from the error motion of the spindle (ISO 230-7).

    Parameters
    ----------
    streams : Stream, path, or a sequence of them
        Several sensors (``stream(..., sensor_angles_deg=...)``), reversal, or re-indexed set-ups.
    order_max : int
        Orders 2 to this one are separated, in undulations per revolution.
    sensitive_direction_deg : float, optional
        Direction in which the tool feels the motion, from +X towards +Y.
    u_angle_deg, u_reindex_deg : float
        Standard uncertainty of a sensor's angle (0: exact), and of a re-indexing.
    largest_condition : float
        An order whose equations are worse conditioned is suppressed.
    coverage_factor : float
        k of U = k u.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.spindle/1``; arrays ``angle_rad``, ``motion_mm``, ``u_motion_mm``, ``form_mm``,
        ``u_form_mm`` over one revolution.
    """
    one = isinstance(streams, (Stream, str)) or hasattr(streams, "__fspath__")
    if not one and not isinstance(streams, (list, tuple)):
        raise InputError("streams: give a stream, a path, or a list of them")
    many: list[Any] = [streams] if one else list(streams)  # type: ignore[arg-type]
    all_streams = [taken(each, None, None, {}) for each in many]
    with Shown("separation", progress) as shown:
        return result_of(_core.spindle(
            all_streams, int(number("order_max", order_max, 2, 1000)), sensitive_direction_deg,
            number("u_angle_deg", u_angle_deg, 0.0), number("u_reindex_deg", u_reindex_deg, 0.0),
            number("largest_condition", largest_condition, 1.0),
            number("coverage_factor", coverage_factor, 0.0, 100.0, above=True), shown))


@with_checked_arguments
def correct(diagnosis: Result, target: Document, *, progress: Progress = None) -> Result:
    """Computes the correction table of a diagnosed stream, or refuses to.

    Parameters
    ----------
    diagnosis : Result
        Of :func:`diagnose`.
    target : path or Mapping
        ``[target]``, ``[cut]`` and ``[actuator]`` as in a job.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.run/2``; ``files["table.csv"]``, and arrays ``c_rad``, ``position_mm``, ``wanted_mm``,
        ``command_mm`` of shape (rows,).

    Raises
    ------
    Refused
        If the table must not be run; ``error.result`` has the verdict.
    """
    outcome = diagnosis._found if isinstance(diagnosis, Result) else None
    if not isinstance(outcome, _core.DiagnosisOutcome):
        raise InputError("diagnosis: give what diagnose() returns")
    with as_file(target, "target") as path, Shown("correction", progress) as shown:
        return result_of(_core.correct(outcome, path, shown), diagnosis.stream)


class Simulation(NamedTuple):
    """Readings of the virtual lathe, and the truth about them.

    Attributes
    ----------
    stream : Stream
        The readings.
    truth : Result
        ``trueaxis.truth/1``; ``clean_mm`` are the readings without noise, shape (n,).
    """

    stream: Stream
    truth: Result


@with_checked_arguments
def simulate(scenario: Document, *, seed: int | None = None, progress: Progress = None) -> Simulation:
    """Probes a part on the virtual lathe.

    Parameters
    ----------
    scenario : path or Mapping
        A scenario: ``{"part": {...}, "pass": [{...}], "noise": {...}, "effect": [{...}]}``.
    seed : int, optional
        Seed of the noise; otherwise the scenario's.
    progress : callable, optional
        As in :func:`fit`.
    """
    with as_text(scenario, "scenario") as (text, name), Shown("simulation", progress) as shown:
        stream, truth = _core.simulate(text, name, None if seed is None else _seed(seed), shown)
    return Simulation(stream, result_of(truth, stream))

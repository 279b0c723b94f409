# SPDX-License-Identifier: Apache-2.0
"""Commands that read and write files, run in this process: job, sweep, plan, calibration, compensation."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path as FilePath
from typing import Any

import numpy as np

from . import _core
from ._arguments import with_checked_arguments
from ._errors import InputError, ended
from ._result import Result, Written
from ._streams import Path
from ._toml import Document, as_file
from ._work import Progress, Shown


def _options(given: Mapping[str, Any]) -> list[str]:
    """Returns keyword arguments as options of the command: ``goal_um=1`` is ``--goal-um 1``."""
    words: list[str] = []
    for name, value in given.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
            continue
        several = isinstance(value, (list, tuple))
        for one in value if several else [value]:
            words += [option, os.fspath(one) if isinstance(one, os.PathLike) else str(one)]
    return words


def _run(words: Sequence[str], doing: str, progress: Progress, json: FilePath, folder: FilePath | None = None,
         verdict: bool = False, scratch: bool = False) -> Result:
    """Runs a command and returns what it wrote.

    ``verdict``: exit code 1 with a result is an answer, not an error. ``scratch``: nothing stays in the folder.
    """
    with Shown(doing, progress) as shown:
        code, screen, said = _core.command(list(words), shown)
    files = {}
    for path in sorted(folder.iterdir()) if folder is not None and folder.is_dir() else []:
        if path.is_file() and path.suffix != ".bin":
            files[path.name] = path.read_text(encoding="utf-8")
    text = json.read_text(encoding="utf-8") if json.is_file() else ""
    if folder is not None and scratch:  # it is gone when the screen is read: its files are result.files
        screen, said = (one.replace(f"{folder}{os.sep}", "") for one in (screen, said))
    result = Result(Written(text, screen, files)) if text else None
    if result is None or code > 1 or (code == 1 and not verdict):
        raise ended(code, said, result)
    return result


@with_checked_arguments
def run_job(job: Document, output: Path | None = None, *, force: bool = False, progress: Progress = None) -> Result:
    """Does a whole job of a lathe or of a machine: fit, diagnosis, correction, verdict.

    Parameters
    ----------
    job : path or Mapping
        The job (TOML). File names in it are relative to it, and those in a dictionary to the working
        directory.
    output : path, optional
        Folder of the results. Without it nothing is kept but ``result.files``.
    force : bool
        Replace files that TrueAxis did not write.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.run/2``. ``verdict`` may be no go: that is an answer and no error.
    """
    with tempfile.TemporaryDirectory() as scratch, as_file(job, "job") as path:
        folder = FilePath(scratch, "result") if output is None else FilePath(output)
        words = ["run", path, "-o", str(folder), *_options({"force": force})]
        return _run(words, "job", progress, folder / "result.json", folder, verdict=True, scratch=output is None)


_PART = ("surface", "bore", "radius_mm", "half_angle_deg", "length_mm", "feed_mm", "per_revolution", "speed_rpm", "sigma_um")


@with_checked_arguments
def plan(scenario: Document | None = None, *, goal_um: float, free: Mapping[str, tuple[float, float]] | None = None,
         coverage_factor: float = 2.0, time_s: float | None = None, rate_hz: float | None = None,
         repeats: int = 1000, seed: int = 1, threads: int = 0, progress: Progress = None, **part: Any) -> Result:
    """Finds the length, readings and probe that an uncertainty of the axis needs.

    Parameters
    ----------
    scenario : path or Mapping, optional
        Part and passes. Without it they are given as ``surface``, ``bore``, ``radius_mm``, ``half_angle_deg``,
        ``length_mm``, ``feed_mm``, ``per_revolution``, ``speed_rpm``, ``sigma_um``.
    goal_um : float
        Largest U of the axis over the length, or of the height of a face, µm.
    free : Mapping of str to (low, high), optional
        What may be chosen: "readings_per_revolution", "sigma_um", "feed_mm_per_rev", "length_mm".
    time_s, rate_hz : float, optional
        Longest time, and readings per second of the probe.
    coverage_factor : float
        k of U = k u.
    repeats, seed : int
        Simulations for each confirmation, and the seed of their noise.
    threads : int
        0: as many as there are. The result does not depend on it.
    progress : callable, optional
        As in :func:`fit`.
    **part
        The part and its pass, as above.

    Returns
    -------
    Result
        ``trueaxis.plan/1``. ``status`` may be "not_reached": that is an answer and no error.
    """
    unknown = [name for name in part if name not in _PART]
    if unknown or (part and scenario is not None):
        raise InputError(f"{', '.join(unknown or part)}: a plan takes either a scenario or {', '.join(_PART)}")
    for key, ends in (free or {}).items():
        if np.shape(ends) != (2,):
            raise InputError(f"free: {key}: {ends!r} is not a range such as (4, 200)")
    ranges = [f"{key}={low}:{high}" for key, (low, high) in (free or {}).items()]
    given = dict(goal_um=goal_um, free=ranges, coverage_factor=coverage_factor, time_s=time_s, rate_hz=rate_hz,
                 repeats=repeats, seed=seed, threads=threads, **part)
    with tempfile.TemporaryDirectory() as scratch:
        json = FilePath(scratch, "plan.json")
        ending = [*_options(given), "--json", str(json)]
        if scenario is None:
            return _run(["study", "plan", *ending], "plan", progress, json, verdict=True)
        with as_file(scenario, "scenario") as path:
            return _run(["study", "plan", path, *ending], "plan", progress, json, verdict=True)


@with_checked_arguments
def sweep(sweep: Document, output: Path | None = None, *, threads: int = 0, force: bool = False,
          progress: Progress = None) -> Result:
    """Repeats a scenario over a grid with other noise, and compares with the Cramér-Rao bound.

    Parameters
    ----------
    sweep : path or Mapping
        The sweep (TOML).
    output : path, optional
        Folder of the results and of the journal by which a stopped sweep goes on.
    threads : int
        0: as many as there are. The result does not depend on it.
    force : bool
        Replace files that TrueAxis did not write.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.sweep/…``; ``to_pandas()`` is the table ``files["sweep.csv"]``.
    """
    with tempfile.TemporaryDirectory() as scratch, as_file(sweep, "sweep") as path:
        folder = FilePath(scratch, "result") if output is None else FilePath(output)
        words = ["study", "sweep", path, "-o", str(folder), *_options({"threads": threads, "force": force})]
        return _run(words, "sweep", progress, folder / "sweep.json", folder, scratch=output is None)


def _on_machine(command: str, inputs: Sequence[str], machine: Document, written: str, doing: str,
                progress: Progress, given: Mapping[str, Any]) -> Result:
    with tempfile.TemporaryDirectory() as scratch, as_file(machine, "machine") as path:
        folder = FilePath(scratch, "out")
        folder.mkdir()
        json = FilePath(scratch, "result.json")
        words = ["machine", command, *inputs, "--machine", path, *_options(given), "-o", str(folder / written),
                 "--json", str(json)]
        return _run(words, doing, progress, json, folder, scratch=True)


@with_checked_arguments
def calibrate(measurements: Path | Sequence[Path], machine: Document, *, errors: Sequence[Path] = (),
              sign: str | None = None, large_errors: bool = False, progress: Progress = None) -> Result:
    """Estimates the errors of a machine from measurements of a ball, a bar, an array or a read-out.

    Parameters
    ----------
    measurements : path or sequence of paths
        Measurements (CSV) that go together.
    machine : path or Mapping
        The machine (``trueaxis.machine/1``).
    errors : sequence of paths
        Known errors; several files add.
    sign : str, optional
        "moving_part" or "tool_minus_workpiece", of ISG and Etalon files.
    large_errors : bool
        Accept implausibly large errors: the units are correct.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.calibration/…``; ``files["errors.toml"]`` has the errors, which :class:`Machine` and
        :func:`compensate` take.
    """
    several = [measurements] if isinstance(measurements, (str, os.PathLike)) else list(measurements)
    given = dict(errors=list(errors), sign=sign, large_errors=large_errors)
    return _on_machine("calibrate", [os.fspath(one) for one in several], machine, "errors.toml", "calibration",
                       progress, given)


@with_checked_arguments
def compensate(program: Path, machine: Document, *, errors: Sequence[Path] = (), sign: str | None = None,
               large_errors: bool = False, method: str = "exact", rotary: str = "moved",
               tolerance_um: float | None = None, arcs_mm: float | None = None, decimals: int = 4,
               angle_decimals: int = 5, threads: int = 0, progress: Progress = None) -> Result:
    """Rewrites a program (ISO 6983) for a machine with errors; only positions change.

    Parameters
    ----------
    program : path
        The program.
    machine, errors, sign, large_errors
        As in :func:`calibrate`.
    method : str
        "exact" or "differential".
    rotary : str
        Rotary axes that a block may correct: "moved" or "all".
    tolerance_um : float, optional
        Split G1 blocks: deviation allowed from the straight line, µm.
    arcs_mm : float, optional
        Replace G2 and G3 by chords: deviation allowed from the arc, mm.
    decimals, angle_decimals : int
        Decimals of changed X Y Z, and of changed A B C.
    threads : int
        0: as many as there are. The result does not depend on it.
    progress : callable, optional
        As in :func:`fit`.

    Returns
    -------
    Result
        ``trueaxis.compensation/…``; ``files["program.nc"]`` is the new program.
    """
    given = dict(errors=list(errors), sign=sign, large_errors=large_errors, method=method, rotary=rotary,
                 tolerance_um=tolerance_um, arcs_mm=arcs_mm, decimals=decimals, angle_decimals=angle_decimals,
                 threads=threads)
    return _on_machine("compensate", [os.fspath(program)], machine, "program.nc", "compensation", progress, given)

# SPDX-License-Identifier: Apache-2.0
"""An argument of a wrong kind is an InputError that names it, in every function."""
import inspect
from pathlib import Path

import numpy as np
import pytest

import trueaxis as ta
from trueaxis._arguments import _KINDS

ROOT = Path(__file__).resolve().parents[2]
FUNCTIONS = [getattr(ta, name) for name in ta.__all__ if inspect.isfunction(getattr(ta, name))]
FUNCTIONS += [ta.Machine.__init__, ta.Machine.pose]
# What is looked at where it is used, because many kinds of arrays and streams will do.
ELSEWHERE = {"Readings", "npt.ArrayLike", "npt.ArrayLike | Path", "npt.ArrayLike | Mapping[str, npt.ArrayLike]", "Any",
             "Stream | Path", "Stream | Path | Sequence[Stream | Path]", "Result"}
CASES = [(function, name, parameter) for function in FUNCTIONS
         for name, parameter in inspect.signature(function).parameters.items() if name != "self"]


def _kind(parameter):
    return parameter.annotation.removesuffix(" | None")


def _readings():
    c_rad = np.linspace(0.0, 40.0 * np.pi, 400)
    x_mm = 25.0 + 0.04 * np.cos(c_rad) + 1e-3 * np.sin(17.3 * c_rad)
    return ta.stream(x_mm, c_rad, np.linspace(0.0, 30.0, 400), x_unit="mm radius", c_unit="rad", z_unit="mm")


def test_the_functions_are_found():
    assert len(FUNCTIONS) >= 16 and len(CASES) > 100


@pytest.mark.parametrize("function, name, parameter", CASES, ids=lambda case: getattr(case, "__qualname__", None))
def test_each_argument_has_its_kind(function, name, parameter):
    if _kind(parameter) in ELSEWHERE:
        return
    with pytest.raises(ta.InputError) as error:
        function(**{name: object()})
    assert str(error.value).startswith(f"{name}: <object obj") and _KINDS[_kind(parameter)][1] in str(error.value)


def test_all_that_is_wrong_is_one_error():
    with pytest.raises(ta.InputError) as error:
        ta.form(_readings(), seed=1.5, trials="40", noise_um="3", filter=None)
    assert str(error.value).splitlines() == [
        "seed: 1.5 is not a whole number", "trials: '40' is not a whole number: leave the quotes out",
        "noise_um: '3' is not a number: leave the quotes out", "filter: None is not a text"]


def test_numbers_of_numpy_are_numbers():
    readings = _readings()
    fit = ta.fit(readings, surface="cylinder", noise_um=np.float32(1.0), bore=np.False_, coverage_factor=np.int64(2))
    assert fit.to_json() == ta.fit(readings, surface="cylinder", noise_um=1.0).to_json()
    assert ta.form(readings, seed=np.uint32(7), trials=np.int16(20), band_upr=np.array([1, 15])).schema == "trueaxis.form/1"


@pytest.mark.parametrize("call", [
    lambda: ta.plan(goal_um=1.0, surface="kone", radius_mm=20.0, length_mm=20.0),
    lambda: ta.calibrate(ROOT / "data/five_axis/trunnion_ac_ball.csv", ROOT / "data/five_axis/trunnion_ac.toml", sign="x")])
def test_a_message_of_a_command_does_not_end_with_its_help(call):
    with pytest.raises(ta.InputError, match="not in {") as error:
        call()
    assert "help" not in str(error.value)


def test_a_seed_is_in_its_range():
    with pytest.raises(ta.InputError, match="^seed: -1 is not a whole number from 0"):
        ta.form(_readings(), seed=-1)

# SPDX-License-Identifier: Apache-2.0
"""TrueAxis finds where the reference surfaces of a clamped part really are.

>>> import numpy as np
>>> import trueaxis as ta
>>> c = np.linspace(0, 20 * np.pi, 500)
>>> z = np.linspace(0, 40, 500)
>>> x = 25 + z / 8 + 0.05 * np.cos(c) + 1e-3 * np.sin(7.7 * c)
>>> r = ta.fit(x, c, z, surface="cone", x_unit="mm radius", c_unit="rad", z_unit="mm")
>>> round(r.half_angle.value, 2), r.half_angle.unit
(7.12, 'deg')
"""
from ._commands import calibrate, compensate, plan, run_job, sweep
from ._core import Stream
from ._core import version as __version__
from ._errors import InputError, NumericalError, Refused, TrueAxisError
from ._lathe import Simulation, associate, correct, diagnose, fit, form, simulate, spindle
from ._machine import Machine, Poses
from ._result import Result
from ._streams import read, stream
from ._values import Covariance, Node, Quantity

__all__ = [
    "Covariance", "InputError", "Machine", "Node", "NumericalError", "Poses", "Quantity", "Refused", "Result",
    "Simulation", "Stream", "TrueAxisError", "__version__", "associate", "calibrate", "compensate", "correct",
    "diagnose", "fit", "form", "plan", "read", "run_job", "simulate", "spindle", "stream", "sweep",
]

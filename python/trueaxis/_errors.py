# SPDX-License-Identifier: Apache-2.0
"""Errors of the package, with the text that the command prints."""
from __future__ import annotations

from typing import Any


class TrueAxisError(Exception):
    """Base of all errors of this package.

    Attributes
    ----------
    result : Result or None
        What was computed all the same; its ``status`` says what is not determined.
    """

    result: Any = None


class InputError(TrueAxisError, ValueError):
    """An input is wrong: where, what is wrong, how to mend it."""


class Refused(TrueAxisError):
    """The input is understood, and the answer would not be safe to use."""


class NumericalError(TrueAxisError):
    """A fit did not converge, the readings do not determine its parameters, or they look misread (unit, column)."""


for _kind in (TrueAxisError, InputError, Refused, NumericalError):
    _kind.__module__ = "trueaxis"  # as users name them


def ended(code: int, why: str, result: Any = None) -> TrueAxisError:
    """Returns the error for an exit code of the command."""
    kind = {1: Refused, 2: InputError, 3: InputError, 4: NumericalError}.get(code, TrueAxisError)
    error = kind(why.replace("Run with --help for more information.", "").strip().removeprefix("refused: "))
    error.result = result
    return error

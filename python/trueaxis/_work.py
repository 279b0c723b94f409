# SPDX-License-Identifier: Apache-2.0
"""What long work shows, and the check of a number that a user states."""
from __future__ import annotations

import math
import sys
from collections.abc import Callable
from typing import Optional

from ._errors import InputError

Progress = Optional[Callable[[float], object]]


class Shown:
    """Shows on a terminal what is computed from two seconds on, as the command does."""

    def __init__(self, doing: str, progress: Progress) -> None:
        self._doing, self._shown = doing, False
        self.call: Progress = progress or (self._show if sys.stderr.isatty() else None)

    def _show(self, seconds: float) -> None:
        if seconds > 2.0:
            sys.stderr.write(f"\r\033[K{self._doing}, {seconds:.0f} s")
            sys.stderr.flush()
            self._shown = True

    def __enter__(self) -> Progress:
        return self.call

    def __exit__(self, *_: object) -> None:
        if self._shown:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()


def number(name: str, value: float, low: float, high: float = 1e6, above: bool = False) -> float:
    """Returns a number that is inside its range. An error names it."""
    inside = math.isfinite(value) and value <= high and (value > low if above else value >= low)
    if not inside:
        raise InputError(f"{name}: {value} is not a number {'above' if above else 'from'} {low:g} to {high:g}")
    return float(value)


def one_of(name: str, word: str, words: tuple[str, ...]) -> str:
    """Returns a word that is one of those allowed."""
    if word not in words:
        raise InputError(f"{name}: {word!r} is not one of {', '.join(words)}")
    return word

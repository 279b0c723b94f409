# SPDX-License-Identifier: Apache-2.0
"""What long work shows."""
from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Optional

Progress = Optional[Callable[[float, Optional[float]], object]]


class Shown:
    """Shows on a terminal what is computed from two seconds on, as the command does."""

    def __init__(self, doing: str, progress: Progress) -> None:
        self._doing, self._shown = doing, False
        self._call = progress

    def _show(self, seconds: float, share: float | None) -> None:
        if seconds > 2.0 and sys.stderr.isatty():
            done = "" if share is None else f", {share:.0%}"
            sys.stderr.write(f"\r\033[K{self._doing}, {seconds:.0f} s{done}")
            sys.stderr.flush()
            self._shown = True

    def __enter__(self) -> Progress:
        return self._call or self._show

    def __exit__(self, *_: object) -> None:
        if self._shown:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()

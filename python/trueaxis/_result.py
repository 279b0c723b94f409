# SPDX-License-Identifier: Apache-2.0
"""The result of a function: one class for all, made of the JSON that the command writes."""
from __future__ import annotations

import html
import io
import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from . import _plot
from ._errors import ended
from ._streams import Stream
from ._values import Floats, Node, frozen, quantities
from ._words import with_arguments

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from . import _core


_set = object.__setattr__


class Found(Protocol):
    """What a result is made of: texts that are made when they are asked for, and arrays."""

    def json(self) -> str: ...
    def screen(self) -> str: ...
    def file(self, name: str) -> str: ...
    def array(self, name: str) -> Floats: ...
    @property
    def files(self) -> list[str]: ...
    @property
    def arrays(self) -> list[str]: ...


class Written:
    """What a command wrote."""

    arrays: list[str] = []

    def __init__(self, json: str, screen: str, texts: Mapping[str, str]) -> None:
        self._json, self._screen, self._texts = json, screen, dict(texts)
        self.files = list(texts)

    def json(self) -> str:
        return self._json

    def screen(self) -> str:
        return self._screen

    def file(self, name: str) -> str:
        return self._texts[name]

    def array(self, name: str) -> Floats:
        raise KeyError(name)


class _Files(Mapping[str, str]):
    """Texts that are made when they are asked for."""

    def __init__(self, found: Found) -> None:
        self._found = found

    def __getitem__(self, name: str) -> str:
        if name not in self._found.files:
            raise KeyError(name)
        return self._found.file(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._found.files)

    def __len__(self) -> int:
        return len(self._found.files)


class Result:
    """What was found. It does not change.

    Every key of the command's JSON is an attribute. A fit's parameters are attributes themselves:
    ``fit.half_angle.value``, ``.u``, ``.U``, ``.unit``. Arrays have their unit in their name
    (``fit.residual_mm``). ``print(result)`` shows the command's screen.

    Attributes
    ----------
    stream : Stream or None
        The readings.
    """

    __slots__ = ("_found", "_json", "_tree", "stream")

    stream: Stream | None
    _found: Found
    _json: str | None
    _tree: Node | None

    def __init__(self, found: Found, stream: Stream | None = None) -> None:
        _set(self, "_found", found)
        _set(self, "_json", None)
        _set(self, "_tree", None)
        _set(self, "stream", stream)

    @property
    def files(self) -> Mapping[str, str]:
        """Text of each file that the command would write, by its name: ``report.html``, ``table.csv``."""
        return _Files(self._found)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a result does not change")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a result does not change")

    def __copy__(self) -> Result:
        return self  # it does not change

    def __deepcopy__(self, _: Any) -> Result:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a result belongs to this process and is not pickled: keep to_dict() or to_json(), and arrays")

    def to_json(self) -> str:
        """Returns the text that the command writes with ``--json``."""
        if self._json is None:
            _set(self, "_json", self._found.json())
        return str(self._json)

    def to_dict(self) -> dict[str, Any]:
        """Returns the same as a new dictionary, which may be changed."""
        return dict(json.loads(self.to_json()))

    def _all(self) -> Node:
        if self._tree is None:
            _set(self, "_tree", frozen(self.to_dict()))
        assert self._tree is not None
        return self._tree

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._found.arrays:
            return self._found.array(name)
        tree = self._all()
        for part in (tree, *self._parts()):
            if name in part:
                return part[name]
        raise AttributeError(f"{name}; there is {', '.join(self._names())}")

    def _parts(self) -> list[Node]:
        """Those whose names are attributes of the result too."""
        tree = self._all()
        return [tree[name] for name in ("parameters", "derived") if name in tree and isinstance(tree[name], Node)]

    def _reasons(self, code: int) -> list[str]:
        """Why the parameters of a refused result are not known; other errors say why themselves."""
        parts = self._parts() if code == 1 else []
        return list(dict.fromkeys(one.why for part in parts for _, one, _ in quantities(part) if one.why))

    def _names(self) -> list[str]:
        return [*self._all(), *(name for part in self._parts() for name in part), *self._found.arrays]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._names()]

    def to_pandas(self) -> pandas.DataFrame:
        """Returns every quantity as a row by its dotted name: value, u, U, unit, why, and what the entry of a list is of.

        Of ``budget.0.u.x0`` that is the source of the uncertainty, of ``sections.0.circles.1.x`` the reference circle,
        and of ``findings.0.parameters.amplitude`` the cause. A sweep returns its table ``sweep.csv``.
        """
        import pandas

        if "sweep.csv" in self.files:
            return pandas.read_csv(io.StringIO(self.files["sweep.csv"]), comment="#")
        rows = {name: (one.value, one.u, one.U, one.unit, one.why, of) for name, one, of in quantities(self._all())}
        return pandas.DataFrame.from_dict(rows, orient="index", columns=["value", "u", "U", "unit", "why", "of"])

    def plot(self) -> Figure:
        """Draws the result with matplotlib.

        A fit shows its residuals over C and Z, its polar roundness and its axis with U; a diagnosis
        the spectrum before and after as well; a form, a separation and a correction their curves. A job
        shows the axis of each seat and its table, a sweep the ratio of error and bound, a plan U and
        its goal, a calibration the errors with U.

        Returns
        -------
        matplotlib.figure.Figure
        """
        return _plot.figure_of(self)

    def __str__(self) -> str:
        """The screen of the command, with arguments for its options; of a truth, which has none, the JSON."""
        return (with_arguments(self._found.screen()) or self.to_json()).rstrip("\n")

    def __repr__(self) -> str:
        headline = self._found.screen().partition("\n")[0]
        return f"<{self.schema}: {headline}>" if headline else f"<{self.schema}>"

    def _repr_html_(self) -> str:
        return f'<pre style="white-space: pre-wrap">{html.escape(str(self))}</pre>' + _plot.svg_of(self)


def result_of(outcome: _core.Outcome, stream: Stream | None = None) -> Result:
    """Returns the result of an outcome, or raises what the command ends with."""
    result = Result(outcome, stream)
    if outcome.code != 0:
        raise ended(outcome.code, "\n".join([outcome.why, *result._reasons(outcome.code)]), result)
    return result

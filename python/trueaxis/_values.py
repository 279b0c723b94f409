# SPDX-License-Identifier: Apache-2.0
"""Values of a result: what the JSON of the command says, as immutable objects."""
from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Quantity:
    """A value with its uncertainty and unit.

    Attributes
    ----------
    value : float
        NaN if the readings do not determine it; ``why`` then says why not.
    u : float
        Standard uncertainty (k = 1) in the same unit, NaN if there is none.
    unit : str
        "mm", "deg", "s", "1" ...
    k : float
        Coverage factor of ``U``.
    why : str
        Why a number is missing; empty if none is.
    interval : tuple of float or None
        Ends of the coverage interval if value ± U is not one (the apex of a cone).
    """

    value: float
    u: float = math.nan
    unit: str = "1"
    k: float = 2.0
    why: str = ""
    interval: tuple[float, float] | None = None

    @property
    def U(self) -> float:
        """Expanded uncertainty U = k u; of an interval its larger side."""
        if self.interval is not None:
            return max(self.value - self.interval[0], self.interval[1] - self.value)
        return self.k * self.u

    def __float__(self) -> float:
        return self.value

    def __format__(self, form: str) -> str:
        """A format such as ``.3f`` is that of the value; without one the uncertainty and unit are there."""
        return format(self.value, form) if form else str(self)

    def __str__(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        if math.isnan(self.value):
            return "not determined" + (f" ({self.why})" if self.why else "")
        if not self.U > 0.0:
            return f"{self.value:.6g}{unit}"
        if self.U < 1e-12:  # rounding: the deepest valley about the circle inside it is 0, not 3.55e-15 ± 6e-19 mm
            return f"{round(self.value, 12):.12g}{unit}"
        decimals = max(1 - math.floor(math.log10(self.U)), 0)  # two digits of U (GUM 7.2.6)
        return f"{self.value:.{decimals}f} ± {self.U:.{decimals}f}{unit}"


@dataclass(frozen=True, eq=False)
class Covariance:
    """A covariance matrix with the names of its rows.

    Attributes
    ----------
    names : tuple of str
        Name of row and column i.
    matrix : ndarray, shape (n, n)
        Entries in the product of the units of both names; read-only.
    """

    names: tuple[str, ...]
    matrix: Floats

    def __post_init__(self) -> None:
        entries = np.asarray(self.matrix, dtype=np.float64)
        of_bytes = np.frombuffer(entries.tobytes(), dtype=np.float64)  # cannot be made writeable
        object.__setattr__(self, "matrix", of_bytes.reshape(entries.shape))

    def __reduce__(self) -> tuple[Any, ...]:
        return Covariance, (self.names, self.matrix)

    def between(self, first: str, second: str) -> float:
        """Returns the covariance of two quantities by name."""
        return float(self.matrix[self.names.index(first), self.names.index(second)])

    def correlation(self) -> Floats:
        """Returns the matrix of correlations, shape (n, n)."""
        sd = np.sqrt(np.diag(self.matrix))
        return np.asarray(self.matrix / np.outer(sd, sd), dtype=np.float64)


class Node:
    """A part of a result: ``node.name`` and ``node["name"]`` are the same; ``list(node)`` are its names."""

    __slots__ = ("_items",)
    _items: Mapping[str, Any]

    def __init__(self, items: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_items", MappingProxyType(dict(items)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Node, (dict(self._items),)

    def keys(self) -> Iterator[str]:
        """Returns the names, so that ``dict(node)`` works."""
        return iter(self._items)

    def __getitem__(self, name: str) -> Any:
        return self._items[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __contains__(self, name: object) -> bool:
        return name in self._items

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._items[name]
        except KeyError:
            raise AttributeError(f"{name}; there is {', '.join(self._items)}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a result does not change")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a result does not change")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._items]

    def __repr__(self) -> str:
        return "{" + ", ".join(f"{name}: {value}" for name, value in self._items.items()) + "}"


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)


def _by_name(json: list[Any]) -> dict[str, Any] | None:
    """Returns a list of quantities that have names, such as those of a form, by name and reference: RONt_LSCI."""
    if not json or not all(isinstance(one, dict) and {"name", "value", "unit"} <= one.keys() for one in json):
        return None
    named = {"_".join(one[key] for key in ("name", "reference") if key in one): one for one in json}
    return named if len(named) == len(json) else None


def frozen(json: Any, k: float = 2.0) -> Any:
    """Returns JSON as immutable objects: quantities, covariances, nodes and tuples."""
    if isinstance(json, list):
        named = _by_name(json)
        return tuple(frozen(item, k) for item in json) if named is None else frozen(named, k)
    if not isinstance(json, dict):
        return json
    k = float(json.get("coverage_factor", k))
    if "unit" in json and isinstance(json.get("value", ""), (int, float, type(None))):
        ends = json.get("interval")
        return Quantity(_number(json["value"]), _number(json.get("u")), json["unit"], k,
                        json.get("why", ""), None if ends is None else (float(ends[0]), float(ends[1])))
    if json.keys() == {"order", "matrix"}:
        return Covariance(tuple(json["order"]), np.array([[_number(value) for value in row] for row in json["matrix"]]))
    return Node({name: frozen(value, k) for name, value in json.items()})


def _of(tree: Any) -> str:
    """What an entry of a list is of, by the key that says so: ``"noise of the readings"`` of a budget's line."""
    said = [tree[key] for key in ("source", "effect", "reference", "name", "plan") if isinstance(tree, Node) and key in tree]
    return said[0] if said and isinstance(said[0], str) else ""


def quantities(tree: Any, name: str = "", of: str = "") -> Iterator[tuple[str, Quantity, str]]:
    """Yields every quantity of a result with its dotted name and what the entry of a list that it is in is of."""
    if isinstance(tree, Quantity):
        yield name, tree, of
    elif isinstance(tree, Node):
        for key in tree:
            yield from quantities(tree[key], f"{name}.{key}" if name else key, of)
    elif isinstance(tree, tuple):
        for i, value in enumerate(tree):
            yield from quantities(value, f"{name}.{i}", _of(value) or of)

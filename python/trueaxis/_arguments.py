# SPDX-License-Identifier: Apache-2.0
"""What a user states: each argument is of the kind that the signature says, and numbers are in their range."""
from __future__ import annotations

import functools
import math
import os
import reprlib
from collections.abc import Callable, Mapping
from numbers import Integral, Real
from typing import Any, TypeVar, cast

import numpy as np

from ._errors import InputError, TrueAxisError
from ._words import in_python

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _is_flag(value: Any) -> bool:
    return isinstance(value, (bool, np.bool_))


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not _is_flag(value)


def _is_whole(value: Any) -> bool:
    return isinstance(value, Integral) and not _is_flag(value)


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


def _anything(_: Any) -> bool:
    return True


def _are(test: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda values: isinstance(values, (list, tuple, np.ndarray)) and all(test(one) for one in values)


# An annotation: what is accepted, and how a message calls it. Kinds that are not here are looked at where they are used.
_KINDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "bool": (_is_flag, "True or False"),
    "int": (_is_whole, "a whole number"),
    "float": (_is_number, "a number"),
    "str": (lambda value: isinstance(value, str), "a text"),
    "Path": (_is_path, "a path"),
    "Document": (lambda value: _is_path(value) or isinstance(value, Mapping), "a path or a dictionary"),
    "Progress": (callable, "a function of the seconds since the beginning and of the share that is done"),
    "Sequence[float]": (_are(_is_number), "a list of numbers"),
    "Sequence[Path]": (_are(_is_path), "a list of paths"),
    "Path | Sequence[Path]": (lambda value: _is_path(value) or _are(_is_path)(value), "a path or a list of paths"),
    "tuple[float, float]": (lambda value: _are(_is_number)(value) and len(value) == 2, "two numbers such as (1, 50)"),
    "Mapping[str, str]": (
        lambda value: isinstance(value, Mapping) and all(isinstance(one, str) for pair in value.items() for one in pair),
        'a dictionary of texts such as {"lag_ms": "0.4±0.1"}'),
    "Mapping[str, tuple[float, float]]": (
        lambda value: isinstance(value, Mapping) and all(_are(_is_number)(one) and len(one) == 2 for one in value.values()),
        'a dictionary of ranges such as {"sigma_um": (0.5, 2)}'),
    "Mapping[str, object]": (lambda value: isinstance(value, Mapping), "a dictionary"),
}


def _remedy(value: Any, what: str) -> str:
    if isinstance(value, str) and what.endswith("number"):
        return ": leave the quotes out"
    if _is_path(value) and what == "a list of paths":
        return f": write [{os.fspath(value)!r}]"
    return ""


def with_checked_arguments(function: _Function) -> _Function:
    """A function whose arguments are looked at first: those of a wrong kind are one InputError, all of them."""
    kinds: dict[str, tuple[Callable[[Any], bool], str, bool]] = {}
    for name, annotation in function.__annotations__.items():
        kind = annotation.removesuffix(" | None") if isinstance(annotation, str) else ""
        if name != "return" and kind in _KINDS:
            kinds[name] = (*_KINDS[kind], kind != annotation or kind == "Progress")
    order = function.__code__.co_varnames[:function.__code__.co_argcount]
    fine: set[tuple[str, type]] = set()  # fits whatever the value: a call in a row is looked at in no time

    def look(stated: Mapping[str, Any]) -> None:
        wrong = []
        for name, value in stated.items():
            fits, what, optional = kinds.get(name, (_anything, "", True))
            if not (fits(value) or (optional and value is None)):
                wrong.append(f"{name}: {reprlib.repr(value)} is not {what}{_remedy(value, what)}")
            elif not isinstance(value, (list, tuple, np.ndarray, Mapping)):
                fine.add((name, type(value)))
        if wrong:
            raise InputError("\n".join(wrong))

    @functools.wraps(function)
    def call(*args: Any, **given: Any) -> Any:
        if not (fine.issuperset(zip(order, map(type, args))) and fine.issuperset(zip(given, map(type, given.values())))):
            look({**dict(zip(order, args)), **given})
        try:
            return function(*args, **given)
        except TrueAxisError as error:
            first = args[0] if args else next(iter(given.values()), None)
            error.args = (in_python(str(error), first, "c" in order, given.get("source", "arrays")),)
            raise

    call.__kwdefaults__ = function.__kwdefaults__  # stream() and read() list them
    return cast(_Function, call)


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

# SPDX-License-Identifier: Apache-2.0
"""Scenarios, jobs and targets as dictionaries: TOML is what the library reads."""
from __future__ import annotations

import contextlib
import json
import os
import re
import tempfile
from collections.abc import Iterator, Mapping
from typing import Any, Union

import numpy as np

from ._errors import InputError, TrueAxisError
from ._streams import Path

Document = Union[Path, Mapping[str, Any]]

_FILES = ("stream", "scenario", "file", "errors", "data", "program", "nominal", "table", "template")  # keys of file names


def _value(value: Any, of: str) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(name)} = {_value(item, of)}" for name, item in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_value(item, of) for item in value) + "]"
    raise InputError(f"{of}: {value!r} is not a number, a text, a list or a dictionary")


def _key(name: str) -> str:
    return name if name.replace("_", "").replace("-", "").isalnum() else json.dumps(name)


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(one, Mapping) for one in value)


def _lines(document: Mapping[str, Any], name: str, table: str = "") -> Iterator[tuple[str, str]]:
    """Yields each line of TOML with what it is of in the dictionary called `name`: ``sweep["axis"][0]["key"]``."""
    tables = []
    for key, value in document.items():
        of = f'{name}["{key}"]'
        if isinstance(value, Mapping) or _is_tables(value):
            tables.append((of, table + _key(key), value))
        else:
            yield of, f"{_key(key)} = {_value(value, of)}\n"
    for of, inner, value in tables:
        if isinstance(value, Mapping):
            yield of, f"[{inner}]\n"
            yield from _lines(value, of, inner + ".")
        else:
            for i, one in enumerate(value):
                yield f"{of}[{i}]", f"[[{inner}]]\n"
                yield from _lines(one, f"{of}[{i}]", inner + ".")


def to_toml(document: Mapping[str, Any]) -> str:
    """Returns a dictionary as TOML: tables [a.b] of dictionaries, [[a]] of lists of them."""
    return "".join(line for _, line in _lines(document, "document"))


def _by_keys(text: str, document: Mapping[str, Any], name: str, path: str) -> str:
    """Returns a message about lines of TOML that nobody wrote with the keys of the dictionary instead."""
    places = [place for place, _ in _lines(document, name)]

    def place(match: re.Match[str]) -> str:
        return (name if match.group(2) or not places else places[int(match.group(1)) - 1]) + ": " + match.group(2)

    top = r"(the top level |`[^`]*` in the top level |)"
    return re.sub(rf"{re.escape(path)}:(\d+)(?::\d+)?: {top}", place, text).replace(path, name)


def _placed(value: Any, key: str = "") -> Any:
    """Returns a document whose file names do not depend on where it is written."""
    if isinstance(value, Mapping):
        return {name: _placed(item, name) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_placed(item, key) for item in value]
    if isinstance(value, os.PathLike) or (isinstance(value, str) and value and key in _FILES):
        return os.path.abspath(value)
    return value


@contextlib.contextmanager
def as_file(document: Document, name: str) -> Iterator[str]:
    """The path of a document, which is the argument `name`; of a dictionary that of a file that is there as long as it is used.

    File names in a dictionary are relative to the working directory.
    """
    if not isinstance(document, Mapping):
        yield os.fspath(document)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name + ".toml")
        placed = _placed(document)
        with open(path, "w", encoding="utf-8") as file:
            file.write("".join(line for _, line in _lines(placed, name)))
        try:
            yield path
        except TrueAxisError as error:
            error.args = (_by_keys(str(error), placed, name, path),)
            raise


@contextlib.contextmanager
def as_text(document: Document, name: str) -> Iterator[tuple[str, str]]:
    """The text of a document, which is the argument `name`, and its path."""
    if isinstance(document, Mapping):
        try:
            yield "".join(line for _, line in _lines(document, name)), name
        except TrueAxisError as error:
            error.args = (_by_keys(str(error), document, name, name),)
            raise
        return
    path = os.fspath(document)
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    yield text, path

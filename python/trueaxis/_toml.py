# SPDX-License-Identifier: Apache-2.0
"""Scenarios, jobs and targets as dictionaries: TOML is what the library reads."""
from __future__ import annotations

import contextlib
import json
import os
import tempfile
from collections.abc import Iterator, Mapping
from typing import Any, Union

import numpy as np

from ._errors import InputError, TrueAxisError
from ._streams import Path

Document = Union[Path, Mapping[str, Any]]

_FILES = ("stream", "scenario", "file", "errors", "data", "program", "nominal", "table", "template")  # keys of file names


def _value(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(name)} = {_value(item)}" for name, item in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    raise InputError(f"{value!r} cannot be written as TOML")


def _key(name: str) -> str:
    return name if name.replace("_", "").replace("-", "").isalnum() else json.dumps(name)


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(one, Mapping) for one in value)


def to_toml(document: Mapping[str, Any], path: str = "") -> str:
    """Returns a dictionary as TOML: tables [a.b] of dictionaries, [[a]] of lists of them."""
    lines, tables = [], []
    for name, value in document.items():
        if isinstance(value, Mapping) or _is_tables(value):
            tables.append((path + _key(name), value))
        else:
            lines.append(f"{_key(name)} = {_value(value)}\n")
    for name, value in tables:
        if isinstance(value, Mapping):
            lines.append(f"[{name}]\n" + to_toml(value, name + "."))
        else:
            lines.extend(f"[[{name}]]\n" + to_toml(one, name + ".") for one in value)
    return "".join(lines)


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
    """The path of a document; of a dictionary that of a file that is there as long as it is used.

    File names in a dictionary are relative to the working directory.
    """
    if not isinstance(document, Mapping):
        yield os.fspath(document)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(to_toml(_placed(document)))
        try:
            yield path
        except TrueAxisError as error:
            error.args = (str(error).replace(path, name),)  # the file is not there when the error is read
            raise


def as_text(document: Document, name: str) -> tuple[str, str]:
    """The text of a document, and the name that messages give it."""
    if isinstance(document, Mapping):
        return to_toml(document), name
    path = os.fspath(document)
    try:
        with open(path, encoding="utf-8") as file:
            return file.read(), path
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None

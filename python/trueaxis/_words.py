# SPDX-License-Identifier: Apache-2.0
"""Messages of the command in the words of Python: an option is an argument, a row of arrays an index."""
from __future__ import annotations

import functools
import os
import re
import shlex
import weakref
from collections.abc import Mapping
from typing import Any

# Streams of arrays: whether the columns were named, as those of a table are.
made_of_table: weakref.WeakKeyDictionary[Any, bool] = weakref.WeakKeyDictionary()

_READS = re.compile(r"the command that would read it: trueaxis import ([^\n(]*[^\s(])")
_NUMBER = re.compile(r"-?\d+(\.\d+)?")
_COMMAND = re.compile(r"(`trueaxis [^`]*`)")
_OPTIONS = [(re.compile(pattern), argument) for pattern, argument in (
    (r"--verbose prints all", "to_dict() has all"),
    (r"^(\S+): is not (an element|a criterion)\b", r"'\1' is not \2"),
    (r"--(radius|diameter)\b", r'x="\1"'),
    (r"--upr (\d+)-(\d+)", r"band_upr=(\1, \2)"),
    (r"--(drop-invalid|relative|large-errors|force|bore)\b", r"\1=True"),
    (r"--(surface|loss|filter|sign) (cone|cylinder|section|plane|sphere|torus|huber|tukey|none|moving_part|"
     r"tool_minus_workpiece)\b", r'\1="\2"'),
    (r"--([a-z][a-z-]+) (-?\d+(?:\.\d+)?)\b", r"\1=\2"),
    (r"--([a-z][a-z-]+)", r"\1"))]

_POINT = re.compile(r"^points:(\d+): ", re.M)
_ROWS = re.compile(r"\b(in )?(?:data rows?|rows?|lines) (\d+(?:[,–-] ?\d+)*)")
_METADATA = [(re.compile(pattern), argument) for pattern, argument in (
    (r"'# reading: relative'", "relative=True"),
    (r"'# nominal_radius: ([\d.]+) mm'", r"nominal_radius_mm=\1"),
    (r"'# nominal_radius: R mm'", "nominal_radius_mm=R"),
    (r"'# (\w+): (-?[\d.]+(?:e[+-]\d+)?)'", r'metadata={"\1": \2}'),
    (r"'# (\w+): ([^']*)'", r'metadata={"\1": "\2"}'),
    (r", or '##' before free text", ""))]
ARGUMENTS = {"X_M": "x", "C": "c", "Z": "z", "t": "t_s"}
_UNITS = [(re.compile(pattern), argument) for pattern, argument in (
    (r"unknown unit '([^']*)' of X_M", r"x_unit: unknown unit '\1'"),
    (r"unknown unit '([^']*)' of C", r"c_unit: unknown unit '\1'"),
    (r"unknown unit '([^']*)' of Z", r"z_unit: unknown unit '\1'"),
    (r"\bC\[(\w+)\]", r'c_unit="\1"'),
    (r"exchange their names in the header", "exchange the arguments"),
    (r"write t\[ms\]", "divide t_s by 1000"))]


def argument_of(header: str) -> str:
    """Returns the argument that a column of a stream came from: of ``X_M1[mm]`` it is x."""
    return ARGUMENTS[header.partition("[")[0].rstrip("0123456789")]


def _option(match: re.Match[str], argument: str) -> str:
    head = match.group(0).split(" ")[0]
    return match.expand(argument).replace(head[2:], head[2:].replace("-", "_"))


def _to_read(match: re.Match[str]) -> str:
    """The command that would read a file as the arguments that do: ``columns="X=4,C=2", x="diameter"``."""
    words, arguments = iter(shlex.split(match.group(1))[1:]), []
    for word in words:
        if word in ("--radius", "--diameter"):
            arguments.append(f'x="{word[2:]}"')
        elif word == "--relative":
            arguments.append("relative=True")
        elif (value := next(words, "")) and word != "-o":
            arguments.append(f"{word[2:].replace('-', '_')}=" + (value if _NUMBER.fullmatch(value) else f'"{value}"'))
    return f"the arguments that would read it: {', '.join(arguments)}"


def with_arguments(text: str) -> str:
    """Returns a message or a screen whose options are arguments; commands in it stay."""
    parts = _COMMAND.split(_READS.sub(_to_read, text))
    for i in range(0, len(parts), 2):
        for pattern, argument in _OPTIONS:
            parts[i] = pattern.sub(functools.partial(_option, argument=argument), parts[i])
    return "".join(parts)


def _index(match: re.Match[str]) -> str:
    rows = re.sub(r"\d+", lambda row: str(int(row.group()) - 1), match.group(2))
    return f"{'at ' if match.group(1) else ''}{'index' if rows.isdigit() else 'indexes'} {rows}"


def _located(line: str, source: str, names: Mapping[str, str]) -> str:
    """A row of the source is an index of the array: ``arrays:8: X_M: …`` is ``x[7]: …``."""
    at = re.match(rf"{re.escape(source)}:(\d+)(?::\d+)?: (?:(X_M\d*|C|Z_M|Z|X|t)\b:? ?)?", line)
    if at is None:
        return line
    of = at.group(2)
    return f"{names.get(of, of) if of else source}[{int(at.group(1)) - 1}]: {line[at.end():]}"


def _of_arrays(text: str, source: str, table: bool) -> str:
    """Returns a message about a stream of arrays in their names, indexes and arguments."""
    text = "\n".join(_located(line, source, {} if table else ARGUMENTS) for line in text.split("\n"))
    text = _ROWS.sub(_index, text)
    for pattern, argument in _METADATA + ([] if table else _UNITS):
        text = pattern.sub(argument, text)
    return text.removeprefix(f"{source}: ") if re.match(rf"{re.escape(source)}: [xcz]_unit:", text) else text


def in_python(text: str, given: Any, readings: bool = False, source: str = "arrays") -> str:
    """Returns a message of a function whose first argument is given, readings or something else, in words of Python."""
    text = with_arguments(text)
    if isinstance(given, (str, os.PathLike)):
        return text
    text = _POINT.sub(lambda at: f"points[{int(at.group(1)) - 1}]: ", text)
    return _of_given(text, given, source) if readings else text


def _of_given(text: str, readings: Any, source: str) -> str:
    if not hasattr(readings, "input_hash"):
        return _of_arrays(text, source, isinstance(readings, Mapping) or hasattr(readings, "columns"))
    table = made_of_table.get(readings)
    return text if table is None else _of_arrays(text, readings.source, table)

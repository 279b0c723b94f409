#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs notebooks (percent format) and writes each as a page with what it prints and its figures.

  python/notebooks/run.py FOLDER [NOTEBOOK …]

A cell begins with `# %%`; one of text with `# %% [markdown]`. As in Jupyter, the value of a cell's last line is shown.
"""
import ast
import contextlib
import io
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def cells(path):
    """Yields (is text, content) of each cell."""
    for cell in path.read_text(encoding="utf-8").split("\n# %%")[1:]:
        head, _, body = cell.partition("\n")
        if head.strip() == "[markdown]":
            yield True, "\n".join(line[2:] if line.startswith("# ") else line.lstrip("#") for line in body.splitlines())
        else:
            yield False, body.strip("\n")


def run_cell(code, names, path):
    """Runs a cell. Returns what it prints and the value of its last line."""
    tree = ast.parse(code, str(path))
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, str(path), "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), str(path), "eval"), names)
    return printed.getvalue(), value


def page_of(path, folder):
    """Runs a notebook and writes its page and figures."""
    names, page = {"__name__": "__main__"}, []
    for text, content in cells(path):
        if text:
            page.append(content.strip() + "\n")
            continue
        printed, value = run_cell(content, names, path)
        page.append(f"```python\n{content}\n```\n")
        if hasattr(value, "savefig"):
            figure = f"{path.stem}_{len(page)}.png"
            value.savefig(folder / figure, dpi=110)
            page.append(f"![{value.axes[0].get_title() or path.stem}]({figure})\n")
        elif value is not None:
            printed += f"{value}\n"
        if printed:
            page.append(f"```text\n{printed.rstrip()}\n```\n")
    (folder / f"{path.stem}.md").write_text("\n".join(page), encoding="utf-8")


def notebooks():
    return sorted(path for path in HERE.glob("*.py") if path.name != Path(__file__).name)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    where = Path(sys.argv[1])
    where.mkdir(parents=True, exist_ok=True)
    for one in [Path(name) for name in sys.argv[2:]] or notebooks():
        page_of(one, where)

# SPDX-License-Identifier: Apache-2.0
"""Every notebook runs, and its own comparisons with SciPy and NumPy hold."""
import importlib.util
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
spec = importlib.util.spec_from_file_location("run", FOLDER / "run.py")
run = importlib.util.module_from_spec(spec)
spec.loader.exec_module(run)


@pytest.mark.parametrize("path", run.notebooks(), ids=lambda path: path.stem)
def test_a_notebook_runs_and_has_a_figure(path, tmp_path):
    run.page_of(path, tmp_path)
    page = (tmp_path / f"{path.stem}.md").read_text(encoding="utf-8")
    assert page.startswith("# ") and "```python" in page
    assert all(figure.stat().st_size > 5000 for figure in tmp_path.glob("*.png")) and list(tmp_path.glob("*.png"))


def test_there_are_six():
    assert len(run.notebooks()) == 6

# SPDX-License-Identifier: Apache-2.0
"""The page "Use from Python" shows what its lines print, and so does the docstring of the package."""
import doctest
import re
from pathlib import Path

import trueaxis as ta

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/how-to/use-from-python.md"


def test_the_page_shows_what_its_lines_print(monkeypatch, tmp_path):
    text = re.sub(r"^```.*$", "", PAGE.read_text(encoding="utf-8"), flags=re.M)
    assert text.count(">>>") > 10
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    examples = doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)
    said = []
    failed = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS, verbose=False).run(examples, out=said.append)
    assert failed.failed == 0, "".join(said)


def test_the_docstring_of_the_package_holds():
    assert doctest.testmod(ta).failed == 0

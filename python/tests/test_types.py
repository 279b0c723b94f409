# SPDX-License-Identifier: Apache-2.0
"""The package and a user of it have types that mypy accepts; the stub of the module says what is there."""
import subprocess
import sys
from pathlib import Path

import pytest
import trueaxis as ta
from trueaxis import _core

PYTHON = Path(__file__).resolve().parents[1]

USER = """
import numpy as np
import trueaxis as ta

x = np.ones(9)
fit: ta.Result = ta.fit(x, x, x, surface="cone", x_unit="mm radius", c_unit="rad", z_unit="mm")
stream: ta.Stream = ta.read("a.csv", x="radius")
tips = ta.Machine("machine.toml").pose(x_mm=1.0).tip_mm
tips.shape
"""


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Its runs share what it has read of NumPy; the first of them has nothing to go on from."""
    cache = tmp_path_factory.mktemp("mypy")

    def ran(*words):
        return subprocess.run([sys.executable, "-m", "mypy", "--config-file", str(PYTHON.parent / "pyproject.toml"), "--cache-dir",
                               str(cache), *words], capture_output=True, text=True, cwd=PYTHON)
    return ran


def test_the_package_has_strict_types(mypy):
    ran = mypy("-p", "trueaxis")
    assert ran.returncode == 0, ran.stdout


def test_a_user_has_types(tmp_path, mypy):
    (tmp_path / "user.py").write_text(USER)
    ran = mypy(str(tmp_path / "user.py"))
    assert ran.returncode == 0, ran.stdout
    (tmp_path / "user.py").write_text(USER.replace('x_mm=1.0', 'nominal="yes", x_mm=1.0'))
    assert "nominal" in mypy(str(tmp_path / "user.py")).stdout


def test_the_stub_names_what_is_there():
    text = (PYTHON / "trueaxis/_core.pyi").read_text()
    there = {name for name in dir(_core) if not name.startswith("_")}
    stated = {line.split()[1].split("(")[0].rstrip(":") for line in text.splitlines() if line.startswith(("def ", "class "))}
    assert there - {"version"} == stated


def test_every_function_has_a_docstring_with_its_parameters():
    import inspect

    for name in ta.__all__:
        one = getattr(ta, name)
        if not inspect.isfunction(one):
            continue
        for parameter in inspect.signature(one).parameters:
            assert parameter in one.__doc__ or "As in" in one.__doc__, (name, parameter)

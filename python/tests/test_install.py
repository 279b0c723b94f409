# SPDX-License-Identifier: Apache-2.0
"""`pip install` of the repository works without a network, and what is installed works without the repository."""
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_pip_installs_it(tmp_path):
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-index", "--no-deps",
                    "--target", tmp_path / "site", "."], cwd=ROOT, env=environment, check=True)
    said = subprocess.run([sys.executable, "-c", "import trueaxis as ta; print(ta.__file__, ta.__version__); "
                           "print(ta.fit('part.csv', surface='cone').half_angle)"],
                          env={**environment, "PYTHONPATH": str(tmp_path / "site")}, cwd=_with_a_stream(tmp_path),
                          check=True, capture_output=True, text=True).stdout
    assert said.startswith(str(tmp_path / "site")) and " ± " in said
    assert (tmp_path / "site/trueaxis/py.typed").exists() and (tmp_path / "site/trueaxis/_core.pyi").exists()


def _with_a_stream(folder):
    (folder / "part.csv").write_bytes((ROOT / "data/streams/shaft_cone_seat.csv").read_bytes())
    return folder

# SPDX-License-Identifier: Apache-2.0
"""Builds the module of C++ with CMake; everything else of the package is in pyproject.toml."""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
# A build that is there goes on: TRUEAXIS_BUILD=build/release is that of scripts/build.
BUILD = Path(os.environ.get("TRUEAXIS_BUILD", ROOT / "build/pip"))


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        target = Path(self.get_ext_fullpath(ext.name)).resolve()
        if not (BUILD / "build.ninja").exists():
            subprocess.run(["cmake", "--preset", "release", "-B", BUILD, "-DTRUEAXIS_PYTHON=ON", "-DTRUEAXIS_TESTS=OFF",
                            "-DTRUEAXIS_EXAMPLES=OFF", f"-DPython_EXECUTABLE={sys.executable}"], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "trueaxis_python"], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(next((BUILD / "python/trueaxis").glob("_core.*.so"))), str(target))


setup(
    version=re.search(r"project\(trueaxis VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1),
    packages=["trueaxis"],
    package_dir={"": "python"},
    package_data={"trueaxis": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("trueaxis._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)

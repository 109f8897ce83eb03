"""Builds the module with CMake, from the checkout around this folder. For pip: see README.md."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


def version() -> str:
    """The version is that of the project."""
    return re.search(r"project\(deliso VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, extension: Extension) -> None:
        target = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = Path(self.build_temp).resolve()
        options = ["-DDELISO_PYTHON=ON", "-DDELISO_PROGRAM=OFF", "-DDELISO_TESTS=OFF", "-DCMAKE_BUILD_TYPE=Release",
                   f"-DPython_EXECUTABLE={sys.executable}"]
        if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ:
            options += ["-G", "Ninja"]
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *options], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "--build", str(build), "--target", "deliso_python", "--parallel", jobs], check=True)
        target.mkdir(parents=True, exist_ok=True)
        for module in (build / "experiments" / "python" / "deliso").glob("_deliso.*.so"):
            shutil.copy(module, target / module.name)


setup(version=version(), ext_modules=[Extension("deliso._deliso", sources=[])], cmdclass={"build_ext": CMakeBuild})

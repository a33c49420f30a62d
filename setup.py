"""`pip install .` and `pip wheel .`: CMake builds the module and puts the package where setuptools wants it.

PHY_BUILD names a build folder that is there already, else build/release is made."""
import os
import pathlib
import re
import subprocess

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parent


def version():
    """As the changelog has it: "X-dev" is X.dev0 to Python."""
    newest = re.search(r"^## (\d+\.\d+\.\d+)(-dev)?", (root / "CHANGELOG.md").read_text(), re.M)
    return newest[1] + (".dev0" if newest[2] else "")


class BuildByCMake(build_ext):
    def run(self):
        build = os.environ.get("PHY_BUILD", str(root / "build/release"))
        if "PHY_BUILD" not in os.environ:
            subprocess.run(["cmake", "--preset", "release"], cwd=root, check=True)
        subprocess.run(["cmake", "--build", build, "--target", "phyllite_python"], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", os.path.abspath(self.build_lib)],
                       check=True)


setup(version=version(), packages=[], ext_modules=[Extension("phyllite._core", [])], cmdclass={"build_ext": BuildByCMake})

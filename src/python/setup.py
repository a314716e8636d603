"""Builds a wheel of the module from the sources: `pip install --no-build-isolation ./src/python`.

VIETE_KERNELS=native in the environment compiles for the current processor only, in half the time.
"""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = pathlib.Path(__file__).resolve().parent
top = here.parent.parent
project = re.search(r'project\((\w+) VERSION ([\d.]+).* DESCRIPTION "([^"]*)"', (top / "CMakeLists.txt").read_text())


class ByCMake(build_ext):
    def build_extension(self, extension):
        place = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        folder = pathlib.Path(self.build_temp).resolve()
        options = {"CMAKE_BUILD_TYPE": "Release", "VIETE_BUILD_TESTS": "OFF", "VIETE_BUILD_PYTHON": "ON",
                   "VIETE_KERNELS": os.environ.get("VIETE_KERNELS", "all"), "Python_EXECUTABLE": sys.executable}
        subprocess.run(["cmake", "-S", top, "-B", folder, "-G", "Ninja", *(f"-D{k}={v}" for k, v in options.items())], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "viete_python"], check=True)
        place.parent.mkdir(parents=True, exist_ok=True)
        built = next((folder / "python").glob("viete*.so"))
        subprocess.run(["strip", "--strip-unneeded", "-o", place, built], check=True)


setup(
    name=project[1],
    version=project[2],
    description=project[3],
    long_description=(here / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="MIT",
    python_requires=">=3.8",
    install_requires=["numpy"],
    ext_modules=[Extension("viete", [])],
    packages=["viete-stubs"],
    package_data={"viete-stubs": ["*.pyi"]},
    cmdclass={"build_ext": ByCMake},
)

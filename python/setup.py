"""The wheel: `pip wheel --no-build-isolation ./python`. The compiled module is the target glissade_python of CMake."""

import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent.parent


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        folder = ROOT / "build" / "wheel"
        options = ["-DGLISSADE_PYTHON=ON", "-DGLISSADE_BUILD_PROGRAM=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
        subprocess.run(["cmake", "--preset", "release", "-B", folder, *options], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "glissade_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(folder / "python" / "glissade" / target.name, target)
        subprocess.run(["strip", "--strip-unneeded", target], check=True)


setup(
    name="glissade",
    version=re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text().split("project(", 1)[1])[1],
    description="Exact collision of triangle soups, sliding contact, grasping hands, and forces for gloves",
    python_requires=">=3.9",
    install_requires=["numpy"],
    extras_require={"fleet": ["distributed"]},
    entry_points={"console_scripts": ["glissade-fleet = glissade.fleet:main"]},
    packages=["glissade"],
    package_data={"glissade": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("glissade._glissade", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)

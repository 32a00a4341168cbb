"""Builds the Python module with CMake. What it needs beside Python: the packages of scripts/install-packages.sh."""

import os
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """BOXWOOD_BUILD names a build directory that exists, to use what is compiled there already."""

    def build_extension(self, extension):
        built = os.environ.get("BOXWOOD_BUILD")
        folder = Path(built) if built else Path(self.build_temp).resolve()
        if not built:
            self.configure(folder)
        subprocess.run(["cmake", "--build", folder, "--target", "boxwood_python"], check=True)
        module = next((folder / "python" / "boxwood").glob("_core*.so"))
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(module), str(target))

    @staticmethod
    def configure(folder):
        options = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBOXWOOD_PYTHON=ON"]
        options += [f"-DBOXWOOD_{part}=OFF" for part in ("APPS", "TESTS", "EXAMPLES")]
        options.append(f"-DPYTHON_EXECUTABLE={sys.executable}")
        try:
            import pybind11

            options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass  # CMake looks for the system's
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, *options], check=True)


setup(
    packages=["boxwood"],
    package_dir={"": "python"},
    package_data={"boxwood": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("boxwood._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
)

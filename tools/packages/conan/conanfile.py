"""Untried. In this folder: conan create . --build=missing"""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Sightline(ConanFile):
    name = "sightline"
    version = "2.0.0"
    license = "MIT"
    description = "2D cell-and-portal visibility toolkit: the core library and the header for games"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "../../..")
        for pattern in ("CMakeLists.txt", "LICENSE", "lib/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in ("ANALYSIS", "IO", "STUDY", "GLPK", "DRAW", "TOOLS", "VIEWER", "PYTHON", "TESTS"):
            toolchain.variables[f"SIGHTLINE_{part}"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.libs = ["sightline"]
        if self.settings.os == "Linux":
            self.cpp_info.system_libs = ["m", "pthread"]

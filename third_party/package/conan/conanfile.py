"""viete::sym3 for Conan 2, built from this checkout."""
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Viete(ConanFile):
    name = "viete"
    version = "0.2.0"
    description = "Functions of symmetric 3x3 matrices, one or millions"
    license = "MIT"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"

    def requirements(self):
        self.requires("eigen/3.4.0", visible=False)
        self.requires("highway/1.0.7", visible=False)

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def export_sources(self):
        top = os.path.join(self.recipe_folder, "..", "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "src/*", "third_party/cmake/*"):
            copy(self, pattern, top, self.export_sources_folder)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for option in ("VIEWER", "TESTS", "PYTHON"):
            toolchain.variables["VIETE_BUILD_" + option] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "viete")
        self.cpp_info.set_property("cmake_target_name", "viete::sym3")
        self.cpp_info.libs = ["viete_sym3"]

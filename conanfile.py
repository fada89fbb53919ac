"""Conan 2 recipe of the libraries and the program.

UNTESTED: Lightproof is built and tested with Debian 12's packages (ci/packages.txt). Random123 and
KISS FFT come from the system; for the chart libraries of reports `npm ci` must have run in web/.
"""
from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.gnu import PkgConfigDeps


class Lightproof(ConanFile):
    name = "lightproof"
    version = "0.1.0"
    license = "Apache-2.0"
    description = "Statistical tests and benchmarks for image-based lighting"
    package_type = "static-library"
    settings = "os", "compiler", "build_type", "arch"
    exports_sources = (
        "CMakeLists.txt", "CMakePresets.json", "LICENSE", "cmake/*", "reference/*", "src/*", "web/*")

    def requirements(self):
        self.requires("boost/[>=1.74]", headers=True)
        self.requires("cli11/[>=2.2 <3]")
        self.requires("embree3/[>=3.13 <4]")
        self.requires("fmt/[>=9]", transitive_headers=True)
        self.requires("glm/[>=0.9.9]", transitive_headers=True)
        self.requires("highway/[>=1.0 <2]")
        self.requires("nlohmann_json/[>=3.11 <4]", transitive_headers=True)
        self.requires("onetbb/[>=2021.8]")
        self.requires("libjpeg-turbo/[>=2.1 <4]")
        self.requires("libpng/[>=1.6 <2]")
        self.requires("openexr/[>=3.1 <4]")
        self.requires("sqlite3/[>=3.40 <4]")
        self.requires("zlib/[>=1.2.11 <2]")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["LIGHTPROOF_TESTS"] = False
        toolchain.cache_variables["LIGHTPROOF_BENCH"] = False
        toolchain.generate()
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The package's own CMake files name the targets.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/lightproof"]

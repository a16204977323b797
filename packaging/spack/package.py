"""A recipe of spack. Not tried: see packaging/README.md."""

from spack.package import *


class Gearsweep(CMakePackage):
    """Massively parallel parameter sweeps of gear dynamics and non-smooth oscillators."""

    license("MIT")
    version("0.2.0")  # with the url and sha256 of the release's gearsweep-0.2.0.tar.gz

    variant("mpi", default=True, description="Spread a study over the processes of an MPI launcher")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("cli11")
    depends_on("cpp-httplib")
    depends_on("eigen@3.4:")
    depends_on("fftw@3:")
    depends_on("fmt@9:")
    depends_on("netcdf-c")
    depends_on("nlohmann-json")
    depends_on("opencl-clhpp")
    depends_on("opencl-icd-loader")
    depends_on("pocl", type="run")
    depends_on("pugixml")
    depends_on("sqlite@3:")
    depends_on("tomlplusplus")
    depends_on("mpi", when="+mpi")
    depends_on("gnuplot+cairo", type="run")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("GEARSWEEP_MPI", "mpi"),
            self.define("GEARSWEEP_TESTS", False),
            self.define("GEARSWEEP_BENCH", False),
            self.define("GEARSWEEP_PYTHON", False),
        ]

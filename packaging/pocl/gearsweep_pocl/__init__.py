"""PoCL, an OpenCL driver for x86-64 CPUs, where nobody can install one.

`offer()` names it to the OpenCL loader of this process and of those that it starts. gearsweep calls it.
"""

import hashlib
import os
import pathlib
from typing import List

_HERE = pathlib.Path(__file__).resolve().parent
_DRIVER = _HERE / "lib" / "driver" / "libpocl.so.2"
_MACHINES = pathlib.Path("/etc/OpenCL/vendors")


def _drivers_of(vendors: pathlib.Path) -> List[str]:
    """What the machine's .icd files say: a path or a name of a library each."""
    found = []
    for path in sorted(vendors.glob("*.icd")):
        try:
            found.append(path.read_text(errors="replace").strip())
        except OSError:
            continue  # the loader cannot read it either
    return [driver for driver in found if driver]


def _folder_of(drivers: List[str]) -> pathlib.Path:
    """A folder of .icd files, which is what the loader takes for several drivers; the same for the same ones."""
    cache = os.environ.get("XDG_CACHE_HOME") or ""
    if not os.path.isabs(cache):
        cache = pathlib.Path.home() / ".cache"
    name = hashlib.sha256("\n".join(drivers).encode()).hexdigest()[:16]
    folder = pathlib.Path(cache, "gearsweep-pocl", name)
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    about = folder.stat()
    if about.st_uid != os.getuid() or about.st_mode & 0o022:
        raise OSError(f"others may write into {folder}")  # and name what the loader runs
    for number, driver in enumerate(drivers):
        part = folder / f"{number}.{os.getpid()}"
        part.write_text(driver + "\n")
        part.replace(folder / f"{number}.icd")  # other processes see it whole
    return folder


def _vendors(others: List[str]) -> str:
    """What OCL_ICD_VENDORS takes: this driver, and the machine's own where a file can tell of them."""
    try:
        return str(_folder_of([*others, str(_DRIVER)]))
    except (OSError, RuntimeError):  # no folder to write in, or no home
        return str(_DRIVER)  # which Debian's loader takes, too


def offer(vendors: pathlib.Path = _MACHINES) -> bool:
    """Sets the environment by which OpenCL finds this driver beside the machine's own.

    It does nothing and returns False where the user has chosen drivers (OCL_ICD_VENDORS) or the machine has
    PoCL: two of one kind in a process would share names. Call it before OpenCL is asked for anything.
    """
    if os.environ.get("OCL_ICD_VENDORS") or os.environ.get("OPENCL_VENDOR_PATH"):
        return False
    others = _drivers_of(vendors)
    if conda := os.environ.get("CONDA_PREFIX"):
        others += _drivers_of(pathlib.Path(conda, "etc", "OpenCL", "vendors"))
    if any("pocl" in driver for driver in others):
        return False
    os.environ["OCL_ICD_VENDORS"] = _vendors(others)
    # Where the clang inside PoCL looks for `ld` first; bin/ld leaves all other links to the machine's.
    before = os.environ.get("COMPILER_PATH")
    os.environ["COMPILER_PATH"] = str(_HERE / "bin") + (os.pathsep + before if before else "")
    return True

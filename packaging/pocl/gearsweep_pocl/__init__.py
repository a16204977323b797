"""PoCL, an OpenCL driver for x86-64 CPUs, where nobody can install one.

`offer()` names it to the OpenCL loader of this process and of those that it starts. gearsweep calls it.
"""

import os
import pathlib
import tempfile
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


def _folder_of(drivers: List[str]) -> str:
    """A folder of .icd files, which is what the loader takes for several drivers; removed by nobody."""
    folder = tempfile.mkdtemp(prefix="gearsweep-drivers-")
    for number, driver in enumerate(drivers):
        pathlib.Path(folder, f"{number}.icd").write_text(driver + "\n")
    return folder


def offer(vendors: pathlib.Path = _MACHINES) -> bool:
    """Sets the environment by which OpenCL finds this driver beside the machine's own.

    It does nothing and returns False where the user has chosen drivers (OCL_ICD_VENDORS) or the machine has
    PoCL: two of one kind in a process would share names. Call it before OpenCL is asked for anything.
    """
    if os.environ.get("OCL_ICD_VENDORS") or os.environ.get("OPENCL_VENDOR_PATH"):
        return False
    others = _drivers_of(vendors)
    if any("pocl" in driver for driver in others):
        return False
    os.environ["OCL_ICD_VENDORS"] = _folder_of([*others, str(_DRIVER)]) if others else str(_DRIVER)
    # Where the clang inside PoCL looks for `ld` first; bin/ld leaves all other links to the machine's.
    before = os.environ.get("COMPILER_PATH")
    os.environ["COMPILER_PATH"] = str(_HERE / "bin") + (os.pathsep + before if before else "")
    return True

"""The OpenCL driver that users without root install beside the package: `pip install gearsweep[cpu]`."""


def offer() -> None:
    """Lets this process find it, before OpenCL is asked for anything."""
    try:
        import gearsweep_pocl
    except ImportError:
        return  # the machine's own drivers
    gearsweep_pocl.offer()

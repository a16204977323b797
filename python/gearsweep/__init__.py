"""Maps of gear dynamics and non-smooth oscillators from massively parallel parameter sweeps."""

from gearsweep import _core, _driver
from gearsweep._accessor import Gear
from gearsweep._curves import curves
from gearsweep._distribution import normal, triangular, uniform, values
from gearsweep._errors import InputError, RunError
from gearsweep._explore import Exploration, explore
from gearsweep._floquet import floquet
from gearsweep._model import (
    Channel,
    GearKey,
    Model,
    Option,
    Parameter,
    Preset,
    gear_keys,
    model,
    models,
)
from gearsweep._orders import orders
from gearsweep._progress import Progress
from gearsweep._run import Running, run, submit
from gearsweep._session import Device, devices
from gearsweep._study import Study
from gearsweep._study_source import studies
from gearsweep._tolerance import tolerance, tolerance_findings
from gearsweep._trace import trace
from gearsweep._verify import Check, Verification, verify

__version__: str = _core.version()
_driver.offer()

__all__ = [
    "Channel",
    "Check",
    "Device",
    "Exploration",
    "Gear",
    "GearKey",
    "InputError",
    "Model",
    "Option",
    "Parameter",
    "Preset",
    "Progress",
    "RunError",
    "Running",
    "Study",
    "Verification",
    "curves",
    "devices",
    "explore",
    "floquet",
    "gear_keys",
    "model",
    "models",
    "normal",
    "orders",
    "run",
    "studies",
    "submit",
    "tolerance",
    "tolerance_findings",
    "trace",
    "triangular",
    "uniform",
    "values",
    "verify",
]

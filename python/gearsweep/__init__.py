"""Maps of gear dynamics and non-smooth oscillators from massively parallel parameter sweeps."""

from gearsweep import _core
from gearsweep._accessor import Gear
from gearsweep._errors import InputError, RunError
from gearsweep._model import Channel, Model, Option, Parameter, Preset, model, models
from gearsweep._progress import Progress
from gearsweep._run import run
from gearsweep._session import Device, devices
from gearsweep._study import Study, studies

__version__: str = _core.version()

__all__ = [
    "Channel",
    "Device",
    "Gear",
    "InputError",
    "Model",
    "Option",
    "Parameter",
    "Preset",
    "Progress",
    "RunError",
    "Study",
    "devices",
    "model",
    "models",
    "run",
    "studies",
]

from typing import List

from ._core import Contact as Contact
from ._core import Fork as Fork
from ._core import InputError as InputError
from ._core import Motion as Motion
from ._core import Report as Report
from ._core import Scene as Scene
from ._core import SettingDescription as SettingDescription
from ._core import Settings as Settings
from ._core import Simulation as Simulation
from ._core import State as State
from ._core import integrators as integrators
from ._core import load_scene as load_scene
from ._core import pose as pose
from ._core import read_motion as read_motion
from ._core import setting_descriptions as setting_descriptions

def __dir__() -> List[str]: ...

__all__ = [
    "Contact",
    "Fork",
    "InputError",
    "Motion",
    "Report",
    "Scene",
    "SettingDescription",
    "Settings",
    "Simulation",
    "State",
    "integrators",
    "load_scene",
    "pose",
    "read_motion",
    "setting_descriptions",
]

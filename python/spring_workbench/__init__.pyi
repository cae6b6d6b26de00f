from typing import List

from ._core import AdvanceReport as AdvanceReport
from ._core import ChangeReport as ChangeReport
from ._core import ContactState as ContactState
from ._core import InputError as InputError
from ._core import Motion as Motion
from ._core import Scene as Scene
from ._core import SettingDescription as SettingDescription
from ._core import Simulation as Simulation
from ._core import SimulationSettings as SimulationSettings
from ._core import SimulationState as SimulationState
from ._core import ToolState as ToolState
from ._core import integrators as integrators
from ._core import load_scene as load_scene
from ._core import pose as pose
from ._core import read_motion as read_motion
from ._core import setting_descriptions as setting_descriptions

def __dir__() -> List[str]: ...

__all__ = [
    "AdvanceReport",
    "ChangeReport",
    "ContactState",
    "InputError",
    "Motion",
    "Scene",
    "SettingDescription",
    "Simulation",
    "SimulationSettings",
    "SimulationState",
    "ToolState",
    "integrators",
    "load_scene",
    "pose",
    "read_motion",
    "setting_descriptions",
]

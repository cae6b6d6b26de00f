"""Lift, carry and turn virtual objects with spring-based tools: the library of spring_workbench.

    import spring_workbench as sw

    simulation = sw.Simulation(sw.load_scene("box.urdf"), {"contact": "none"})
    simulation.push_motion(sw.read_motion("hand.tum"))
    simulation.advance_to(1.0)
    print(simulation.poses)

SI units, right-handed frames, z up. A pose is a 4 x 4 array that takes coordinates of its frame to world; a quaternion
is x y z w. Invalid input raises InputError, whose message names the field, what is allowed and what was given; the
call has then changed nothing, unless its docstring says otherwise.
"""

_NAMES = [
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
__all__ = _NAMES


def _with_fields(value):
    """The text of a state or report: its class and its fields, as of a dataclass."""
    fields = [name for name, member in vars(type(value)).items() if isinstance(member, property)]
    return f"{type(value).__name__}({', '.join(f'{name}={getattr(value, name)!r}' for name in fields)})"


def __getattr__(name):
    # Compiled code is loaded with its first use: programs that want only the ROS messages do not wait.
    if name not in _NAMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import _core

    for shown in ("AdvanceReport", "ChangeReport", "ContactState", "SettingDescription", "ToolState"):
        getattr(_core, shown).__repr__ = _with_fields
    globals().update({known: getattr(_core, known) for known in _NAMES})
    return globals()[name]


def __dir__():
    return sorted({*globals(), *_NAMES})

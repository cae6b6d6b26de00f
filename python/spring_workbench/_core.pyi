"""Compiled part of spring_workbench."""

from typing import Any, Dict, List, Literal, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

_Floats = npt.NDArray[np.float64]
_Bools = npt.NDArray[np.bool_]
_Tool = Literal["spring", "spring_fork", "spring_probe", "direct", "ray"]
_Axes = Literal["world", "tip"]
_DampingLaw = Literal["per_dof", "modal", "coefficients"]

class InputError(ValueError):
    """Invalid input. The message names the field, what is allowed and what was given; the state is unchanged."""

class SettingDescription:
    """Description of one setting."""
    @property
    def key(self) -> str:
        """Key of the setting, with dots."""
    @property
    def type(self) -> str:
        """Type of the value."""
    @property
    def unit(self) -> str:
        """SI unit of the value."""
    @property
    def allowed(self) -> str:
        """Values that are allowed."""
    @property
    def default(self) -> str:
        """Value if none is given."""
    @property
    def meaning(self) -> str:
        """What the setting does."""

class SimulationSettings:
    """Settings of a simulation by key, checked when they are set; setting_descriptions() explains them. They cannot be
    read back: keep the dictionary."""
    def __init__(self, values: Mapping[str, Any] = ...) -> None:
        """values: a dictionary, nested or with dotted keys, as in a settings file. Raises InputError for an unknown
        key, a wrong type or a value that is not allowed."""
    def update(self, values: Mapping[str, Any]) -> None:
        """Sets these values, all or none. Raises InputError as the constructor does."""

class Scene:
    """Bodies, materials and gravity of a scene, read from a URDF and the YAML file next to it."""
    @property
    def name(self) -> str:
        """Name of the scene: that of its URDF file, without .urdf."""
    @property
    def path(self) -> str:
        """Path of the URDF."""
    @property
    def gravity(self) -> float:
        """Gravity along -z of the world [m/s²]."""
    @property
    def contact(self) -> Literal["none", "stop", "dynamic"]:
        """Contact mode: none, stop or dynamic."""
    @property
    def tool(self) -> str:
        """Name of the tool with which each hand starts."""
    @property
    def masses(self) -> Dict[str, float]:
        """Mass of each movable object [kg], by name."""
    @property
    def warnings(self) -> List[str]:
        """Warnings about what was repaired on loading, one line each."""

class Motion:
    """Recorded motion of one hand."""
    def __len__(self) -> int:
        """Number of samples."""
    @property
    def times(self) -> _Floats:
        """Times of the samples since the first one [s]; shape (n,)."""
    @property
    def poses(self) -> _Floats:
        """Poses of the stylus; shape (n, 4, 4)."""
    @property
    def buttons(self) -> _Bools:
        """True for each sample at which the grasp button is down; shape (n,)."""

class ToolState:
    """State of the tool in one hand at one moment."""
    @property
    def present(self) -> bool:
        """True once a sample of this hand has arrived."""
    @property
    def tool(self) -> _Tool:
        """Name of the tool: spring_fork, spring, spring_probe, direct or ray."""
    @property
    def held_object(self) -> str:
        """Name of the held object; empty if nothing is held."""
    @property
    def touched(self) -> str:
        """Name of the body that the probe touches (`workbench`: the bench); empty if it touches none."""
    @property
    def shape(self) -> Literal["constant", "linear", "bushing"]:
        """Shape model of the fork: constant, linear or bushing."""
    @property
    def integrator(self) -> str:
        """Name of the integrator; see integrators()."""
    @property
    def length(self) -> float:
        """Rest length of the fork [m]."""
    @property
    def dofs(self) -> List[bool]:
        """True for each of stretch, bend and torsion that is on; a DOF that is off is rigid."""
    @property
    def stiffness(self) -> _Floats:
        """Stiffness of stretch, bend [N/m] and torsion [N m/rad]; shape (3,)."""
    @property
    def damping_ratio(self) -> _Floats:
        """Damping ratio of stretch, bend and torsion, in force with the laws per_dof and modal; shape (3,)."""
    @property
    def damping_coefficient(self) -> _Floats:
        """Damping coefficient of stretch, bend [N s/m] and torsion [N m s/rad], in force with the law coefficients;
        shape (3,)."""
    @property
    def damping_law(self) -> _DampingLaw:
        """Damping law: per_dof, modal or coefficients."""
    @property
    def strain(self) -> _Floats:
        """Strain coordinates of the shape model: bend and torsion [1/m], stretch [-]; for bushing displacements [m] and
        a rotation vector [rad]. Zero while nothing is held; shape (n,), n at most 6."""
    @property
    def stretch(self) -> float:
        """Extension along the fork [m]."""
    @property
    def bend(self) -> _Floats:
        """Deflection of the tip along x and y of the handle [m]; shape (2,)."""
    @property
    def torsion(self) -> float:
        """Twist angle [rad]."""
    @property
    def stylus_pose(self) -> _Floats:
        """Pose of the stylus in world; shape (4, 4)."""
    @property
    def handle_pose(self) -> _Floats:
        """Pose of the handle in world; shape (4, 4)."""
    @property
    def proxy_handle_pose(self) -> _Floats:
        """Pose of the proxy handle, from which the fork acts, in world; it lags behind `handle_pose` if the object
        cannot follow; shape (4, 4)."""
    @property
    def tip_pose(self) -> _Floats:
        """Pose of the tip in world; shape (4, 4)."""
    @property
    def tip_wrench(self) -> _Floats:
        """Force [N] and moment [N m] on the object at the tip, world axes; shape (6,)."""
    @property
    def handle_wrench(self) -> _Floats:
        """Force [N] and moment [N m] on the hand, in the handle's axes; shape (6,)."""
    @property
    def elastic_energy(self) -> float:
        """Energy stored in the fork [J]."""
    @property
    def kinetic_energy(self) -> float:
        """Kinetic energy of the held object [J]."""
    @property
    def error_bound(self) -> Optional[float]:
        """Estimate from above, not rigorous, of the error of integration in position since the grasp or the last step
        without one [m]; None if the setting `error_bound` is off or, e.g., in contact."""
    @property
    def weight(self) -> float:
        """Reading as a scale: upward force on the object divided by g, a mass [vkg: virtual kg]."""
    @property
    def torque(self) -> float:
        """Reading as a torque wrench: moment about the tool's axis at the tip [N m]."""
    @property
    def stretching_force(self) -> float:
        """Axial force at the handle, > 0 in tension [N] (the paper, section 4)."""
    @property
    def bending_force(self) -> float:
        """Transverse force at the handle [N]."""
    @property
    def force_angle(self) -> float:
        """Angle between the tool's axis and the force on it, 0 to pi [rad]."""
    @property
    def load(self) -> float:
        """Load as a fraction of the scene's range of loads, 0 to 1."""
    @property
    def clutch(self) -> bool:
        """True while the hand moves without the tool."""
    @property
    def material_stiffness(self) -> float:
        """Stiffness that the probe reads [N/m]; inf: rigid; 0: no reading."""
    @property
    def material_stiffness_uncertainty(self) -> float:
        """One standard deviation of `material_stiffness` [N/m]."""

class ContactState:
    """Contact point between an object and another body, in world axes."""
    @property
    def object(self) -> str:
        """Name of the object."""
    @property
    def other(self) -> str:
        """Name of the other body, or `workbench`."""
    @property
    def point(self) -> _Floats:
        """Position of the contact point in the world [m]; shape (3,)."""
    @property
    def normal(self) -> _Floats:
        """Unit vector towards `object`; shape (3,)."""
    @property
    def depth(self) -> float:
        """Penetration along the normal [m]."""
    @property
    def impulse(self) -> float:
        """Normal impulse in the last step [N s]."""
    @property
    def force(self) -> float:
        """Mean normal force in the last step [N]."""
    @property
    def slip_speed(self) -> float:
        """Speed of the object along the surface [m/s]."""
    @property
    def phase(self) -> Literal["started", "persisting", "ended"]:
        """Phase of the contact: started, persisting or ended."""

class AdvanceReport:
    """Report of one call of `advance_to`. Error bounds are empirical estimates from above, not rigorous (doc/model.md).
    An integration is one solution of the equation of motion over a step or a part of one: in contact there are several
    in a step."""
    @property
    def steps(self) -> int:
        """Number of steps taken."""
    @property
    def substeps(self) -> int:
        """Number of steps that were discarded and repeated as shorter ones, since the equation was not solved or the
        error too large (other engines call a part of a step that is taken a substep)."""
    @property
    def simulated_time(self) -> float:
        """Time simulated by this call [s]."""
    @property
    def position_error(self) -> float:
        """Largest estimate of a step's local error [m]."""
    @property
    def angle_error(self) -> float:
        """Largest estimate of a step's local error in the angle [rad]."""
    @property
    def local_error_bound(self) -> Optional[float]:
        """Largest bound of a step's local error in position [m]; None if no step has one."""
    @property
    def error_bound(self) -> Optional[float]:
        """Largest bound of an object's error in position since its grasp, or since its last step without a bound [m];
        None if no step has one, e.g. without the setting `error_bound`."""
    @property
    def angle_error_bound(self) -> Optional[float]:
        """Largest bound of an object's error in angle since its grasp, or since its last step without a bound [rad];
        None if no step has one."""
    @property
    def integrations_without_bound(self) -> int:
        """Number of integrations without an error bound: all, unless the setting `error_bound` is on."""
    @property
    def energy_balance(self) -> float:
        """Energy of the held object and the fork beyond the work of hand, gravity, damping and contact [J]; meaningful
        if stiffest_omega_dt is below about 1."""
    @property
    def energy_error(self) -> float:
        """Sum of the steps' estimated errors in energy [J]."""
    @property
    def stiffest_omega_dt(self) -> float:
        """Largest product of the stiffest mode's angular frequency and the step."""
    @property
    def collision_queries(self) -> int:
        """Number of queries to the collision library."""
    @property
    def stops(self) -> int:
        """Number of steps in which the fork reached the end of its range (fully compressed or wound up); unrelated to
        the contact mode stop."""
    @property
    def steps_fallback(self) -> int:
        """Number of integrations by an L-stable rule, since the integrator's own equation was not solved."""
    @property
    def steps_blocked(self) -> int:
        """Number of steps in which no admissible motion of an object was found, so that it stayed in place."""
    @property
    def steps_unsolved(self) -> int:
        """Number of steps, or parts of one, that were accepted although a contact among movable objects was left with a
        residual above 1 µm, was deeper than 0.1 mm, or was lost."""
    @property
    def time_lost(self) -> float:
        """Time during which an object did not follow its equation of motion [s]."""
    @property
    def steps_rejected(self) -> int:
        """Number of steps without a usable result (non-finite or out of range): the fork is rigid for that step or, in
        contact, the object stays."""
    @property
    def active(self) -> List[str]:
        """Names of the subsystems that ran."""
    @property
    def skipped(self) -> List[str]:
        """Names of the subsystems that were not needed."""

class ChangeReport:
    """Report of a change while running."""
    @property
    def elastic_energy_before(self) -> float:
        """Energy stored in all tools just before the change [J]."""
    @property
    def elastic_energy_after(self) -> float:
        """Energy stored in all tools just after the change [J]."""
    @property
    def energy_added(self) -> float:
        """What the change adds to `Simulation.energy` [J]."""
    @property
    def message(self) -> str:
        """What was changed, in one line."""

class SimulationState:
    """Saved state of a whole simulation, from Simulation.save(). It can be compared and pickled."""
    @property
    def hash(self) -> str:
        """Hash of the state, 16 hexadecimal digits: equal states have equal hashes on every machine."""
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Simulation:
    """Simulation of a scene with hands and their tools.

        simulation = Simulation(load_scene("box.urdf"))
        for t in (0.0, 0.5, 1.0):  # the hand moves up; the fork points down, into the box
            simulation.push_stylus(t, pose([0.0, 0.0, 0.24 + 0.1 * t], [1.0, 0.0, 0.0, 0.0]))
        simulation.push_button(0.0, True)
        simulation.advance_to(1.0)
        print(simulation.poses[0][:3, 3])

    It reads no clock and starts no thread; the same calls give bit-identical results. Not thread-safe; a copy is a new
    Simulation that restores a saved state. `hand` is 0 for the first stylus (nodes count styluses from 1), at most the
    setting `styluses` - 1; another raises InputError, a negative one TypeError. Arrays are copies."""
    def __init__(self, scene: Scene, settings: Union[SimulationSettings, Dict[str, Any]] = ...) -> None:
        """Starts a simulation of `scene`. settings: SimulationSettings or the dictionary for it. Raises InputError if a
        setting is not allowed or does not match the scene."""
    def push_stylus(self, t: float, pose: npt.ArrayLike, hand: int = 0) -> bool:
        """Adds a pose of the stylus, shape (4, 4), at time t [s]; its z axis is that of the fork, from the hand to the
        tip. Returns False if t is not later than the time of the newest pose. Raises InputError if the pose is
        invalid."""
    def push_button(self, t: float, pressed: bool, hand: int = 0) -> None:
        """Presses (True) or releases (False) the grasp button at time t [s]. Raises InputError if t is not finite."""
    def push_next_tool(self, t: float, hand: int = 0) -> None:
        """Selects the next tool at time t [s] or, while something is held, the next tool that can hold it. Raises
        InputError if t is not finite."""
    def push_clutch(self, t: float, on: bool, hand: int = 0) -> None:
        """Switches the clutch at time t [s]: while it is on, the tool and what it holds stay in place and the hand
        moves alone; once it is off, they follow its further motion. Raises InputError if t is not finite."""
    def push_external_wrench(self, t: float, wrench: npt.ArrayLike, axes: _Axes = "world", hand: int = 0) -> None:
        """Adds a force [N] and a moment [N m] on the held object at the tip, shape (6,), measured at time t [s].

        axes: world, or tip (the axes turn with it). It is in real units: multiplied by the scene's force_scale, it acts
        until the next one, at most for external_wrench_timeout. Raises InputError if a value is not allowed."""
    def push_motion(self, motion: Motion, hand: int = 0) -> int:
        """Adds the samples and button edges of a recorded motion; returns the number of samples that were added.

        As push_stylus, it ignores each pose whose time is not later than that of the newest one. Raises InputError if a
        pose is invalid."""
    def advance_to(self, t_end: float) -> AdvanceReport:
        """Simulates up to time t_end [s], in steps that also end at the samples. Returns an AdvanceReport.

        If t_end is not later than `time`, no time passes; buttons that were pushed for times up to `time` still act.
        Raises InputError if t_end is not finite."""
    @property
    def time(self) -> float:
        """Simulated time [s]."""
    @property
    def newest_sample_time(self) -> float:
        """Time of the newest sample of any hand, or `time` if there is none [s]."""
    @property
    def names(self) -> List[str]:
        """Names of the movable objects, in the order of all arrays."""
    @property
    def poses(self) -> _Floats:
        """Poses of the objects at their centres of mass; shape (n, 4, 4)."""
    @property
    def twists(self) -> _Floats:
        """Velocity [m/s] and angular velocity [rad/s], world; shape (n, 6)."""
    @property
    def held(self) -> _Bools:
        """True for each object that a hand holds; shape (n,)."""
    @property
    def in_contact(self) -> _Bools:
        """True for each object that touches another body or the bench; shape (n,)."""
    @property
    def asleep(self) -> _Bools:
        """True for each object that is asleep: at rest, and not simulated until something moves it; shape (n,)."""
    @property
    def contacts(self) -> List[ContactState]:
        """Current contacts, and those that ended in the last call of `advance_to`: a list of ContactState."""
    def tool(self, hand: int = 0) -> ToolState:
        """Returns the state of the tool in a hand."""
    @property
    def elastic_energy(self) -> float:
        """Energy stored in all tools [J]."""
    @property
    def energy(self) -> float:
        """Energy of tools and objects: elastic, kinetic, and potential (zero at z = 0) [J]; without what is stored in
        compliant materials."""
    def save(self) -> SimulationState:
        """Returns the whole state."""
    def restore(self, state: SimulationState) -> None:
        """Restores a state saved by a simulation with the same scene and settings, which then continues
        bit-identically. Raises InputError, and changes nothing, if bodies, contact mode, number of styluses or shape of
        the fork differ; other settings are not compared."""
    @property
    def state_hash(self) -> str:
        """Hash of the whole state: 16 hexadecimal digits."""
    def select_tool(self, tool: _Tool, hand: Optional[int] = None) -> ChangeReport:
        """Changes the tool in a hand, or with None in each, to spring, spring_fork, spring_probe, direct or ray. What
        it holds stays in hand, except with spring_probe."""
    def change(
        self,
        *,
        stiffness: Optional[Sequence[Optional[float]]] = None,
        damping_ratio: Optional[Sequence[Optional[float]]] = None,
        dofs: Optional[Sequence[Optional[bool]]] = None,
        integrator: Optional[str] = None,
        step: Optional[float] = None,
        tolerance: Optional[float] = None,
        damping_coefficient: Optional[Sequence[Optional[float]]] = None,
        damping_law: Optional[_DampingLaw] = None,
        damping: Optional[Sequence[Optional[float]]] = None,
        hand: Optional[int] = None,
    ) -> ChangeReport:
        """Changes the fork of a hand, or with None every fork, and the integration, all or nothing; what is None stays
        as it is.

        stiffness: of stretch, bend [N/m] and torsion [N m/rad], each a number or None; damping_ratio: of the same
        three, 0 to 10; damping_coefficient: of the same three [N s/m, N s/m, N m s/rad]; damping_law: per_dof, modal or
        coefficients; damping: ratios or coefficients, whichever that law or, without one, the fork's present law uses
        (three different ratios turn the present law modal into per_dof); dofs: True for each of the three that is on;
        integrator, of all hands: see integrators(); step [s]; tolerance [m], 0 for fixed steps. Raises InputError if a
        value is not allowed."""
    def calibrate(self, hand: Optional[int] = None) -> ChangeReport:
        """Fits the tool of a hand, or with None of each, to the object that it holds or, with calibrate: world,
        restores the scene's stiffness. Raises InputError if nothing is held by a fork or a spring."""
    def release(self, hand: Optional[int] = None) -> bool:
        """Releases the object of a hand, or with None those of all hands. Returns False if nothing was held."""
    def place(self, poses: Mapping[str, npt.ArrayLike]) -> None:
        """Releases all objects and places those named in `poses` (name: pose, shape (4, 4)), at rest.

        Raises InputError, and changes nothing, if a name is not that of a movable object or a pose is invalid."""
    def edit(
        self,
        action: Literal["add", "move", "remove", "mass", "friction"],
        name: str,
        urdf: str = ...,
        pose: Optional[npt.ArrayLike] = None,
        mass: Optional[float] = None,
        friction: Optional[float] = None,
    ) -> ChangeReport:
        """Changes the object `name`, all or nothing; everything else continues from where it is.

        action: add (needs urdf; at pose or, without one, on the bench), move (needs pose), remove, mass (to mass [kg];
        0: massless) or friction (to friction). pose: of its URDF link frame in world, shape (4, 4). Raises InputError
        if the object or a value is not allowed."""

    def reset(self) -> None:
        """Returns all objects to their initial poses; nothing is held, and all samples are forgotten."""

def load_scene(path: str, roots: Sequence[str] = ...) -> Scene:
    """Reads a scene from a URDF (a path or package:// URI), with the YAML file of the same name next to it.

    roots: folders; if any are given, all files that the scene names must lie below one of them or in a ROS package.
    Raises InputError if a file cannot be read or is not valid."""
def read_motion(path: str) -> Motion:
    """Reads a recording (lines of `t x y z qx qy qz qw [button]`), or a script of waypoints (*.yaml).

    Raises InputError, with file and line, if it cannot be read or is not valid."""
def pose(position: Sequence[float], quaternion: Sequence[float] = ...) -> _Floats:
    """Returns a pose as an array of shape (4, 4).

    position: x, y, z [m]; quaternion: x, y, z, w, normalised here. Raises InputError if one has the wrong length or is
    not finite, or if the quaternion is zero."""
def integrators() -> List[str]:
    """Returns the names that the setting `integrator` accepts."""
def setting_descriptions() -> List[SettingDescription]:
    """Returns the descriptions of all settings."""

"""Compiled part of spring_workbench."""

from typing import Any, Dict, List, Literal, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

_Floats = npt.NDArray[np.float64]
_Bools = npt.NDArray[np.bool_]
_Tool = Literal["spring", "spring_fork", "spring_probe", "direct", "ray"]
_Axes = Literal["world", "tip"]
_DampingLaw = Literal["per_dof", "modal", "coefficients"]

class InputError(ValueError):
    """Invalid input, in one line. For an invalid value it names the field, the value and the allowed values. A call that
    raises it changes nothing, unless it says otherwise."""

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
        """Default value, as text."""
    @property
    def meaning(self) -> str:
        """Effect of the setting, in one line."""

class SimulationSettings:
    """Settings of a simulation by key. Each value is checked when it is set; combinations are checked by Simulation.
    setting_descriptions() explains each key. Settings cannot be read back: keep the dictionary."""
    def __init__(self, values: Dict[str, Any] = ...) -> None:
        """values: a dictionary, nested or with dotted keys, as in a settings file. Raises InputError for an unknown
        key, a wrong type or a value that is not allowed."""
    def update(self, values: Dict[str, Any]) -> None:
        """Sets these values, all or none. Raises InputError as the constructor does."""

class Scene:
    """Bodies, materials and gravity of a scene, read from a URDF and the YAML file next to it."""
    @property
    def name(self) -> str:
        """Name of the scene: the name of its URDF file without .urdf."""
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
    def tool(self) -> _Tool:
        """Name of the tool with which each hand starts."""
    @property
    def masses(self) -> Dict[str, float]:
        """Mass of each movable object [kg], by name."""
    @property
    def warnings(self) -> List[str]:
        """Repairs that were made on loading, one line each."""

class Motion:
    """Recorded motion of one hand, from read_motion()."""
    def __len__(self) -> int:
        """Number of samples."""
    @property
    def times(self) -> _Floats:
        """Times of the samples since the first one [s]; shape (n,)."""
    @property
    def poses(self) -> _Floats:
        """Poses of the stylus in the frame of the file, which is world for push_motion(), positions in m; shape
        (n, 4, 4)."""
    @property
    def buttons(self) -> _Bools:
        """True for each sample at which the grasp button is down; shape (n,)."""

class ToolState:
    """State of the tool in one hand at one moment. A pose is a 4 x 4 array that takes coordinates of its frame to
    world, positions in m."""
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
        """True for each DOF of stretch, bend and torsion that is on. The fork is rigid in a DOF that is off."""
    @property
    def stiffness(self) -> _Floats:
        """Stiffness of stretch, bend [N/m] and torsion [N m/rad]; shape (3,)."""
    @property
    def damping_ratio(self) -> _Floats:
        """Damping ratio of stretch, bend and torsion, used by the laws per_dof and modal; shape (3,)."""
    @property
    def damping_coefficient(self) -> _Floats:
        """Damping coefficient of stretch, bend [N s/m] and torsion [N m s/rad], used by the law coefficients; shape
        (3,)."""
    @property
    def damping_law(self) -> _DampingLaw:
        """Damping law in force: per_dof, modal or coefficients."""
    @property
    def strain(self) -> _Floats:
        """Strain coordinates of the shape model: bend and torsion [1/m], stretch [-]. The coordinates of bushing are
        displacements [m] and a rotation vector [rad]. Zero while nothing is held; shape (n,), n at most 6."""
    @property
    def stretch(self) -> float:
        """Extension along the fork [m]."""
    @property
    def bend(self) -> _Floats:
        """Deflection of the tip along x and y of the handle [m]; shape (2,)."""
    @property
    def torsion(self) -> float:
        """Angle of torsion about the fork [rad]."""
    @property
    def stylus_pose(self) -> _Floats:
        """Pose of the stylus in world; shape (4, 4)."""
    @property
    def handle_pose(self) -> _Floats:
        """Pose of the handle in world; shape (4, 4)."""
    @property
    def proxy_handle_pose(self) -> _Floats:
        """Pose of the proxy handle in world, from which the fork acts. It stays behind `handle_pose` if the object
        cannot follow; shape (4, 4)."""
    @property
    def tip_pose(self) -> _Floats:
        """Pose of the tip in world; shape (4, 4)."""
    @property
    def tip_wrench(self) -> _Floats:
        """Force [N] on the object and its moment [N m] about the tip, world axes; shape (6,)."""
    @property
    def handle_wrench(self) -> _Floats:
        """Force [N] on the hand and its moment [N m] about the handle's origin, axes of the handle; shape (6,)."""
    @property
    def elastic_energy(self) -> float:
        """Energy stored in the tool [J]."""
    @property
    def kinetic_energy(self) -> float:
        """Kinetic energy of the held object, in world [J]."""
    @property
    def error_bound(self) -> Optional[float]:
        """Bound of the error of integration in position [m], accumulated since the grasp or since the last step without
        a bound. It is an upper estimate, not rigorous. None in contact, or if the setting `error_bound` is off."""
    @property
    def weight(self) -> float:
        """Reading as a scale [vkg: virtual kg]: upward force on the object divided by g."""
    @property
    def torque(self) -> float:
        """Reading as a torque wrench [N m]: moment about the tool's axis at the tip."""
    @property
    def stretching_force(self) -> float:
        """Axial force at the handle, > 0 in tension [N] (the paper, section 4)."""
    @property
    def bending_force(self) -> float:
        """Transverse force at the handle [N] (the paper, section 4)."""
    @property
    def force_angle(self) -> float:
        """Angle between the tool's axis and the force on it, 0 to pi [rad] (the paper, section 4)."""
    @property
    def load(self) -> float:
        """The larger of the tip's force and its moment over the length, relative to the weight of the heaviest object or
        of calibration.world.heaviest, 0 to 1; logarithmic if weights span more than a decade."""
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
    """One contact point of an object with another body."""
    @property
    def object(self) -> str:
        """Name of the object."""
    @property
    def other(self) -> str:
        """Name of the other body; `workbench` is the bench."""
    @property
    def point(self) -> _Floats:
        """Position of the contact point in the world [m]; shape (3,)."""
    @property
    def normal(self) -> _Floats:
        """Unit normal of the surface, towards `object`, world axes; shape (3,)."""
    @property
    def depth(self) -> float:
        """Depth of penetration along the normal [m]."""
    @property
    def impulse(self) -> float:
        """Normal impulse in the last step [N s]."""
    @property
    def force(self) -> float:
        """This point's share of the normal force between the two bodies, as a mean over the last 20 ms [N]. Once the
        contact has ended, the force is the share in its last step."""
    @property
    def slip_speed(self) -> float:
        """Speed of the object along the other body's surface [m/s]."""
    @property
    def phase(self) -> Literal["started", "persisting", "ended"]:
        """Phase in the last call of `advance_to`: started, persisting or ended."""

class AdvanceReport:
    """Report on one call of `advance_to`.

    A step is discarded and repeated as shorter ones if its equation is not solved or its error is too large: that in
    position if there is a tolerance, otherwise that in energy; `substeps` counts the discarded attempts. If that does
    not help, or the integrator is unstable at high stiffness, an L-stable rule takes the step (`steps_fallback`). If
    that fails, too, the fork is rigid for the step or, in contact, the object stays in place (`steps_rejected`). If
    these three counters, `stops`, `steps_blocked`, `steps_unsolved` and `time_lost` are 0, nothing unusual happened. In
    contact a step may take several integrations.

    An error is the result minus the exact solution of the equation of motion. An error bound is an empirical upper
    estimate, not a rigorous bound (doc/model.md, "Error bound"). The counters wrench_timeouts and
    steps_among_movable are in C++ only."""
    @property
    def steps(self) -> int:
        """Number of steps taken."""
    @property
    def substeps(self) -> int:
        """Number of attempts at a step that were discarded and repeated as shorter steps."""
    @property
    def simulated_time(self) -> float:
        """Time simulated by this call [s]."""
    @property
    def position_error(self) -> float:
        """Largest estimate of a step's local error in position [m]."""
    @property
    def angle_error(self) -> float:
        """Largest estimate of a step's local error in angle [rad]."""
    @property
    def local_error_bound(self) -> Optional[float]:
        """Largest bound of a step's local error in position [m]; None if no step has one."""
    @property
    def error_bound(self) -> Optional[float]:
        """Largest bound of an object's error in position [m], accumulated since its grasp or since its last step
        without a bound. None if no step has a bound, e.g. because the setting `error_bound` is off."""
    @property
    def angle_error_bound(self) -> Optional[float]:
        """Largest bound of an object's error in angle [rad], accumulated like `error_bound`. None if no step has a
        bound."""
    @property
    def integrations_without_bound(self) -> int:
        """Number of integrations without an error bound. If the setting `error_bound` is off, no integration has
        one."""
    @property
    def energy_balance(self) -> float:
        """Energy created (> 0) or lost (< 0) by the integration itself [J]: the change in the energy of object and fork
        less the work of hand, gravity, damping and contact. Meaningful if `stiffest_omega_dt` is below about 1."""
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
        """Number of steps in which the fork reached the end of its range: fully compressed or wound up, or half a
        turn of a bushing. Unrelated to the contact mode stop."""
    @property
    def steps_fallback(self) -> int:
        """Number of integrations by the L-stable rule, in place of the integrator."""
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
        """Number of steps without a usable result (non-finite or out of range)."""
    @property
    def active(self) -> List[str]:
        """Names of the subsystems that ran."""
    @property
    def skipped(self) -> List[str]:
        """Names of the subsystems that the scene did not need."""

class ChangeReport:
    """Report on a change to a running simulation: its effect on the energy."""
    @property
    def elastic_energy_before(self) -> float:
        """Energy stored in all tools just before the change [J]."""
    @property
    def elastic_energy_after(self) -> float:
        """Energy stored in all tools just after the change [J]."""
    @property
    def energy_added(self) -> float:
        """Increase of `Simulation.energy` by the change [J]."""
    @property
    def message(self) -> str:
        """Description of the change for the user, in one line."""

class SimulationState:
    """Saved state of a whole simulation, from Simulation.save(). States can be compared and pickled."""
    @property
    def hash(self) -> str:
        """Hash of the state as 16 hexadecimal digits (in C++ it is the same number as an integer). Equal states have
        equal hashes on every machine."""
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

    - Hands: `hand` is 0 for the first stylus (nodes count styluses from 1), at most the setting `styluses` - 1. Another
      number raises InputError, and a negative one TypeError. To hold an object without a button, use the setting
      `grasp.object`. To begin without a hand, place() objects in the air and call advance_to().
    - Order: before you advance to a time, push everything that happens up to it. Poses, buttons and wrenches may come
      in any order relative to each other, but the poses of one hand, and its wrenches, in the order of their times.
    - Time: a simulation reads no clock and starts no thread. The same sequence of calls gives bit-identical results
      on processors of the same kind (with AVX and FMA, or without). No result is ever NaN.
    - Copies: arrays are copies. To copy a simulation, restore its saved state in a new one of the same scene and
      settings. A simulation is not thread-safe."""
    def __init__(self, scene: Scene, settings: Union[SimulationSettings, Dict[str, Any]] = ...) -> None:
        """Starts a simulation of `scene`. settings: SimulationSettings, or the dictionary for it. Raises InputError if
        a setting is not allowed or does not match the scene."""
    def push_stylus(self, t: float, pose: npt.ArrayLike, hand: int = 0) -> bool:
        """Adds a pose of the stylus in world, shape (4, 4) [m], at time t [s]. Its z axis points along the fork, from
        the hand to the tip.

        The hand moves smoothly between poses and rests after the last one. If the gap between two poses is longer than
        the setting `dropout_after` (0.5 s), the hand stays at the first until the time of the second, and then jumps to
        it. Returns False, and ignores the pose, if t is not later than the time of the newest one. Raises InputError if
        the pose is invalid."""
    def push_button(self, t: float, pressed: bool, hand: int = 0) -> None:
        """Presses (True) or releases (False) the grasp button at time t [s]. Raises InputError if t is not finite."""
    def push_next_tool(self, t: float, hand: int = 0) -> None:
        """Selects the next tool at time t [s] or, while something is held, the next tool that can hold it. Raises
        InputError if t is not finite."""
    def push_clutch(self, t: float, on: bool, hand: int = 0) -> None:
        """Switches the clutch at time t [s]. While it is on, the tool and its object stay in place and the hand moves
        alone. Once it is off, they follow the hand's further motion from there. Raises InputError if t is not
        finite."""
    def push_external_wrench(self, t: float, wrench: npt.ArrayLike, axes: _Axes = "world", hand: int = 0) -> None:
        """Adds a force [N] and a moment [N m] on the held object at the tip, shape (6,), measured at time t [s].

        axes: world, or tip (the axes turn with the tip). The wrench is in real units: it is multiplied by the scene's
        force_scale. It acts until the next wrench, but at most for the setting `external_wrench_timeout`. It replaces
        pending wrenches of its own or a later time. Raises InputError if a value is not allowed."""
    def push_motion(self, motion: Motion, hand: int = 0) -> int:
        """Adds the samples and button edges of a recorded motion. Returns the number of samples that were added.

        Like push_stylus, it ignores each pose whose time is not later than the time of the newest one. Raises
        InputError if a pose is invalid; the samples before it are then added."""
    def advance_to(self, t_end: float, pause_at: float = ...) -> AdvanceReport:
        """Simulates up to time t_end [s], in steps that also end at the samples. Returns an AdvanceReport.

        Stops after the step that reaches `pause_at` [s]; a further call with the same t_end continues, and
        together they take the same steps as one call without a pause.

        If t_end is not later than `time`, no time passes, but buttons that were pushed for times up to `time` still
        act. Raises InputError if t_end is not finite."""
    @property
    def time(self) -> float:
        """Simulated time [s]. It begins at the time of the first sample, or at the first t_end of advance_to() if
        earlier."""
    @property
    def newest_sample_time(self) -> float:
        """Time of the newest sample of any hand, or `time` if there is none [s]."""
    @property
    def names(self) -> List[str]:
        """Names of the movable objects, in the order of all arrays."""
    @property
    def poses(self) -> _Floats:
        """Poses of the objects in world, at their centres of mass, positions in m; shape (n, 4, 4)."""
    @property
    def twists(self) -> _Floats:
        """Velocity [m/s] of each object's centre of mass and angular velocity [rad/s], world axes; shape (n, 6)."""
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
        """The present contacts, and the contacts that ended in the last call of `advance_to`: a list of
        ContactState."""
    def tool(self, hand: int = 0) -> ToolState:
        """Returns the state of the tool in a hand."""
    @property
    def elastic_energy(self) -> float:
        """Energy stored in all tools [J]."""
    @property
    def energy(self) -> float:
        """Energy of tools and objects [J]: elastic, kinetic, and potential (zero at z = 0). It excludes the energy
        stored in compliant materials."""
    def save(self) -> SimulationState:
        """Returns the whole state, from which restore() continues bit-identically."""
    def restore(self, state: SimulationState) -> None:
        """Restores a state that a simulation with the same scene and settings saved. The future is then bit-identical.
        Raises InputError, and changes nothing, if bodies, contact mode, number of styluses or shape of the fork differ.
        Other settings are not compared."""
    @property
    def state_hash(self) -> str:
        """Hash of the whole state: 16 hexadecimal digits."""
    def select_tool(self, tool: _Tool, hand: Optional[int] = None) -> ChangeReport:
        """Changes the tool in a hand or, with None, in every hand: spring, spring_fork, spring_probe, direct or ray.
        The hand keeps its object. The probe cannot hold an object, so a change to spring_probe releases it."""
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
        """Changes the fork of a hand or, with None, of every hand, and the integration of all hands. It changes all or
        nothing. Values that are None are not changed. A value per DOF is a list of three, for stretch, bend and
        torsion.

        - stiffness: per DOF [N/m, N/m, N m/rad].
        - damping_ratio: per DOF, 0 to 10; 1 is critical.
        - damping_coefficient: per DOF [N s/m, N s/m, N m s/rad].
        - damping_law: per_dof, modal or coefficients.
        - damping: per DOF, coefficients with the law coefficients and ratios with the others. Ratios that are not all equal
          change the law modal to per_dof, unless damping_law asks for modal.
        - dofs: per DOF, True if it is on and False if it is rigid.
        - integrator: a name from integrators().
        - step: largest step [s].
        - tolerance: allowed error of the whole run [m]; 0 for fixed steps.

        Raises InputError if a value is not allowed."""
    def calibrate(self, hand: Optional[int] = None) -> ChangeReport:
        """Calibrates the tool of a hand or, with None, of every hand to the object that it holds. With the setting
        `calibrate: world` it restores the scene's stiffness instead. Raises InputError if no fork or spring holds an
        object."""
    def release(self, hand: Optional[int] = None) -> bool:
        """Releases the object of a hand or, with None, of every hand. Returns False if nothing was held."""
    def place(self, poses: Dict[str, npt.ArrayLike]) -> None:
        """Releases all objects and places the named ones at rest. poses: from the name of an object to its pose, shape
        (4, 4). Unsupported objects then fall.

        Raises InputError, and changes nothing, if no movable object has such a name or a pose is invalid."""
    def edit(
        self,
        action: Literal["add", "move", "remove", "mass", "friction"],
        name: str,
        urdf: str = ...,
        pose: Optional[npt.ArrayLike] = None,
        mass: Optional[float] = None,
        friction: Optional[float] = None,
    ) -> ChangeReport:
        """Changes the object `name`, all or nothing. Everything else continues as it is.

        - action add: adds the object of the file `urdf` (a path or package:// URI), at `pose` or, without one, on the
          bench.
        - action move: moves the object to `pose`.
        - action remove: removes the object.
        - action mass: sets the mass to `mass` [kg]; 0 makes the object massless.
        - action friction: sets the Coulomb coefficient to `friction`.

        pose: pose of the object's URDF link frame in world, shape (4, 4). Raises InputError if the object or a value is
        not allowed."""

    def reset(self) -> None:
        """Releases all objects, returns them to their start poses and forgets all samples. Time starts again."""

def load_scene(path: str, roots: Sequence[str] = ...) -> Scene:
    """Reads a scene from a URDF (a path or package:// URI) and from the YAML file of the same name next to it, if there
    is one.

    roots: folders. If any are given, all files that the scene names must be in one of them or in a ROS package. Raises
    InputError if a file cannot be read or is not valid."""
def read_motion(path: str) -> Motion:
    """Reads a recording (lines of `t x y z qx qy qz qw [button]` in s and m) or a script of waypoints (*.yaml, *.yml).

    Raises InputError, with file and line, if the file cannot be read or is not valid."""
def pose(position: Sequence[float], quaternion: Sequence[float] = ...) -> _Floats:
    """Returns a pose as an array of shape (4, 4).

    position: x, y, z [m]. quaternion: x, y, z, w; it is normalised here. Raises InputError if one of them has the wrong
    length or is not finite, or if the quaternion is zero."""
def integrators() -> List[str]:
    """Returns the names that the setting `integrator` accepts."""
def setting_descriptions() -> List[SettingDescription]:
    """Returns the descriptions of all settings."""

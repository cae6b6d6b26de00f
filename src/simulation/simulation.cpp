#include "spring_workbench/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "constants.h"
#include "hand.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/instruments/tip_wrench.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/scene/editing.h"
#include "spring_workbench/tools/calibration.h"
#include "spring_workbench/tools/sharing.h"
#include "spring_workbench/validation/element.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::simulation {
namespace {

constexpr double same_time = motion::Stylus::same_time;

using Action = ObjectEdit::Action;

/// Applies an edit to the scene. Throws InputError if it does not match the scene.
void make_edit(const ObjectEdit& edit, const std::vector<std::string>& roots, bool massless, scene::Scene& scene) {
  validate(edit);
  if (edit.action == Action::add) {
    scene.bodies.push_back(scene::read_object(edit.name, edit.urdf, edit.X_WL, scene, roots, ""));
    if (!scene.bodies.back().movable) validation::refuse("", "urdf", edit.urdf, "an object whose root has mass");
    if (massless) scene::set_mass(scene.bodies.back(), 0.0, "");
    return;
  }
  const std::size_t index = scene::movable_body(scene, edit.name, "", "name");
  if (edit.action == Action::mass) scene::set_mass(scene.bodies[index], edit.mass, "");
  if (edit.action == Action::friction) scene.bodies[index].material.friction = edit.friction;
  if (edit.action != Action::remove) return;
  scene.bodies.erase(scene.bodies.begin() + static_cast<std::ptrdiff_t>(index));
  scene.targets.erase(edit.name);
}

/// E.g. "added box", "mass of box: 2 kg".
std::string in_words(const ObjectEdit& edit) {
  const char* const done[] = {"added ", "moved ", "removed ", "mass of ", "friction of "};
  const std::string text = done[static_cast<std::size_t>(edit.action)] + edit.name;
  if (edit.action == Action::mass) return text + ": " + validation::number_text(edit.mass) + " kg";
  return edit.action == Action::friction ? text + ": " + validation::number_text(edit.friction) : text;
}

/// Appends an edit and drops those that it supersedes.
std::vector<ObjectEdit> with(std::vector<ObjectEdit> edits, const ObjectEdit& edit) {
  bool was_added = edit.action == Action::move;  // which changes no scene
  const auto superfluous = [&](const ObjectEdit& other) {
    const bool goes = other.name == edit.name && other.action != Action::remove && edit.action != Action::add &&
                      (edit.action == Action::remove || other.action == edit.action);
    was_added |= goes && other.action == Action::add;
    return goes;
  };
  edits.erase(std::remove_if(edits.begin(), edits.end(), superfluous), edits.end());
  if (!was_added) edits.push_back(edit);
  return edits;
}

/// The scene with the settings and the edits applied. Throws InputError if they do not match.
scene::Scene set_up(scene::Scene scene, const SimulationSettings& settings, const std::vector<ObjectEdit>& edits,
                    const std::vector<std::string>& roots) {
  validate(settings, "");
  scene.gravity = settings.gravity.value_or(scene.gravity);
  scene.force_scale = settings.force_scale.value_or(scene.force_scale);
  scene.contact = settings.contact.value_or(scene.contact);
  for (scene::Body& body : scene.bodies)
    if (settings.massless) body.mass_properties = scene::MassProperties();
  if (settings.tool) scene.tool = validation::name_of(*settings.tool);
  for (const ObjectEdit& edit : edits) make_edit(edit, roots, settings.massless, scene);
  const tools::GraspSettings& grasp = settings.grasp;
  if (!grasp.object.empty()) scene::movable_body(scene, grasp.object, grasp.object_location, "grasp.object");
  if (grasp.object.empty() && grasp.start_follow)
    validation::refuse_because("", "start.follow", "needs grasp.object, the object to move");
  return scene;
}

/// The properties that a simulation must share to be restored from a state of this one, one per line.
std::string origin_of(const scene::Scene& given, scene::ContactMode contact, const SimulationSettings& settings) {
  std::string text = "contact " + validation::name_of(contact) + "\nshape " + validation::name_of(settings.fork.shape) +
                     "\n" + std::to_string(settings.styluses) + " styluses\nbodies";
  for (const scene::Body& body : given.bodies) text += " " + body.name;
  return text;
}

/// Throws InputError naming the first property that differs.
void check_origin(const std::string& saved, const std::string& present) {
  if (saved == present) return;
  std::istringstream of_saved(saved), of_present(present);
  for (std::string was, is; std::getline(of_present, is);) {
    if (!std::getline(of_saved, was)) was = "nothing";
    if (was != is) validation::refuse_because("", "state", "saved with " + was + ", but this simulation has " + is);
  }
  if (std::string more; std::getline(of_saved, more))
    validation::refuse_because("", "state", "saved with " + more + ", which this simulation does not have");
}

/// Restores a state with nothing held, no samples, and the objects at rest.
void restore_at_rest(const SimulationState& state, Simulation& simulation) {
  simulation.restore(state);
  std::map<std::string, RigidTransform> X_WO;
  for (const bodies::BodyState& object : simulation.objects()) X_WO[object.name] = object.X_WO;
  simulation.reset();
  simulation.place(X_WO);
}

}  // namespace

struct Simulation::Impl {
  const scene::Scene given_scene;
  const SimulationSettings given_settings;
  const std::vector<ObjectEdit> edits;  ///< edits of the given scene
  SimulationSettings settings;
  const scene::Scene scene;
  const std::string origin;        ///< origin that its states carry
  std::size_t words_of_state = 0;  ///< size of the last saved state
  objects::Objects objects;
  std::vector<Hand> hands;
  bool started = false;
  double now = 0.0;             ///< world time, like all times in this class
  double requested_time = 0.0;  ///< the last requested time, in the hand's time

  Impl(const scene::Scene& s, const SimulationSettings& set, const std::vector<ObjectEdit>& edited = {},
       const std::vector<std::string>& roots = {})
      : given_scene(s),
        given_settings(set),
        edits(edited),
        settings(set),
        scene(set_up(s, set, edits, roots)),
        origin(origin_of(s, scene.contact, set)),
        objects(scene, set.impact_bisections) {
    const auto tool = validation::named<tools::Tool>(scene.tool, scene.path, "tool");
    if (settings.grasp.calibrate == tools::Calibration::world) fit_to_world();
    for (int i = 0; i < settings.styluses; ++i) hands.emplace_back(scene, settings, objects, tool);
  }
  Hand& hand(std::size_t index) { return validation::element(hands, index, "hand"); }
  double in_world(double t) const { return settings.hand_time_scale * t; }
  /// Converts world time to the hand's; exact for the last requested time, so that requesting it again changes nothing.
  double of_hand(double t) const {
    return t == in_world(requested_time) ? requested_time : t / settings.hand_time_scale;
  }
  /// The hand with this index, or all hands.
  std::vector<Hand*> chosen(std::optional<std::size_t> index) {
    if (index) return {&hand(*index)};
    std::vector<Hand*> all;
    for (Hand& hand : hands) all.push_back(&hand);
    return all;
  }
  /// Calibrates one fork for all objects (doc/model.md, "Calibration").
  void fit_to_world() {
    const tools::WorldGoal& goal = settings.grasp.world_goal;
    settings.fork.stiffness =
        tools::world_stiffness(settings.fork, tools::world_load(scene, goal), scene.gravity, goal);
    tools::damp_calibrated(settings.fork);
  }

  /// The earliest of a time of each hand's stylus.
  template <typename TimeOf>
  double earliest(TimeOf&& time_of) const {
    double earliest = std::numeric_limits<double>::infinity();
    for (const Hand& hand : hands) earliest = std::min(earliest, time_of(hand.stylus()));
    return earliest;
  }
  double first_sample() const { return earliest(std::mem_fn(&motion::Stylus::first_sample)); }
  double next_sample(double after) const {
    return earliest([&](const motion::Stylus& stylus) { return stylus.next_sample(after); });
  }
  double next_event_time() const {
    return earliest([&](const motion::Stylus& stylus) { return stylus.next_event_time(now); });
  }
  void start(double t_end);
  void advance(double t_end, double pause_at, AdvanceReport& report);
  void act(AdvanceReport& report);
  /// The held objects and spring forces before a change; used only by with_handover().
  std::vector<std::pair<std::optional<std::size_t>, Wrench>> held_before;
  /// Makes `change`, by which a hand may release its object; other hands on it take over the force of its springs.
  template <typename Change>
  void with_handover(Change&& change);
  using Slipping = std::map<Hand*, Wrench>;  ///< limited wrenches of slipping tools on their objects
  Wrench load(std::size_t object, const std::vector<Hand*>& on_it, const Slipping& slipping) const;
  double end_of_step(double t_end) const;
  Slipping beyond_limits(const Slipping& slipping);
  std::vector<objects::Carried> carried;  ///< bodies of one step; a member to reuse its memory, like `together`
  std::vector<Hand*> together;            ///< hands on one object
  void carry(double h, const Slipping& slipping, AdvanceReport& report);
  void step(double end, AdvanceReport& report);
  /// Saves or restores the state. `some`: only these objects; null: all.
  void archive(math::StateArchive& state, const std::vector<std::size_t>* some = nullptr);
  void set(const math::StateArchive::Words& words, const std::vector<std::size_t>* some = nullptr);
  /// The same; throws InputError, and changes nothing, if they are not a state.
  void restore(const math::StateArchive::Words& words);
  /// Saves or restores time and the hands' input.
  void archive_input(math::StateArchive& state);
  /// The given scene with these edits; nothing if they are the present ones.
  std::optional<Simulation> with_edits(const std::vector<ObjectEdit>& next,
                                       const std::vector<std::string>& roots) const;
  std::optional<Simulation> with_edits_of(const SimulationState& state) const;
  void move(const ObjectEdit& edit);
  /// Takes over the state of `before`, whose scene differs only by `edit`.
  void continue_from(Impl& before, const ObjectEdit& edit);
  void check_place(const std::string& name, const RigidTransform& X_WO) const;
  void fill_subsystems(AdvanceReport& report) const;
};

void Simulation::Impl::start(double t_end) {
  if (started) return;
  now = std::min(first_sample(), t_end);
  started = true;
  objects.begin(now);
  for (Hand& hand : hands) hand.stylus().advance_to(now);
}

template <typename Change>
void Simulation::Impl::with_handover(Change&& change) {
  if (std::count_if(hands.begin(), hands.end(), [](const Hand& hand) { return hand.holds(); }) < 2) return change();
  held_before.clear();
  for (const Hand& hand : hands) {
    held_before.emplace_back(hand.holds() ? hand.carried() : std::nullopt,
                             hand.holds() ? hand.spring_pull() : Wrench());
  }
  change();
  const auto keeps = [this](std::size_t i) { return hands[i].holds() && hands[i].carried() == held_before[i].first; };
  for (std::size_t i = 0; i < hands.size(); ++i) {
    Wrench left_W;
    int keep = 0, left = 0;
    for (std::size_t k = 0; k < hands.size() && keeps(i); ++k) {
      if (held_before[k].first != held_before[i].first) continue;
      ++(keeps(k) ? keep : left);
      if (!keeps(k)) left_W += held_before[k].second;
    }
    if (left == 0) continue;
    const double share = 1.0 / keep;
    held_before[i].second += Wrench{share * left_W.force, share * left_W.moment};
    hands[i].take_over(held_before[i].second, now);
  }
}

/// Updates highlights, grasps and releases, and the external wrenches that act from now on.
void Simulation::Impl::act(AdvanceReport& report) {
  objects.clear_highlights();
  for (Hand& hand : hands) report.wrench_timeouts += hand.stylus().follow_wrench(now) ? 1 : 0;
  with_handover([&] {
    for (Hand& hand : hands) {
      hand.select(now);
      hand.apply_buttons(now);
    }
  });
}

/// End time of the next step: at the next sample, button edge or change of a wrench, or earlier.
double Simulation::Impl::end_of_step(double t_end) const {
  const double next_sample = this->next_sample(now + same_time), next_event = this->next_event_time();
  // Equal steps up to the sample or the end, instead of a small last step.
  const double stretch_end = next_sample < t_end + same_time ? next_sample : t_end;
  const double count = std::ceil((stretch_end - now) / settings.dynamics.step - 1e-9);
  const double end = count > 1.0 ? now + (stretch_end - now) / count : stretch_end;
  // An edge that differs only by a rounding error does not get a step of its own.
  return std::abs(next_event - end) < same_time ? std::max(end, next_event) : std::min(end, next_event);
}

/// Sum of these hands' external wrenches and of their slipping tools' wrenches on an object, at its centre, world axes.
Wrench Simulation::Impl::load(std::size_t object, const std::vector<Hand*>& on_it, const Slipping& slipping) const {
  Wrench load_W;
  for (Hand* hand : on_it) {
    const auto slips = slipping.find(hand);
    const bool is_measured = hand->stylus().wrench() && hand->holds();
    if (!is_measured && slips == slipping.end()) continue;
    const tools::ToolState tool = hand->state(now);
    Wrench at_tip_W = slips != slipping.end() ? slips->second : Wrench();
    if (is_measured) at_tip_W += instruments::measured_at_tip(*hand->stylus().wrench(), tool);
    load_W += math::shifted(at_tip_W, tool.X_WE.translation() - objects.states()[object].X_WO.translation());
  }
  return load_W;
}

/// Steps all bodies: a tool what it alone holds, a leader what several tools hold. Tools that slip only load theirs.
void Simulation::Impl::carry(double h, const Slipping& slipping, AdvanceReport& report) {
  std::map<std::size_t, tools::Sharing> shared;
  carried.clear();
  for (Hand& hand : hands) {
    const auto object = hand.carried();
    if (!object) continue;
    together.clear();
    for (Hand& other : hands) {
      if (other.carried() == object) together.push_back(&other);
    }
    if (together.front() != &hand) continue;
    const Wrench load_W = load(*object, together, slipping);
    const auto slips = [&](Hand* of) { return slipping.count(of) > 0; };
    bodies::SteppedBody* body = nullptr;
    for (Hand* of : together) body = slips(of) ? of->begin_slip(load_W) : body;
    together.erase(std::remove_if(together.begin(), together.end(), slips), together.end());
    if (together.size() == 1 && together.front()->holds()) {
      body = together.front()->begin_step(now, h, load_W);
    } else if (!together.empty()) {
      std::vector<tools::ToolOnObject> tools;
      for (Hand* of : together) tools.push_back(of->begin_shared_step(now, h));
      tools::Sharing sharing(tools, [this, &hand] { return hand.make_pushable(now); });
      sharing.body()->set_load(load_W);
      body = shared.emplace(*object, std::move(sharing)).first->second.body();
    }
    if (body != nullptr) carried.push_back({*object, body});
  }
  std::sort(carried.begin(), carried.end(), [](const auto& a, const auto& b) { return a.object < b.object; });
  objects::StepCounts counts;
  objects.step(carried, now, h, counts);
  report.steps += counts.steps;
  report.steps_among_movable += counts.steps_among_movable;
  report.collision_queries += counts.collision_queries;
  report.steps_blocked += counts.steps_blocked;
  report.steps_unsolved += counts.steps_unsolved;
  report.steps_rejected += counts.steps_rejected;
  report.time_lost += counts.time_lost;
  report.position_error = std::max(report.position_error, counts.path_error);
  for (auto& [object, sharing] : shared)
    sharing.end_step({objects.states()[object].X_WO, objects.states()[object].V_WO_W, {}}, now + h);
  for (Hand& hand : hands) hand.end_step(report);
}

/// The hands that exceed their limits now and have to release or slip. Of hands that pull an object against each other
/// only the one that is beyond its limit most: once that has given way, the other may be within its own.
Simulation::Impl::Slipping Simulation::Impl::beyond_limits(const Slipping& slipping) {
  std::multimap<double, Slipping::value_type> beyond;  // by the share of the wrench that is within the limits
  for (Hand& hand : hands) {
    if (slipping.count(&hand) > 0 || !hand.springs()) continue;
    const instruments::LimitedWrench limited = instruments::limited_wrench(settings.limit, hand.state(now));
    if (limited.share < 1.0) beyond.emplace(limited.share, Slipping::value_type(&hand, limited.W));
  }
  Slipping first;
  for (const auto& entry : beyond) {
    const auto& [hand, pull_W] = entry.second;
    const auto opposes = [object = hand->carried(), force = pull_W.force](const auto& other) {
      return other.first->carried() == object && other.second.force.dot(force) < 0.0;
    };
    if (std::none_of(first.begin(), first.end(), opposes)) first.insert(entry.second);
  }
  return first;
}

/// Takes a step, again without a tool that exceeds its limit or with its limit wrench (doc/model.md, "At the limit").
void Simulation::Impl::step(double end, AdvanceReport& report) {
  const double h = end - now;
  const bool limited = std::isfinite(settings.limit.force) || std::isfinite(settings.limit.moment);
  const AdvanceReport so_far = report;
  Slipping slipping;
  math::StateArchive start;
  if (limited) archive(start);
  carry(h, slipping, report);
  for (Slipping more; limited && !(more = beyond_limits(slipping)).empty();) {
    set(start.words());
    report = so_far;
    if (settings.limit.action == tools::LimitAction::slip) {
      slipping.insert(more.begin(), more.end());
    } else {
      with_handover([&] {
        for (const auto& one : more) one.first->let_go(settings.grasp.release == tools::Release::thrown, now);
      });
    }
    start = math::StateArchive();
    archive(start);
    carry(h, slipping, report);
  }
  now = end;
  for (Hand& hand : hands) {
    hand.stylus().advance_to(now);
    hand.stylus().forget_before(now);
  }
  for (const auto& [hand, pull] : slipping) hand->end_slip(pull, h);
}

void Simulation::Impl::advance(double t_end, double pause_at, AdvanceReport& report) {
  start(t_end);
  const double begin = now;
  objects.contacts().begin_call();
  for (Hand& hand : hands) hand.begin_call();
  act(report);
  while (now < std::min(t_end, pause_at) - same_time) {
    step(end_of_step(t_end), report);
    act(report);
  }
  objects.contacts().end_call();
  report.simulated_time = now - begin;
  fill_subsystems(report);
}

void Simulation::Impl::archive(math::StateArchive& state, const std::vector<std::size_t>* some) {
  std::vector<ObjectEdit> same = edits;
  state(same, now, started, settings.dynamics.integrator, settings.dynamics.step, settings.dynamics.tolerance,
        settings.dynamics.error_bound);
  if (!(same == edits)) throw std::out_of_range("it was saved after other edits of the scene");
  objects::Objects::Archive of_objects(objects);
  some != nullptr ? of_objects.archive(state, *some) : of_objects.archive(state);
  for (Hand& hand : hands) hand.archive(state, now);
}

void Simulation::Impl::set(const math::StateArchive::Words& words, const std::vector<std::size_t>* some) {
  math::StateArchive state(words);
  archive(state, some);
  if (!state.at_end()) throw std::out_of_range("too many numbers");
}

void Simulation::Impl::archive_input(math::StateArchive& state) {
  state(now, requested_time, started);
  for (Hand& hand : hands) state(hand.stylus());
}

void Simulation::Impl::restore(const math::StateArchive::Words& words) {
  math::StateArchive present;
  archive(present);
  try {
    set(words);
  } catch (const std::exception& error) {
    set(present.words());
    throw validation::InputError(std::string("state: does not fit this simulation: ") + error.what());
  }
}

void Simulation::Impl::fill_subsystems(AdvanceReport& report) const {
  rod::ForkDofs run{false, false, false};
  for (const Hand& hand : hands) {
    const rod::ForkDofs of_hand = hand.dofs_run();
    run = {run.stretch || of_hand.stretch, run.bend || of_hand.bend, run.torsion || of_hand.torsion};
  }
  const bool stepped = report.steps > 0, bound = settings.dynamics.error_bound && stepped;
  const bool gravity = scene.gravity > 0.0 && stepped, collision = objects.with_contact() && stepped;
  const bool movable = report.steps_among_movable > 0;
  const bool ran[] = {run.stretch, run.bend, run.torsion, bound, gravity, objects.any_free(), collision, movable};
  for (std::size_t i = 0; i < report.ran.size(); ++i) report.ran[i] = ran[i];
}

Simulation::Simulation(const scene::Scene& scene, const SimulationSettings& settings)
    : impl_(std::make_unique<Impl>(scene, settings)) {}
Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const scene::Scene& Simulation::scene() const { return impl_->scene; }
const SimulationSettings& Simulation::settings() const { return impl_->settings; }
std::size_t Simulation::hands() const { return impl_->hands.size(); }

double Simulation::world_time() const {
  const double first = impl_->first_sample();
  return impl_->started || !std::isfinite(first) ? impl_->now : first;
}

double Simulation::time() const { return impl_->of_hand(world_time()); }

bool Simulation::push_stylus(const motion::PoseSample& sample, std::size_t hand) {
  motion::PoseSample in_world = sample;
  in_world.t = impl_->in_world(sample.t);
  in_world.X.translation() *= impl_->settings.hand_scale;
  return impl_->hand(hand).stylus().push(in_world);
}

void Simulation::push_edge(double t, motion::ButtonEdge edge, std::size_t hand) {
  validation::check_number("", "t", t, validation::any_number().in("s"));
  impl_->hand(hand).stylus().push(impl_->in_world(t), edge);
}

void Simulation::push_external_wrench(const motion::ExternalWrench& sample, std::size_t hand) {
  impl_->hand(hand).stylus().push(motion::ExternalWrench{impl_->in_world(sample.t), sample.wrench, sample.axes});
}

double Simulation::newest_sample_time() const {
  double newest = -std::numeric_limits<double>::infinity();
  for (const Hand& hand : impl_->hands)
    if (!hand.stylus().track().empty()) newest = std::max(newest, hand.stylus().track().end());
  return std::isfinite(newest) ? impl_->of_hand(newest) : time();
}

double Simulation::next_event_time() const {
  if (!impl_->started) return impl_->of_hand(impl_->first_sample());
  return impl_->of_hand(std::min(impl_->next_sample(impl_->now + same_time), impl_->next_event_time()));
}

AdvanceReport Simulation::advance_to(double t_end, double pause_at) {
  validation::check_number("", "t_end", t_end, validation::any_number().in("s"));
  AdvanceReport report;
  impl_->requested_time = t_end;
  impl_->advance(impl_->in_world(t_end), impl_->in_world(pause_at), report);
  report.simulated_time /= impl_->settings.hand_time_scale;
  report.time_lost /= impl_->settings.hand_time_scale;
  return report;
}

void Simulation::reset() {
  for (Hand& hand : impl_->hands) hand.reset();
  impl_->objects.reset();
  impl_->started = false;
}

void Simulation::place(const std::map<std::string, RigidTransform>& X_WO) {
  for (const auto& [name, X] : X_WO) {
    scene::movable_body(impl_->scene, name, "", "name");
    if (!X.matrix().allFinite()) validation::refuse("", name, "a finite pose");
  }
  release();
  for (const auto& [name, X] : X_WO) impl_->objects.place(*impl_->objects.find(name), X, impl_->now);
}

bool Simulation::release(std::optional<std::size_t> hand) {
  bool released = false;
  for (Hand* of : impl_->chosen(hand)) {
    released |= of->holds();
    impl_->with_handover([&] { of->let_go(impl_->settings.grasp.release == tools::Release::thrown, impl_->now); });
  }
  return released;
}

const rod::ForkSettings& Simulation::fork_settings(std::size_t hand) const { return impl_->hand(hand).fork(); }

ChangeReport Simulation::select_tool(tools::Tool tool, std::optional<std::size_t> hand) {
  return with_energy_report(*this, [&] {
    bool held = false;
    impl_->with_handover([&] {
      for (Hand* of : impl_->chosen(hand)) {
        held |= of->holds();
        of->select_tool(tool, impl_->now);
      }
    });
    return "tool: " + validation::name_of(tool) +
           (held && !tools::can_hold(tool) ? "; it cannot hold an object, so the object was released" : "");
  });
}

ChangeReport Simulation::change(const ForkChange& fork, const DynamicsChange& dynamics,
                                std::optional<std::size_t> hand) {
  SimulationSettings changed = impl_->settings;
  changed.dynamics = dynamics.applied_to(changed.dynamics);
  for (const Hand* of : impl_->chosen(hand)) {
    changed.fork = fork.applied_to(of->fork());
    validate(changed, "");
  }
  return with_energy_report(*this, [&] {
    std::string message = !fork.empty() ? "set" : dynamics.empty() ? "nothing changed" : "integrator and steps set";
    for (Hand* of : impl_->chosen(hand)) {
      const rod::ForkSettings next = fork.applied_to(of->fork());
      const std::string words = fork.empty() ? "" : rod::in_words(next);
      if (message.find(words) == std::string::npos) message += (message == "set" ? ": " : "; ") + words;
      if (next.changeable() != of->fork().changeable()) of->change_fork(fork, message);
    }
    if (dynamics.empty()) return message;
    impl_->settings.dynamics = changed.dynamics;
    for (Hand& of : impl_->hands) of.change_integrator();
    return message;
  });
}

void Simulation::Impl::check_place(const std::string& name, const RigidTransform& X_WO) const {
  const std::string other = objects.overlapped_body(*objects.find(name), X_WO);
  if (other.empty()) return;
  validation::refuse_because("", "pose", name + " would overlap " + other + " by more than 0.1 mm");
}

void Simulation::Impl::move(const ObjectEdit& edit) {
  const scene::Body& body = scene.bodies[scene::movable_body(scene, edit.name, "", "name")];
  const std::size_t object = *objects.find(edit.name);
  for (const Hand& hand : hands)
    if (hand.carried() == object)
      validation::refuse_because("", "name", edit.name + " is held or pushed; release it first");
  const RigidTransform X_WO = *edit.X_WL * body.X_OL.inverse();
  check_place(edit.name, X_WO);
  objects.place(object, X_WO, now);
}

void Simulation::Impl::continue_from(Impl& before, const ObjectEdit& edit) {
  now = before.now;
  requested_time = before.requested_time;
  started = before.started;
  settings.dynamics = before.settings.dynamics;
  if (edit.action == Action::add) {
    objects.continue_from(before.objects, now);
    check_place(edit.name, scene.bodies.back().X_WO);
  }
  // From here on nothing can fail.
  const std::size_t edited = before.objects.find(edit.name).value_or(0);
  before.with_handover([&] {
    for (Hand& hand : before.hands) {
      hand.end_touch(now);
      if (edit.action == Action::remove && hand.carried() == edited) hand.let_go(false, now);
    }
  });
  if (edit.action == Action::remove) before.objects.wake_supported_by(edited, now);
  objects.continue_from(before.objects, now);
  for (std::size_t i = 0; i < hands.size(); ++i)
    hands[i].continue_from(before.hands[i], edit.action == Action::mass ? edit.name : "", now);
}

std::optional<Simulation> Simulation::Impl::with_edits(const std::vector<ObjectEdit>& next,
                                                       const std::vector<std::string>& roots) const {
  if (next == edits) return std::nullopt;
  return Simulation(std::make_unique<Impl>(given_scene, given_settings, next, roots));
}

std::optional<Simulation> Simulation::Impl::with_edits_of(const SimulationState& state) const {
  check_origin(state.origin_, origin);
  return with_edits(state.edits(), {});
}

std::optional<Simulation> Simulation::prepare_edit(const ObjectEdit& edit,
                                                   const std::vector<std::string>& roots) const {
  validate(edit);
  return impl_->with_edits(with(impl_->edits, edit), roots);
}

ChangeReport Simulation::apply_edit(const ObjectEdit& edit, std::optional<Simulation>& next) {
  return with_energy_report(*this, [&] {
    if (edit.action == Action::move) impl_->move(edit);
    if (next) next->impl_->continue_from(*impl_, edit);
    if (next) std::swap(*this, *next);
    return in_words(edit);
  });
}

ChangeReport Simulation::calibrate(std::optional<std::size_t> hand) {
  return with_energy_report(*this, [&] {
    std::string message;
    for (Hand* of : impl_->chosen(hand)) of->calibrate(message, impl_->now);
    if (!message.empty()) return message;
    throw validation::InputError("no object is held by a fork or spring, so there is nothing to calibrate");
  });
}

SimulationState Simulation::save() const {
  math::StateArchive archive(impl_->words_of_state);
  impl_->archive(archive);
  SimulationState state;
  state.origin_ = impl_->origin;
  state.styluses_ = impl_->settings.styluses;
  state.words_ = std::move(archive).words();
  impl_->words_of_state = state.words_.size();
  return state;
}

void Simulation::restore(const SimulationState& state) {
  std::optional<Simulation> next = impl_->with_edits_of(state);
  (next ? *next : *this).impl_->restore(state.words_);
  if (next) std::swap(*this, *next);
}

std::optional<Simulation> Simulation::prepare_rewind(const SimulationState& state) const {
  std::optional<Simulation> next = impl_->with_edits_of(state);
  if (next) restore_at_rest(state, *next);
  return next;
}

void Simulation::rewind_to(const SimulationState& state, std::optional<Simulation>& next) {
  math::StateArchive input;
  impl_->archive_input(input);
  next ? std::swap(*this, *next) : restore_at_rest(state, *this);
  math::StateArchive kept(input.words());
  impl_->archive_input(kept);
  impl_->objects.begin(impl_->now);
}

void Simulation::copy_state_from(const Simulation& other) {
  if (other.impl_->origin != impl_->origin || !(other.impl_->edits == impl_->edits)) return restore(other.save());
  bodies::ChangeLog &own = impl_->objects.changes(), &others = other.impl_->objects.changes();
  const std::vector<std::size_t> differing = own.differing(others);
  math::StateArchive archive;
  other.impl_->archive(archive, &differing);
  impl_->set(archive.words(), &differing);
  own.mark_equal_to(others);
}

const std::vector<bodies::BodyState>& Simulation::objects() const { return impl_->objects.states(); }
const bodies::ChangeLog& Simulation::object_changes() const { return impl_->objects.changes(); }
const std::vector<contact::ContactState>& Simulation::contacts() const { return impl_->objects.contacts().reported(); }
tools::ToolState Simulation::tool(std::size_t hand) const { return impl_->hand(hand).state(impl_->now); }

double Simulation::elastic_energy() const {
  double energy = 0.0;
  for (const Hand& hand : impl_->hands) energy += hand.elastic_energy();
  return energy;
}

double Simulation::energy() const { return elastic_energy() + impl_->objects.energy(); }

ChangeReport with_energy_report(const Simulation& simulation, const std::function<std::string()>& change) {
  const double elastic = simulation.elastic_energy(), all = simulation.energy();
  const std::string message = change();
  return {elastic, simulation.elastic_energy(), simulation.energy() - all, message};
}

}  // namespace spring_workbench::simulation

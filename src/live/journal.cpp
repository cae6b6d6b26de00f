#include "spring_workbench/live/journal.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::live {

using hand_input::AcceptedInput;

Change comparison_of(const simulation::Simulation& simulation) {
  Change change;
  change.what = "for comparison";
  change.scene = simulation.scene().path;
  change.hash_before = simulation.state_hash();
  return change;
}

std::vector<std::vector<Entry>> lives_of(std::vector<Entry> entries) {
  std::vector<std::vector<Entry>> lives;
  std::map<std::size_t, std::uint64_t> newest;  // index by topic, in the present life
  for (Entry& entry : entries) {
    const auto [before, is_first] = newest.try_emplace(entry.what.index(), entry.index);
    if (lives.empty() || (!is_first && entry.index <= before->second)) {
      lives.emplace_back();
      newest.clear();
    }
    newest[entry.what.index()] = entry.index;
    lives.back().push_back(std::move(entry));
  }
  return lives;
}

std::vector<Entry> from_first_complete(std::vector<Entry> entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.index < b.index; });
  const auto input = std::find_if(entries.begin(), entries.end(),
                                  [](const Entry& e) { return std::holds_alternative<AcceptedInput>(e.what); });
  const auto first = std::make_reverse_iterator(input == entries.end() ? input : std::next(input));
  const auto after_gap = std::adjacent_find(
      first, entries.rend(), [](const Entry& later, const Entry& earlier) { return later.index != earlier.index + 1; });
  if (after_gap != entries.rend()) entries.erase(entries.begin(), std::prev(after_gap.base()));
  return entries;
}

void Replayer::play(const Entry& entry, const AtStop& at_stop) {
  const auto* change = std::get_if<Change>(&entry.what);
  if (simulation_.empty() && (change == nullptr || change->state == simulation::SimulationState())) return;
  if (simulation_.empty()) {
    scene_ = change->scene;
    settings_.styluses = change->state.hands();
    simulation_.emplace_back(load_scene_(scene_), settings_);
    simulation_.front().restore(change->state);
    next_ = entry.index + 1;
    return;
  }
  if (entry.index != next_) {
    throw validation::InputError("~accepted, ~changes: message " + std::to_string(next_) +
                                 " is missing, the next one is " + std::to_string(entry.index) +
                                 ": was the recorder too slow, or did it start late?");
  }
  ++next_;
  advance_to_entry(entry, at_stop);
  std::visit([&](const auto& what) { apply(what); }, entry.what);
  if (change != nullptr) at_stop(simulation_.front(), {});
}

void Replayer::advance_to_entry(const Entry& entry, const AtStop& at_stop) {
  simulation::Simulation& simulation = simulation_.front();
  const double t = entry.committed;
  for (double event = simulation.next_event_time(); event <= t; event = simulation.next_event_time()) {
    const simulation::AdvanceReport report = simulation.advance_to(event);
    at_stop(simulation, report);
  }
  if (simulation.time() >= t) return;
  const simulation::AdvanceReport report = simulation.advance_to(entry.target, t);
  at_stop(simulation, report);
}

void Replayer::apply(const AcceptedInput& accepted) {
  simulation::Simulation& simulation = simulation_.front();
  if (accepted.hand >= simulation.hands()) {
    validation::refuse("~accepted", "stylus", std::to_string(accepted.hand + 1),
                       "at most " + std::to_string(simulation.hands()) + ", as in the preceding state");
  }
  if (const auto edge = AcceptedInput::edge_of(accepted.kind)) {
    simulation.push_edge(accepted.t, *edge, accepted.hand);
  } else if (accepted.kind == AcceptedInput::Kind::pose) {
    simulation.push_stylus({accepted.t, accepted.X_WS}, accepted.hand);
  } else if (accepted.kind == AcceptedInput::Kind::lost) {
    simulation.release(accepted.hand);
  } else if (accepted.kind == AcceptedInput::Kind::external_wrench) {
    simulation.push_external_wrench(accepted.wrench, accepted.hand);
  }
}

void Replayer::apply(const Change& change) {
  const std::uint64_t hash = simulation_.front().state_hash();
  if (hash != change.hash_before) {
    throw validation::InputError("~changes: the state before \"" + change.what + "\" at " +
                                 std::to_string(simulation_.front().time()) +
                                 " s differs from the recorded one (other scene, settings or version?): hash " +
                                 math::to_hex(hash) + ", recorded " + math::to_hex(change.hash_before));
  }
  if (change.state == simulation::SimulationState()) return;
  const bool again = repeat(change);
  const simulation::SimulationState state = simulation_.front().save();
  const bool same = state == change.state;
  ++(again || same ? changes_.repeated : changes_.restored);
  if (same) return;
  if (again) {
    changes_.mismatches.push_back(change.what + " at " + std::to_string(simulation_.front().time()) + " s: state " +
                                  math::to_hex(state.hash()) + ", recorded " + math::to_hex(change.state.hash()));
  }
  if (change.scene != scene_) simulation_.front() = simulation::Simulation(load_scene_(change.scene), settings_);
  scene_ = change.scene;
  simulation_.front().restore(change.state);
}

/// Repeats a change. Returns false if that is impossible: an undone edit may be from before the journal, and a change
/// that failed in the live run fails again.
bool Replayer::repeat(const Change& change) {
  simulation::Simulation& simulation = simulation_.front();
  const Command::Kind kind = change.command.kind;
  if (kind == Command::Kind::none || (kind == Command::Kind::undo && undo_.empty())) return false;
  try {
    if (kind == Command::Kind::load_scene) {
      simulation::Simulation next(load_scene_(change.scene), simulation.settings());
      take_forks(simulation, next);
      simulation = std::move(next);
      scene_ = change.scene;
      undo_ = Undo();
    } else {
      undo_.perform(change.command, simulation);
    }
  } catch (const validation::InputError&) {
  }
  return true;
}

}  // namespace spring_workbench::live

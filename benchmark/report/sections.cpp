#include "benchmark/report/sections.h"

#include <algorithm>
#include <functional>
#include <sstream>

#include "benchmark/parallel.h"
#include "benchmark/report/pictures.h"
#include "benchmark/report/tables.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

PageSection::Figure figure(const Picture& picture, const std::string& folder) {
  return {draw(picture, folder), picture.caption};
}

PageSection scenes_section(const Measurements& measured, const Tables& tables, const std::string& folder) {
  PageSection section;
  section.title = "Scenes A, B, C: ours and the baselines";
  section.text =
      "A held body on a spring on a moving hand: A stretch, B torsion, C six coordinates; times a factor on the "
      "stiffness. First what a user has: a hand known by the poses of a 50 Hz tracker. Ours are then runs of "
      "Simulation; "
      "the others are given the motion through the poses, C1, with its velocity, as ours make it. Errors are those of "
      "integration, against a reference on the same motion; what nobody can know, since nobody knows how the hand "
      "moved "
      "between two samples, stands beside them (hand_error). Then the hand as a function of time, which the others ask "
      "whenever they like; ours, since Simulation takes poses, are given the function's at the ends of their steps, "
      "and "
      "what they make of the motion between these counts as their error. Ours step 20 ms at most, to the next output. "
      "Errors are the largest at the outputs and half-way between them. cvode_world is CVODE on the object's pose and "
      "velocity, cvode_deflection on the deflection, "
      "with tolerances of its size. Run times between two settings of a method by a power law.";
  std::vector<std::pair<std::string, std::string>> names;
  for (const char* hand : {"samples", "function"}) {
    for (const ErrorRow& row : measured.scenes) {
      const std::pair<std::string, std::string> name(row.scene, hand);
      if (row.hand == hand && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  for (const auto& [name, hand] : names) {
    section.figures.push_back(figure({"scene",
                                      tables.scenes,
                                      "error_against_run_time_" + name + "_" + hand + ".png",
                                      {name, hand},
                                      "Scene " + name + ", hand by " + hand + ": largest error against run time"},
                                     folder));
  }
  for (const double error : {1e-3, 1e-6, 1e-9}) {
    std::ostringstream title;
    title << "µs per simulated second for an error of " << error;
    section.tables.push_back({title.str() + " of the hand's amplitude",
                              run_time_for_error_csv(measured.scenes, error, &ErrorRow::error_over_hand_amplitude),
                              false});
    section.tables.push_back({title.str() + " of the largest deflection",
                              run_time_for_error_csv(measured.scenes, error, &ErrorRow::error_over_largest_deflection),
                              true});
  }
  section.tables.push_back({"All runs", as_csv(measured.scenes), true});
  return section;
}

PageSection rods_section(const Measurements& measured, const Tables& tables, const std::string& folder) {
  PageSection section;
  section.title = "Rods on a tracked hand: every integrator, shape and step";
  section.text =
      "The hand is known by its samples, and the motion through them is the same for all, so that what is left is the "
      "error of integration, against Radau IIA at 1e-12; ours are runs of Simulation, solver_… general methods on "
      "the same equation of motion; \"recorded\" cases: against the trajectories of another "
      "solver, good to 2e-9 m. Steps end at samples, but for those of CVODE unless it is restarted, and of methods "
      "…_through. Engines have no spring with a rod's law: where no degree of freedom is off, they move a free body "
      "on which it is a force, that of the start of the step (in MuJoCo's RK4 of each stage) or, …_stable, that of its "
      "end, linearised. If the body leaves the range of the rod, their run is not finite.";
  section.figures.push_back(
      figure({"rods", tables.rods, "rods.png", {}, "Error against run time on the rods"}, folder));
  for (const std::string& shape : validation::names<rod::ShapeKind>()) {
    section.tables.push_back(
        {"Step 0.02 s, shape " + shape + ": position, angle (position over the largest deflection), cost",
         one_step_per_sample_csv(measured.rods, shape), shape != "linear"});
  }
  const auto to_tolerance = [](const ErrorRow& row) { return row.error_over_tolerance > 0.0; };
  if (std::any_of(measured.rods.begin(), measured.rods.end(), to_tolerance)) {
    section.figures.push_back(
        figure({"tolerance",
                tables.rods,
                "tolerance.png",
                {},
                "Tolerance asked and error reached, every case and shape; run through Simulation"},
               folder));
  }
  section.tables.push_back({"All runs", as_csv(measured.rods), true});
  return section;
}

PageSection shapes_section(const Measurements& measured, double difference, const Tables& tables,
                           const std::string& folder) {
  PageSection section;
  section.title = "Shape models: error of the model beside error of integration";
  section.text = "A cantilever under a transverse dead load, against the exact elastica by elliptic integrals";
  if (difference >= 0.0) {
    std::ostringstream text;
    text << " (largest difference from the reference table " << difference << ")";
    section.text += text.str();
  }
  section.text += ", beside what integration adds with one step per sample where the fork bends most.";
  section.figures.push_back(
      figure({"shapes", tables.elastica, "shapes.png", {tables.rods}, "Error of the shape models and of integration"},
             folder));
  section.tables.push_back({"", shapes_csv(measured.elastica, measured.rods), false});
  section.tables.push_back({"All loads", elastica_csv(measured.elastica), true});
  section.tables.push_back(
      {"The drawn fork's curve against the exact elastica, driven by the exact tip, and what it costs",
       fork_curves_csv(measured.fork_curves), false});
  return section;
}

PageSection stability_section(const Measurements& measured, const Tables& tables, const std::string& folder) {
  PageSection section;
  section.title = "Stability map";
  section.text =
      "Cells drawn from stiffness × mass × step × damping × DOFs × hand × what the hand does then (rests, trembles "
      "by 1 nm to 1 mm, goes on), seeded, so that every pair of values is met; each is run through Simulation as a "
      "user runs it, for 10 s, one in 200 for 60 s. A cell holds where pose and twist stay finite and no further from "
      "the hand than free flight may take it, no step was rejected, and, while the hand rests or trembles, the energy "
      "less "
      "the hand's work does not grow by more than 1e-9 and the steps' own estimates (a hundredth at most), of the "
      "largest elastic and kinetic energy then and the weight times the fork's length. While the hand turns, or where "
      "its work is not known to a hundredth, the energy is not judged, nor that of `paper`, which has one of its own: "
      "energy judged counts the cells in which it was. The second row of panels is what it took: the share of steps "
      "that met the "
      "end of the rod's range (`stops`) or were done by the L-stable rule (`steps_fallback`): "
      "cells without any of them hold on their own. Cells without mass or with "
      "every DOF rigid cannot fail and are counted apart. "
      "The contact panel is a map of its own: boxes of the least and the largest mass, in both contact modes, pressed "
      "against "
      "others, shifted along them, and left alone. A cell holds where all objects stay finite and within 0.5 m of "
      "where they began, none gets deeper than 0.1 mm into another, the energy does not grow while the hand rests by "
      "more than 3 µm of depth are worth under the hardest load, and no step was rejected, blocked or unsolved. The "
      "map "
      "of contact is drawn from contact mode × stiffness × mass ratio × step × damping × friction × shape of the held "
      "object × obstacle (a wall, a loose box, a loose box in front of a wall, a stack), with every pair of values: "
      "the hand presses the held object by 20 mm, shifts it sideways, and rests. A cell holds where all objects stay "
      "finite and within 0.5 m of where they began, none gets deeper than 0.1 mm into another, no step was rejected, "
      "blocked or unsolved, and the processor time is below three times real time.";
  section.figures.push_back(figure({"stability",
                                    tables.map,
                                    "stability_map.png",
                                    {tables.limit_cases, tables.contact_map},
                                    "Share of the cells that hold, by stiffness and mass; limit cases of contact, and "
                                    "its map over mass ratio and stiffness"},
                                   folder));
  section.tables.push_back({"Cells", map_summary_csv(measured.map), false});
  section.tables.push_back({"Limit cases of contact", limit_cases_csv(measured.limit_cases), true});
  section.tables.push_back({"Map of contact", contact_map_csv(measured.contact_map), true});
  section.tables.push_back({"The worst cells of each integrator that do not hold", failures_csv(measured.map), true});
  if (!measured.stability_counts.empty()) {
    section.tables.push_back(
        {"Ours and the baselines on scenes A and C: cases of 11 stiffnesses × 5 masses × 4 steps that stay "
         "finite and bounded",
         stability_counts_csv(measured.stability_counts), false});
  }
  return section;
}

PageSection contact_section(const ContactTable& contact, const Tables& tables, const std::string& folder) {
  PageSection section;
  section.title = "Contact: error against run time";
  section.text =
      "Drag: a box of 5 kg held by six springs is pressed 0.1 m below the plane and dragged 0.5 m, μ = 0.5; it lags by "
      "μ (k 0.1 m + m g) / k (62.263 mm for factor 1) and should not be in the plane at all. Ours know the hand by 50 "
      "Hz "
      "poses, the engines as a function of time, at the beginning of each step; some engines are run once more with a "
      "box that "
      "cannot turn, which is easier, since then contact has nothing to rock. With contact dynamic the plane is the top "
      "of a "
      "movable slab of 1000 kg: on the bench it goes as with stop, to the same bits. Search: a box that falls on a "
      "plane as it "
      "turns, 40 mm and up to 1 rad in a step, against the exact pose of first contact; the levels of bisection halve "
      "the "
      "0.2 mm in which the sweep found the contact, not the whole step. Steps: a box that slides and stops, a sphere "
      "that slips and then rolls, and one that bounces, on the bench with contact stop and on a loose slab with "
      "dynamic, against exact solutions, and a held box that pushes another against a run with small steps; with "
      "contact dynamic, near others, no piece is longer than 2 ms whatever the step. Run times are processor time.";
  if (!contact.drags.empty()) {
    section.figures.push_back(figure({"contact",
                                      tables.drags,
                                      "contact.png",
                                      {tables.impacts, tables.motion_steps},
                                      "Drag, search for the pose of contact, and steps of motions in contact"},
                                     folder));
  }
  section.tables.push_back({"Drag", drags_csv(contact.drags), false});
  section.tables.push_back({"Search for the pose of contact", impacts_csv(contact.impacts), false});
  section.tables.push_back({"Steps of motions in contact", motion_steps_csv(contact.motion_steps), false});
  section.tables.push_back({"What each part of contact costs", contact_costs_csv(contact.costs), false});
  return section;
}

PageSection times_section(const std::vector<UnitTime>& times) {
  PageSection section;
  section.title = "What this report took";
  section.text = "Processor time of its units, those of their child processes included.";
  section.tables.push_back({"By part", times_by_part_csv(times), false});
  section.tables.push_back({"By unit", unit_times_csv(times), true});
  return section;
}

}  // namespace

PageSection checks_section(const std::vector<Check>& judged) {
  PageSection check;
  check.title = "Checks";
  check.text = "What was promised, what was measured in this run.";
  check.tables.push_back({"", checks_csv(judged), false});
  return check;
}

std::vector<PageSection> page_sections(const Measurements& measured, double elastica_difference, const Tables& tables,
                                       const std::string& folder) {
  PageSection costs;
  costs.title = "What each part of a step costs";
  costs.text =
      "exponential, by shape model and number of coordinates: processor time of the thread, the least of many short "
      "runs [ns].";
  costs.tables.push_back({"", step_cost_csv(measured.step_costs), false});
  const std::vector<std::function<PageSection()>> sections = {
      [&] { return rods_section(measured, tables, folder); },
      [&] { return scenes_section(measured, tables, folder); },
      [&] { return shapes_section(measured, elastica_difference, tables, folder); },
      [&] { return contact_section(measured.contact, tables, folder); },
      [&] { return stability_section(measured, tables, folder); },
      [&] { return costs; },
      [&] { return times_section(measured.unit_times); }};
  std::vector<PageSection> made(sections.size());
  parallel_for(sections.size(), [&](std::size_t i) { made[i] = sections[i](); });  // drawing pictures takes long
  return made;
}

}  // namespace spring_workbench::benchmark

#include "spring_workbench/simulation/settings.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <string>

#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::simulation::settings_test {
namespace {

std::string refusal(const std::string& yaml, SimulationSettings& settings) {
  try {
    apply_settings(YAML::Load(yaml), "some.yaml", settings);
  } catch (const validation::InputError& e) {
    return e.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A value that the key allows and that is not its default, as YAML.
std::string other_value(const SettingDescription& d) {
  if (d.type == "bool") return d.default_value == "true" ? "false" : "true";
  if (d.type == "int") return std::to_string(std::stoi(d.default_value) + 1);
  if (d.type == "double") return "0.07123";
  if (d.type == "double list") return "[0.1, 0.2, 0.3, 0, 0, 0, 1]";
  const std::string one_of = "one of ";
  if (d.allowed.rfind(one_of, 0) != 0) return "some_name";
  return d.allowed.substr(d.allowed.find_last_of(' ') + 1);
}

/// Everything that a settings struct holds, as text.
std::string fingerprint(const SimulationSettings& s) {
  std::ostringstream out;
  out.precision(17);
  const auto name = [](auto value) { return validation::name_of(value); };
  out << (s.tool ? name(*s.tool) : std::string()) << '|' << (s.contact ? name(*s.contact) : std::string()) << '|'
      << s.gravity.value_or(-1.0) << '|' << s.force_scale.value_or(-1.0) << '|' << name(s.dynamics.integrator) << '|'
      << s.dynamics.step << '|' << s.dynamics.tolerance << '|' << s.dynamics.error_bound << '|'
      << name(s.dynamics.inertia) << '|' << name(s.fork.shape) << '|' << s.fork.length << '|'
      << s.fork.slope_stiffness.value_or(-1.0) << '|';
  for (const rod::PerDof& p : {s.fork.stiffness, s.fork.damping_ratio, s.fork.damping_coefficient}) {
    out << p.stretch << '|' << p.bend << '|' << p.torsion << '|';
  }
  out << name(s.fork.damping_law) << '|' << s.fork.dofs.stretch << s.fork.dofs.bend << s.fork.dofs.torsion << '|'
      << s.limit.force << '|' << s.limit.moment << '|' << name(s.limit.action) << '|' << s.hand_scale << '|'
      << s.hand_time_scale << '|' << s.styluses << '|' << s.clutch_button << s.massless << '|' << s.fork.switch_off_time
      << '|' << name(s.grasp.calibrate) << s.grasp.object_goal.sag << '|' << s.grasp.object_goal.twist << '|'
      << s.grasp.world_goal.stretch << '|' << s.grasp.world_goal.bend << '|' << s.grasp.world_goal.twist << '|'
      << s.grasp.world_goal.heaviest.value_or(-1.0) << s.grasp.start_follow << '|' << s.grasp.object << '|'
      << name(s.grasp.release) << '|';
  if (s.grasp.X_OE) out << s.grasp.X_OE->matrix();
  out << '|' << s.dropout_after << '|' << s.external_wrench_timeout << '|' << s.impact_bisections;
  return out.str();
}

TEST(Settings, EveryKeySetsAFieldOfItsOwn) {
  std::set<std::string> outcomes = {fingerprint(SimulationSettings())};
  for (const SettingDescription& d : setting_descriptions()) {
    SimulationSettings settings;
    const std::string yaml = d.key + ": " + other_value(d);
    ASSERT_EQ(refusal(yaml, settings), "") << yaml;
    EXPECT_TRUE(outcomes.insert(fingerprint(settings)).second) << d.key << " changes nothing, or what another key sets";
  }
  EXPECT_EQ(outcomes.size(), 49u) << "one field of the structs has no key, or fingerprint() does not know it";
}

TEST(Settings, TheRefusalOfANumberNamesItsUnit) {
  for (const SettingDescription& d : setting_descriptions()) {
    if (d.type != "double") continue;
    SimulationSettings settings;
    std::string message = refusal(d.key + ": nan", settings);
    if (const std::size_t end = message.rfind(", or .inf"); end != message.npos) message.resize(end);
    const std::string last = message.substr(message.find_last_of(' ') + 1);
    EXPECT_EQ(d.unit == "–" ? contains("0123456789", last.substr(last.size() - 1)) : last == d.unit, true) << message;
  }
}

TEST(Settings, EveryDefaultThatIsAValueIsAllowed) {
  for (const SettingDescription& d : setting_descriptions()) {
    EXPECT_FALSE(d.meaning.empty() || d.unit.empty() || d.allowed.empty() || d.default_value.empty()) << d.key;
    if (contains(d.default_value, " ")) continue;  // says where the default comes from
    SimulationSettings settings;
    EXPECT_EQ(refusal(d.key + ": " + d.default_value, settings), "");
    EXPECT_EQ(fingerprint(settings), fingerprint(SimulationSettings())) << d.key;
  }
}

TEST(Settings, NestedAndDottedKeysAreTheSame) {
  const std::string spellings[] = {
      "fork: {length: 0.3, stiffness: {bend: 77.0}}\ngrasp: {object: box}",
      "fork.length: 0.3\nfork.stiffness.bend: 77.0\ngrasp.object: box",
      "fork: {length: 0.3, stiffness.bend: 77.0}\ngrasp.object: box",
      "fork.stiffness: {bend: 77.0}\nfork: {length: 0.3}\ngrasp: {object: box}",
  };
  SimulationSettings expected;
  expected.fork.length = 0.3;
  expected.fork.stiffness.bend = 77.0;
  expected.grasp.object = "box";
  for (const std::string& yaml : spellings) {
    SimulationSettings settings;
    EXPECT_EQ(refusal(yaml, settings), "");
    EXPECT_EQ(fingerprint(settings), fingerprint(expected)) << yaml;
  }
}

TEST(Settings, APoseIsAListOrAString) {
  SimulationSettings list, text;
  ASSERT_EQ(refusal("grasp.tip_in_object: [0.1, 0, -0.2, 0, 0, 2, 0]", list), "");
  ASSERT_EQ(refusal("grasp.tip_in_object: 0.1 0 -0.2 0 0 2 0", text), "");
  EXPECT_EQ(fingerprint(list), fingerprint(text));
  ASSERT_TRUE(list.grasp.X_OE);
  EXPECT_EQ(list.grasp.X_OE->translation(), Vector3d(0.1, 0.0, -0.2));
}

struct Bad {
  const char* yaml;
  const char* key;
  const char* value;
};

TEST(Settings, BadInputNamesPlaceKeyValueAndRuleAndChangesNothing) {
  const Bad table[] = {
      {"fork:\n  stiffness: {bend: -3}", "fork.stiffness.bend", "-3"},
      {"fork:\n  stiffness: {bend: .nan}", "fork.stiffness.bend", "nan"},
      {"fork:\n  stiffness: {bend: .inf}", "fork.stiffness.bend", "inf"},
      {"fork:\n  stiffness: {bend: stiff}", "fork.stiffness.bend", "stiff"},
      {"fork:\n  stiffness: {bend: [1, 2]}", "fork.stiffness.bend", "[1, 2]"},
      {"fork:\n  stiffness: {bend: }", "fork.stiffness.bend", ""},
      {"fork:\n  damping: {torsion: 11}", "fork.damping.torsion", "11"},
      {"fork:\n  length: 0", "fork.length", "0"},
      {"fork:\n  dofs: {bend: maybe}", "fork.dofs.bend", "maybe"},
      {"fork:\n  switch_off_time: 0", "fork.switch_off_time", "0"},
      {"\nstep: 0", "step", "0"},
      {"\nstep: 2", "step", "2"},
      {"\nintegrator: euler", "integrator", "euler"},
      {"\nshape: quintic", "shape", "quintic"},
      {"\ncontact: hard", "contact", "hard"},
      {"\ntool: hammer", "tool", "hammer"},
      {"\ninertia: none", "inertia", "none"},
      {"\nrelease: gently", "release", "gently"},
      {"\ngravity: -9.81", "gravity", "-9.81"},
      {"\nforce_scale: 0", "force_scale", "0"},
      {"\ndropout_after: 0", "dropout_after", "0"},
      {"\nimpact_bisections: -1", "impact_bisections", "-1"},
      {"\nimpact_bisections: 8.5", "impact_bisections", "8.5"},
      {"\ngrasp.object: [a]", "grasp.object", "[a]"},
      {"\ngrasp.tip_in_object: 0 0 0 0 0 0 0", "grasp.tip_in_object", "0 0 0 0 0 0 0"},
      {"\ngrasp.tip_in_object: 0 0 0 1", "grasp.tip_in_object", "0 0 0 1"},
      {"\ngrasp.tip_in_object: [.nan, 0, 0, 0, 0, 0, 1]", "grasp.tip_in_object", "nan"},
  };
  for (const Bad& bad : table) {
    SimulationSettings settings;
    settings.fork.length = 0.123;
    const std::string before = fingerprint(settings);
    const std::string message = refusal(std::string("start.follow: true\n") + bad.yaml, settings);
    const std::string start = std::string("some.yaml:3: ") + bad.key + ": invalid value '";
    EXPECT_EQ(message.substr(0, start.size()), start) << bad.yaml;
    EXPECT_TRUE(contains(message, bad.value)) << message;
    EXPECT_TRUE(contains(message, "': expected ")) << message;
    EXPECT_FALSE(contains(message, "\n")) << message;
    EXPECT_EQ(fingerprint(settings), before) << "all or none: " << bad.yaml;
  }
}

TEST(Settings, UnknownKeysAreRefusedNamingTheKnown) {
  for (const std::string yaml : {"step: {size: 0.01}", "rate: 50"}) {
    SimulationSettings settings;
    const std::string message = refusal(yaml, settings);
    EXPECT_EQ(message.rfind("some.yaml:1: ", 0), 0u) << message;
    EXPECT_TRUE(contains(message, "unknown key; known keys are ")) << message;
    for (const SettingDescription& d : setting_descriptions()) EXPECT_TRUE(contains(message, d.key));
  }
  SimulationSettings settings;
  EXPECT_EQ(refusal("fork: 3", settings), "some.yaml:1: fork: expected a map, e.g. with the key fork.length");
}

TEST(Settings, AMisspeltKeyIsRefusedNamingTheNearest) {
  SimulationSettings settings;
  EXPECT_EQ(refusal("stepp: 0.01", settings), "some.yaml:1: stepp: unknown key; did you mean step?");
  EXPECT_EQ(refusal("fork: {lenght: 0.3}", settings),
            "some.yaml:1: fork.lenght: unknown key; did you mean fork.length?");
}

TEST(Settings, AKeyGivenTwiceIsRefused) {
  SimulationSettings settings;
  EXPECT_TRUE(contains(refusal("fork.length: 0.3\nfork: {length: 0.4}", settings), "fork.length"));
  EXPECT_EQ(settings.fork.length, SimulationSettings().fork.length);
}

TEST(Settings, WhatIsNotAMapIsRefusedAndAnEmptyMapChangesNothing) {
  SimulationSettings settings;
  for (const std::string yaml : {"3", "[1, 2]", "step"})
    EXPECT_TRUE(contains(refusal(yaml, settings), "a map")) << yaml;
  EXPECT_EQ(refusal("{}", settings), "");
  EXPECT_EQ(refusal("fork: {}", settings), "");
  EXPECT_EQ(fingerprint(settings), fingerprint(SimulationSettings()));
}

/// What a settings file refuses, settings made in C++ refuse, too.
TEST(Settings, ValidateRefusesWhatFilesMayNotContain) {
  const auto refused = [](auto change) {
    SimulationSettings settings;
    change(settings);
    EXPECT_THROW(validate(settings, "test"), validation::InputError);
    EXPECT_THROW(Simulation(scene::Scene(), settings), validation::InputError);
  };
  EXPECT_NO_THROW(validate(SimulationSettings(), "test"));
  const double nan = std::nan("");
  for (const double step : {0.0, -1.0, nan, 2.0}) refused([=](auto& s) { s.dynamics.step = step; });
  for (const double tolerance : {-1e-9, nan, 1.0}) refused([=](auto& s) { s.dynamics.tolerance = tolerance; });
  for (const double stiffness : {-1.0, nan, 1e20}) refused([=](auto& s) { s.fork.stiffness.bend = stiffness; });
  for (const double gravity : {-1.0, nan}) refused([=](auto& s) { s.gravity = gravity; });
  for (const int styluses : {-1, 0, 256}) refused([=](auto& s) { s.styluses = styluses; });
  for (const int levels : {-1, 31}) refused([=](auto& s) { s.impact_bisections = levels; });
  refused([](auto& s) { s.contact = static_cast<scene::ContactMode>(7); });
  refused([](auto& s) { s.grasp.release = static_cast<tools::Release>(-1); });
  refused([](auto& s) { s.dynamics.inertia = static_cast<dynamics::Inertia>(2); });
  refused([](auto& s) { s.fork.slope_stiffness = 0.0; });
  refused([=](auto& s) { s.limit.force = nan; });
  refused([=](auto& s) { s.dropout_after = 0.0; });
  refused([](auto& s) { s.grasp.X_OE = RigidTransform::Identity(); });
  refused([](auto& s) {
    s.fork.damping_law = rod::DampingLaw::modal;
    s.fork.damping_ratio.bend = 0.5;
  });
}

/// A key from before the first release is reported with its current name.
TEST(Settings, ARenamedKeyIsReportedWithItsNewName) {
  for (const auto& [before, now] : validation::renamed()) {
    if (before.find('.') == std::string::npos) continue;  // a message's field
    SimulationSettings settings;
    const std::string message = refusal(before + ": 1", settings);
    EXPECT_TRUE(contains(message, before)) << message;
    EXPECT_TRUE(contains(message, "it is now called " + now)) << message;
    EXPECT_FALSE(contains(message, "\n")) << message;
  }
}

TEST(Settings, ARenamedValueIsReportedWithItsNewName) {
  SimulationSettings settings;
  const std::string message = refusal("integrator: closed_form", settings);
  EXPECT_TRUE(contains(message, "integrator: invalid value 'closed_form': expected paper, which has replaced it"))
      << message;
}

}  // namespace
}  // namespace spring_workbench::simulation::settings_test

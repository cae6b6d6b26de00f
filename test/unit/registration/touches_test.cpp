#include "spring_workbench/registration/touches.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "spring_workbench/validation/input_error.h"
#include "support/random_poses.h"
#include "support/temporary_folder.h"

namespace spring_workbench::registration::touches_test {
namespace {

/// A stylus with its tip at rest at the points, one after the other, the button down; between them it is up.
std::vector<motion::StylusSample> resting_at(const std::vector<Vector3d>& tips_T, const Vector3d& p_ST) {
  test_support::Random random(3);
  std::vector<motion::StylusSample> samples;
  for (const Vector3d& tip : tips_T) {
    for (int k = 0; k < 40; ++k) {
      motion::StylusSample sample;
      sample.X.linear() = random.pose(1.0).linear();
      sample.X.translation() = tip - sample.X.linear() * p_ST;
      sample.button = k < 30;
      if (!sample.button) sample.X.translation() += Vector3d(0.3, 0.1 * k, 0.0);
      samples.push_back(sample);
    }
  }
  return samples;
}

StoredRegistration read(const std::string& text) {
  const test_support::TemporaryFolder folder;
  folder.write("found.yaml", text);
  return read_registration_file(folder.path("found.yaml"));
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const validation::InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("found.yaml"));
  }
  return "(read)";
}

TEST(Touches, AFileOfARegistrationHasATipAndNoUnknownKey) {
  const std::string offset = "offset: [0, 0, 0, 0, 0, 0, 1]\n", tip = "tip: [0.01, 0.02, 0.15]\n";
  EXPECT_EQ(refusal(offset + tip), "(read)");
  EXPECT_EQ(refusal(tip), "(read)");
  EXPECT_EQ(refusal(""), "found.yaml: missing required key tip: 3 finite numbers");
  EXPECT_EQ(refusal(offset), "found.yaml:1: missing required key tip: 3 finite numbers");
  EXPECT_EQ(refusal(offset + "tp: [0, 0, 0]\n"), "found.yaml:2: tp: unknown key; known keys are offset, tip");
  EXPECT_EQ(refusal("0 0 0 0.4 1 0 0 0\n"),
            "found.yaml:1: top level: invalid value '0 0 0 0.4 1 0 0 0': expected a map");
}

TEST(Touches, TheTipIsAddedToTheOneThereIs) {
  const Vector3d p_ST(0.01, -0.02, 0.15), known(0.01, 0.0, 0.1);
  StoredRegistration present;
  present.X_BT = test_support::Random(4).pose(1.0);
  present.p_ST = known;
  const auto samples = as_sent(resting_at({Vector3d(0.2, 0.1, 0.05)}, p_ST), present);
  const std::string text = find_tip(samples, present, 1e-6);
  EXPECT_NE(text.find("# tip: rms "), std::string::npos);
  EXPECT_NE(text.find(" mm over 30 poses"), std::string::npos);
  const StoredRegistration found = read(text);
  EXPECT_LT((found.p_ST - p_ST).norm(), 1e-8);
  EXPECT_TRUE(found.X_BT.isApprox(present.X_BT, 1e-8));
}

TEST(Touches, TheTrackerIsFoundWhereverItWasThoughtToBe) {
  const Vector3d p_ST(0.01, -0.02, 0.15);
  const RigidTransform X_BT = test_support::Random(5).pose(1.0);
  std::vector<Landmark> known;
  std::vector<Vector3d> tips_T;
  for (const Vector3d& p_B : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.4, 0.0, 0.0), Vector3d(0.1, 0.3, 0.0),
                              Vector3d(0.35, 0.25, 0.1), Vector3d(0.0, 0.15, 0.2)}) {
    known.push_back({std::string(1, static_cast<char>('a' + known.size())), p_B, {}});
    tips_T.push_back(X_BT.inverse() * p_B);
  }
  for (const bool thought : {false, true}) {
    StoredRegistration present;
    present.p_ST = p_ST;
    if (thought) present.X_BT = test_support::Random(6).pose(1.0);
    const std::string text = find_tracker(as_sent(resting_at(tips_T, p_ST), present), known, present, 1e-6);
    EXPECT_NE(text.find("# e: residual "), std::string::npos);
    const StoredRegistration found = read(text);
    EXPECT_TRUE(found.X_BT.isApprox(X_BT, 1e-7)) << thought;
    EXPECT_LT((found.p_ST - p_ST).norm(), 1e-8);
  }
  StoredRegistration without_tip;
  const auto moving = as_sent(resting_at(tips_T, p_ST), without_tip);
  EXPECT_THROW(find_tracker(moving, known, without_tip, 5e-3), validation::InputError);
  known.pop_back();
  EXPECT_THROW(find_tracker(moving, known, without_tip, 1.0), validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::registration::touches_test

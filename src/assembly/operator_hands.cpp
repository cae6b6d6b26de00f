#include "spring_workbench/assembly/operator_hands.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/motion/minimum_jerk.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::assembly {
namespace {

const OperatorSettings& checked(const OperatorSettings& s) {
  const std::string where = "operator";
  validation::check_number(where, "rate", s.rate, validation::between(1.0, 1000.0).in("Hz"));
  validation::check_number(where, "reaction", s.reaction, validation::between(0.0, 2.0).in("s"));
  validation::check_number(where, "position_noise", s.position_noise, validation::between(0.0, 0.1).in("m"));
  validation::check_number(where, "angle_noise", s.angle_noise, validation::between(0.0, 1.0).in("rad"));
  validation::check_number(where, "aim_scatter", s.aim_scatter, validation::between(0.0, 0.5));
  return s;
}

}  // namespace

OperatorHands::OperatorHands(const std::vector<RigidTransform>& X_WH, const OperatorSettings& settings)
    : settings_(checked(settings)), random_(settings.seed) {
  for (const RigidTransform& X : X_WH) hands_.push_back({X, X, X, X});
}

std::vector<RigidTransform> OperatorHands::X_WH() const {
  std::vector<RigidTransform> all;
  for (const Hand& hand : hands_) all.push_back(hand.X_WH);
  return all;
}

std::size_t OperatorHands::nearest(const Vector3d& p_W, const Numbers& others) const {
  const auto distance = [&](std::size_t hand) { return (X_WH_start(hand).translation() - p_W).head<2>().norm(); };
  std::optional<std::size_t> best;
  for (std::size_t hand = 0; hand < hands_.size(); ++hand) {
    if (std::count(others.begin(), others.end(), hand) > 0) continue;
    if (!best || distance(hand) < distance(*best)) best = hand;
  }
  return best.value();
}

double OperatorHands::arrival(const Hand& hand, const RigidTransform& X_WH, double t_from) {
  const Vector3d path = X_WH.translation() - hand.X_WH_goal.translation();
  const double turn = math::log_so3(hand.X_WH_goal.linear().transpose() * X_WH.linear()).norm();
  return t_from + 0.1 + fitts_slope * std::log2(1.0 + std::hypot(path.norm(), lever * turn) / fitts_width);
}

double OperatorHands::reach(const Numbers& hands, const std::function<RigidTransform(std::size_t)>& X_WH,
                            double t_from) {
  double t_to = t_from;
  for (const std::size_t number : hands) t_to = std::max(t_to, arrival(hands_[number], X_WH(number), t_from));
  for (const std::size_t number : hands) {
    Hand& hand = hands_[number];
    RigidTransform X_WH_goal = X_WH(number);
    const double distance = (X_WH_goal.translation() - hand.X_WH_goal.translation()).norm();
    X_WH_goal.translation() += settings_.aim_scatter * distance * random_.next_vector();
    hand.X_WH_from = t_from < hand.t_to - time_slack ? hand.X_WH : hand.X_WH_goal;
    hand.X_WH_goal = X_WH_goal;
    hand.t_from = t_from;
    hand.t_to = t_to;
  }
  return t_to;
}

motion::StylusSample OperatorHands::sample(std::size_t number, double t) {
  Hand& hand = hands_[number];
  const double u = hand.t_to > hand.t_from ? std::clamp((t - hand.t_from) / (hand.t_to - hand.t_from), 0.0, 1.0) : 1.0;
  hand.X_WH = motion::minimum_jerk_pose(hand.X_WH_from, hand.X_WH_goal, u);
  motion::StylusSample sample;
  sample.t = t;
  sample.button = hand.pressed;
  sample.hand = number;
  const Vector3d p = hand.X_WH.translation() + settings_.position_noise * random_.next_vector();
  sample.X =
      make_transform(p, Quaterniond(hand.X_WH.linear() * math::exp_so3(settings_.angle_noise * random_.next_vector())));
  return sample;
}

}  // namespace spring_workbench::assembly

#include "spring_workbench/hand_input/input_filter.h"

namespace spring_workbench::hand_input {

TrueSample TruthLayer::take(const RawSample& raw) {
  const Verdict verdict = gate_.offer(raw);
  if (!usable(verdict)) return {verdict, {}};
  return pass_on(verdict, {raw.t, make_transform(raw.q, raw.p)});
}

TrueSample TruthLayer::take(const motion::PoseSample& sample) {
  const Verdict verdict = gate_.offer({sample.t, sample.X.translation(), Quaterniond(sample.X.linear())});
  if (!usable(verdict)) return {verdict, {}};
  return pass_on(verdict, sample);
}

TrueSample TruthLayer::pass_on(Verdict verdict, const motion::PoseSample& sample) {
  if (verdict == Verdict::new_place) filter_.restart();
  return {verdict, filter_.filter(sample)};
}

void TruthLayer::restart() {
  gate_.restart();
  filter_.restart();
}

}  // namespace spring_workbench::hand_input

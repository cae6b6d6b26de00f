#include "spring_workbench/bodies/body_state.h"

#include <cstring>

namespace spring_workbench::bodies {

bool same_bits(const BodyState& a, const BodyState& b) {
  const auto same = [](const auto& x, const auto& y) {
    return std::memcmp(x.data(), y.data(), sizeof(double) * static_cast<std::size_t>(x.size())) == 0;
  };
  return same(a.X_WO.matrix(), b.X_WO.matrix()) && same(a.V_WO_W.linear, b.V_WO_W.linear) &&
         same(a.V_WO_W.angular, b.V_WO_W.angular) && a.held == b.held && a.highlighted == b.highlighted &&
         a.in_contact == b.in_contact && a.asleep == b.asleep;
}

BodyState at_start(const scene::Body& body) {
  BodyState state;
  state.name = body.name;
  state.X_WO = body.X_WO;
  return state;
}

}  // namespace spring_workbench::bodies

#include "spring_workbench/bodies/body_state.h"

#include <algorithm>
#include <cstring>
#include <iterator>

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

void ChangeLog::reset(std::size_t objects) {
  ++count_;
  links_.resize(objects + 1);
  for (std::size_t i = 0; i <= objects; ++i) links_[i] = {count_, i > 0 ? i - 1 : objects, i < objects ? i + 1 : 0};
}

void ChangeLog::note(std::size_t object) {
  Link &link = links_[object], &end = links_.back();
  link.at = ++count_;
  links_[link.newer].older = link.older;
  links_[link.older].newer = link.newer;
  link.newer = links_.size() - 1;
  link.older = end.older;
  links_[end.older].newer = object;
  end.older = object;
}

std::vector<std::size_t> ChangeLog::since(const Revision& then) const {
  const std::uint64_t count = then.of == self_ ? then.count : 0;
  std::vector<std::size_t> objects;
  for (std::size_t i = links_.back().older; i + 1 < links_.size() && links_[i].at > count; i = links_[i].older)
    objects.push_back(i);
  std::sort(objects.begin(), objects.end());
  return objects;
}

std::vector<std::size_t> ChangeLog::differing(const ChangeLog& other) const {
  const std::vector<std::size_t> here = since(own_), there = other.since(others_);
  std::vector<std::size_t> objects;
  std::set_union(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(objects));
  return objects;
}

}  // namespace spring_workbench::bodies

#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// What a part of contact costs.
struct ContactCost {
  std::string contact;  ///< mode: none, stop, dynamic
  std::string part;
  double nanoseconds = 0.0;  ///< processor time of this thread: least of many short runs
};

template <typename Fields>
void each_field(ContactCost& c, Fields& fields) {
  fields(c.contact, c.part, c.nanoseconds);
}

/// The questions that `stop` asks of the collision world, a step of the rigid-body world, and whole steps of 20 ms of
/// Simulation in each mode: a box that is carried freely, carried low over the bench, pressed on it, and pushed against
/// another.
std::vector<ContactCost> measure_contact_costs();

}  // namespace spring_workbench::benchmark

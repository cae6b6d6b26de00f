#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Cost of a part of contact.
struct ContactCost {
  std::string contact;  ///< mode: none, stop, dynamic
  std::string part;
  double nanoseconds = 0.0;  ///< processor time of this thread: minimum over many short runs
};

template <typename Fields>
void each_field(ContactCost& c, Fields& fields) {
  fields(c.contact, c.part, c.nanoseconds);
}

/// Measures the queries of mode `stop` to the collision world, a step of the rigid-body world, and whole steps of 20 ms
/// of Simulation in each mode: with a box that is carried freely, carried just above the bench, pressed onto it, and
/// pushed against another.
std::vector<ContactCost> measure_contact_costs();

}  // namespace spring_workbench::benchmark

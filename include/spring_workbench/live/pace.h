#pragma once

namespace spring_workbench::live {

/// What simulating costs, and whether it can keep up with the hands. Behind, simulated time is slower than theirs: no
/// sample is taken until all that was taken is simulated.
class Pace {
 public:
  /// A commit simulated so much time [s] in so much of the steady clock's [s]; `lag`: what is to be simulated from
  /// there to the newest sample [s].
  void committed(double simulated, double took, double lag);
  /// All that was taken is simulated.
  void caught_up() { behind_ = false; }
  bool is_behind() const { return behind_; }
  /// What it takes to simulate so much [s].
  double work(double time) const { return cost_ * time; }
  /// Whether a copy can go so far ahead beside it [s].
  bool can_look_ahead(double time) const;

 private:
  double cost_ = 0.0;  ///< of a second of simulated time, smoothed [s]
  bool behind_ = false;
};

}  // namespace spring_workbench::live

#pragma once

#include "spring_workbench/bodies/free_body.h"

namespace spring_workbench::bodies {

/// A free body under a constant wrench at its centre, world axes: the object on a tool that is at its limit.
class PulledBody final : public SteppedBody {
 public:
  PulledBody(const FreeBody& free, const Wrench& pull_W) : free_(free), pull_W_(pull_W) {}

  std::size_t index() const override { return free_.index(); }
  motion::MotionState object() const override { return free_.object(); }
  bool advance(double h, const Wrench& contact_W) override {
    return free_.advance(h, {contact_W.force + pull_W_.force, contact_W.moment + pull_W_.moment});
  }
  void save(TrialStart& start) const override { free_.save(start); }
  void restore(const TrialStart& start) override { free_.restore(start); }
  Response response(double h) const override { return free_.response(h); }
  void correct(double h, const Wrench& change_W) override { free_.correct(h, change_W); }
  Matrix6d mobility() const override { return free_.mobility(); }
  void add_impulse(const Wrench& impulse_W) override { free_.add_impulse(impulse_W); }
  bool uses_mean_velocity() const override { return true; }
  void block(double h) override { free_.block(h); }

 private:
  FreeBody free_;
  Wrench pull_W_;
};

}  // namespace spring_workbench::bodies

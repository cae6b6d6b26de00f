#pragma once

#include <QWidget>

#ifndef Q_MOC_RUN
#include <array>

#include "spring_workbench/ForkState.h"
#include "spring_workbench/SetForkDamping.h"
#include "spring_workbench/SetForkDofs.h"
#include "spring_workbench/SetForkStiffness.h"
#endif

class QCheckBox;

namespace spring_workbench::rviz_plugin {

class LogSlider;

/// A switch, a stiffness and a damping value for each degree of freedom of the fork: stretch, bend, torsion.
class DofControls : public QWidget {
  Q_OBJECT
 public:
  explicit DofControls(QWidget* parent);

  void show_sliders(const ForkState& fork);
  void show_switches(const ForkState& fork);

  SetForkDofs::Request dofs() const;
  /// Request to set the stiffness of the `i`-th degree of freedom and keep the others.
  SetForkStiffness::Request stiffness(int i) const;
  SetForkDamping::Request damping() const;

 Q_SIGNALS:
  void switched();
  void stiffness_moved(int i);
  void damping_moved();

 private:
  struct Dof {
    QCheckBox* on;
    LogSlider *stiffness, *damping;
  };
  std::array<Dof, 3> dofs_{};
};

}  // namespace spring_workbench::rviz_plugin

#include "dof_controls.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>

#include "log_slider.h"

namespace spring_workbench::rviz_plugin {

DofControls::DofControls(QWidget* parent) : QWidget(parent) {
  struct Look {
    const char* name;
    double softest, stiffest;
    const char* unit;
  };
  const std::array<Look, 3> looks{
      {{"Stretch", 1.0, 1e6, "N/m"}, {"Bend", 1.0, 1e6, "N/m"}, {"Torsion", 1e-3, 1e4, "N m/rad"}}};
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const Look& look = looks[static_cast<std::size_t>(i)];
    Dof& dof = dofs_[static_cast<std::size_t>(i)];
    dof.on = new QCheckBox(look.name, this);
    dof.stiffness = new LogSlider(look.softest, look.stiffest, look.unit, this);
    dof.damping = new LogSlider(0.01, 10.0, "", this);
    dof.on->setToolTip("off: rigid");
    dof.stiffness->setToolTip("stiffness");
    dof.damping->setToolTip("damping ratio, 1 is critical; with the law 'coefficients': N s/m, N m s/rad");
    grid->addWidget(dof.on, 2 * i, 0);
    grid->addWidget(dof.stiffness, 2 * i, 1);
    grid->addWidget(new QLabel("  damping", this), 2 * i + 1, 0);
    grid->addWidget(dof.damping, 2 * i + 1, 1);
    connect(dof.on, &QCheckBox::clicked, this, &DofControls::switched);
    connect(dof.stiffness, &LogSlider::moved, this, [this, i] { Q_EMIT stiffness_moved(i); });
    connect(dof.damping, &LogSlider::moved, this, &DofControls::damping_moved);
  }
}

void DofControls::show_sliders(const ForkState& fork) {
  const std::array<double, 3> stiffness{fork.stretch_stiffness, fork.bend_stiffness, fork.torsion_stiffness};
  const std::array<double, 3> ratio{fork.stretch_damping_ratio, fork.bend_damping_ratio, fork.torsion_damping_ratio},
      coefficient{fork.stretch_damping_coefficient, fork.bend_damping_coefficient, fork.torsion_damping_coefficient};
  const std::array<double, 3>& damping = fork.damping_law == "coefficients" ? coefficient : ratio;
  for (std::size_t i = 0; i < 3; ++i) {
    dofs_[i].stiffness->show_value(stiffness[i]);
    dofs_[i].damping->show_value(damping[i]);
  }
}

void DofControls::show_switches(const ForkState& fork) {
  const std::array<bool, 3> on{fork.stretch_on != 0, fork.bend_on != 0, fork.torsion_on != 0};
  for (std::size_t i = 0; i < 3; ++i) dofs_[i].on->setChecked(on[i]);
}

SetForkDofs::Request DofControls::dofs() const {
  SetForkDofs::Request request;
  request.stretch = dofs_[0].on->isChecked() ? 1 : 0;
  request.bend = dofs_[1].on->isChecked() ? 1 : 0;
  request.torsion = dofs_[2].on->isChecked() ? 1 : 0;
  return request;
}

SetForkStiffness::Request DofControls::stiffness(int i) const {
  SetForkStiffness::Request request;  // 0 keeps the current value
  const std::array<double*, 3> fields{&request.stretch, &request.bend, &request.torsion};
  *fields[static_cast<std::size_t>(i)] = dofs_[static_cast<std::size_t>(i)].stiffness->value();
  return request;
}

SetForkDamping::Request DofControls::damping() const {
  SetForkDamping::Request request;  // without a law: values of the one in force
  request.stretch = dofs_[0].damping->value();
  request.bend = dofs_[1].damping->value();
  request.torsion = dofs_[2].damping->value();
  return request;
}

}  // namespace spring_workbench::rviz_plugin

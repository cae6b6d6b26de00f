#include "workbench_panel.h"

#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "constants.h"
#include "dof_controls.h"
#include "log_slider.h"
#include "shared_master_watch.h"
#include "spring_workbench/Calibrate.h"
#include "spring_workbench/LoadScene.h"
#include "spring_workbench/Release.h"
#include "spring_workbench/SelectTool.h"
#include "spring_workbench/SetClutch.h"
#include "spring_workbench/SetIntegrator.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/tools/tool.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/names.h"
#include "step_figures.h"

namespace spring_workbench::rviz_plugin {
namespace {

QComboBox* choice_of(const std::vector<std::string>& names, QWidget* parent) {
  auto* box = new QComboBox(parent);
  for (const std::string& name : names) box->addItem(QString::fromStdString(name));
  return box;
}

}  // namespace

WorkbenchPanel::WorkbenchPanel(QWidget* parent)
    : rviz::Panel(parent),
      services_([this](const std::string& text) { Q_EMIT answered(QString::fromStdString(text)); }) {
  controls_ = make_controls();
  answer_ = new QLabel(this);
  answer_->setWordWrap(true);
  figures_ = new StepFigures(this);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(make_node());
  layout->addWidget(controls_);
  layout->addWidget(figures_);
  layout->addWidget(answer_);
  layout->addStretch(1);
  connect(this, &WorkbenchPanel::answered, answer_, &QLabel::setText, Qt::QueuedConnection);
}

QLayout* WorkbenchPanel::make_node() {
  node_field_ = new QLineEdit(this);
  node_field_->setToolTip("name of the node, relative to the namespace of rviz");
  connect(node_field_, &QLineEdit::editingFinished, this, [this] { follow(node_field_->text()); });
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel("Node", this));
  row->addWidget(node_field_);
  return row;
}

template <typename Service>
void WorkbenchPanel::ask(const std::string& service, const typename Service::Request& request) {
  free_at_ = panel_time() + settling;
  services_.call<Service>(service, node_.of_node(service), request);
}

QWidget* WorkbenchPanel::make_controls() {
  auto* controls = new QWidget(this);
  auto* layout = new QVBoxLayout(controls);
  layout->setContentsMargins(0, 0, 0, 0);
  make_dofs(layout);
  make_choices(layout);
  make_buttons(layout);
  return controls;
}

void WorkbenchPanel::make_dofs(QVBoxLayout* layout) {
  dofs_ = new DofControls(this);
  layout->addWidget(dofs_);
  connect(dofs_, &DofControls::switched, this, [this] { ask<SetForkDofs>("set_dofs", dofs_->dofs()); });
  connect(dofs_, &DofControls::stiffness_moved, this, [this](int i) {
    services_.call<SetForkStiffness>("stiffness " + std::to_string(i), node_.of_node("set_stiffness"),
                                     dofs_->stiffness(i));
  });
  connect(dofs_, &DofControls::damping_moved, this,
          [this] { services_.call<SetForkDamping>("damping", node_.of_node("set_damping"), dofs_->damping()); });
}

void WorkbenchPanel::make_choices(QVBoxLayout* layout) {
  auto* grid = new QGridLayout;
  integrator_ = choice_of(validation::names<dynamics::IntegratorKind>(), this);
  tool_ = choice_of(validation::names<tools::Tool>(), this);
  held_ = new QLabel(this);
  held_->setSizePolicy(QSizePolicy::Ignored,
                       QSizePolicy::Preferred);  // the width of the panel does not depend on the held object
  scene_ = new QLineEdit("package://spring_workbench/scenes/mini_world.urdf", this);
  auto* load = new QPushButton("Load", this);
  grid->addWidget(new QLabel("Integrator", this), 0, 0);
  grid->addWidget(integrator_, 0, 1, 1, 2);
  grid->addWidget(new QLabel("Tool", this), 1, 0);
  grid->addWidget(tool_, 1, 1);
  grid->addWidget(held_, 1, 2);
  grid->addWidget(new QLabel("Scene", this), 2, 0);
  grid->addWidget(scene_, 2, 1);
  grid->addWidget(load, 2, 2);
  layout->addLayout(grid);
  connect(integrator_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    SetIntegrator::Request request;
    request.name = integrator_->currentText().toStdString();
    request.tolerance = SetIntegrator::Request::KEEP_TOLERANCE;
    ask<SetIntegrator>("set_integrator", request);
  });
  connect(tool_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    SelectTool::Request request;
    request.tool = tool_->currentText().toStdString();
    ask<SelectTool>("select_tool", request);
  });
  connect(load, &QPushButton::clicked, this, [this] {
    LoadScene::Request request;
    request.scene = scene_->text().toStdString();
    services_.call<LoadScene>("load_scene", node_.of_node("load_scene"), request);
  });
}

void WorkbenchPanel::make_buttons(QVBoxLayout* layout) {
  auto* row = new QHBoxLayout;
  const auto add = [&](const char* name, auto of_service) {
    using Service = decltype(of_service);
    auto* button = new QPushButton(name, this);
    row->addWidget(button);
    const std::string service = QString(name).toLower().toStdString();
    connect(button, &QPushButton::clicked, this,
            [this, service] { services_.call<Service>(service, node_.of_node(service), typename Service::Request()); });
  };
  add("Calibrate", Calibrate());
  add("Reset", std_srvs::Trigger());
  add("Release", Release());
  layout->addLayout(row);
  grasp_ = new QCheckBox("Grasp (mouse)", this);
  grasp_->setToolTip("the grasp button of the stylus that the mouse moves");
  layout->addWidget(grasp_);
  connect(grasp_, &QCheckBox::clicked, this, [this](bool on) {
    std_srvs::SetBool::Request request;
    request.data = on ? 1 : 0;
    free_at_ = panel_time() + settling;
    services_.call<std_srvs::SetBool>("grasp", node_.in_namespace("tracker_driver/grasp"), request);
  });
  auto* clutch = new QCheckBox("Clutch", this);
  clutch->setToolTip("on: the hand moves without its tool");
  layout->addWidget(clutch);
  connect(clutch, &QCheckBox::clicked, this, [this](bool on) {
    SetClutch::Request request;
    request.on = on ? 1 : 0;
    services_.call<SetClutch>("clutch", node_.of_node("clutch"), request);
  });
}

void WorkbenchPanel::onInitialize() {
  subscribe();
  shared_master_watch();
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &WorkbenchPanel::refresh);
  timer->start(100);
}

void WorkbenchPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  if (QString node; config.mapGetString("Node", &node)) follow(node);
}

void WorkbenchPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Node", QString::fromStdString(node_.text()));
}

void WorkbenchPanel::follow(const QString& node) {
  if (node.toStdString() == node_.text()) return;
  try {
    node_ = ros_common::NodeName(node.toStdString());
    subscribe();
    Q_EMIT configChanged();
  } catch (const validation::InputError& error) {
    node_field_->setText(QString::fromStdString(node_.text()));
    answer_->setText(error.what());
  }
}

void WorkbenchPanel::subscribe() {
  ros::NodeHandle handle;
  subscriptions_.end();
  subscriptions_.add<ForkState>(handle, node_.of_node("fork"), 1, [this](const auto& message) { on_fork(message); });
  subscriptions_.add<StepReport>(handle, node_.of_node("steps"), 200,
                                 [this](const auto& message) { figures_->add(panel_time(), message); });
  subscriptions_.add<sensor_msgs::Joy>(handle, node_.in_namespace("stylus/joy"), 1,
                                       [this](const auto& message) { on_joy(message); });
  node_field_->setText(QString::fromStdString(node_.text()));
  fork_received_ = -1e9;
  show_silence();
}

void WorkbenchPanel::on_fork(const ForkStateConstPtr& message) {
  fork_ = message;
  fork_received_ = panel_time();
}

void WorkbenchPanel::on_joy(const sensor_msgs::JoyConstPtr& message) {
  if (!message->buttons.empty() && panel_time() > free_at_) grasp_->setChecked(message->buttons[0] != 0);
}

void WorkbenchPanel::refresh() {
  const double now = panel_time();
  const bool alive = now - fork_received_ < longest_silence;
  if (!alive && (controls_->isEnabled() || fork_)) show_silence();
  if (alive && !controls_->isEnabled()) {
    controls_->setEnabled(true);
    answer_->clear();
  }
  if (!alive) figures_->clear();
  if (fork_) show_fork();
  figures_->refresh(now);
}

void WorkbenchPanel::show_silence() {
  fork_.reset();
  controls_->setEnabled(false);
  answer_->setText(QString::fromStdString("no data from " + node_.text() + ": is it running?"));
}

void WorkbenchPanel::show_fork() {
  const ForkState& fork = *fork_;
  dofs_->show_sliders(fork);
  held_->setText(QString::fromStdString(fork.held_object.empty() ? fork.touched : fork.held_object));
  if (panel_time() < free_at_ || integrator_->view()->isVisible() || tool_->view()->isVisible()) return;
  dofs_->show_switches(fork);
  integrator_->setCurrentText(QString::fromStdString(fork.integrator));
  tool_->setCurrentText(QString::fromStdString(fork.tool));
}

}  // namespace spring_workbench::rviz_plugin

PLUGINLIB_EXPORT_CLASS(spring_workbench::rviz_plugin::WorkbenchPanel, rviz::Panel)

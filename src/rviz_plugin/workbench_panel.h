#pragma once

#ifndef Q_MOC_RUN
#include <rviz/panel.h>
#include <sensor_msgs/Joy.h>

#include <memory>

#include "spring_workbench/ForkState.h"
#include "spring_workbench/StepReport.h"
#include "spring_workbench/ros/common/node_name.h"
#include "spring_workbench/ros/common/service_caller.h"
#include "spring_workbench/ros/common/subscriptions.h"
#endif

class QCheckBox;
class QComboBox;
class QLabel;
class QLayout;
class QLineEdit;
class QPushButton;
class QVBoxLayout;

namespace spring_workbench::rviz_plugin {

class DofControls;
class StepFigures;

/// Tunes the fork of a node `manipulation` of any name and namespace while it is in use. The name is part of rviz'
/// configuration; the tracker is the one in the namespace of the node. Shows only what `~fork` and `~steps` report;
/// each change by the user is a service call. Greyed out while the node is silent.
class WorkbenchPanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit WorkbenchPanel(QWidget* parent = nullptr);
  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 Q_SIGNALS:
  /// Reports the result of a service call in one line; from any thread.
  void answered(const QString& text);

 private:
  QLayout* make_node();
  QWidget* make_controls();
  void make_dofs(QVBoxLayout* layout);
  void make_choices(QVBoxLayout* layout);
  void make_buttons(QVBoxLayout* layout);

  /// Shows and controls the node of this name. What cannot be one is reported, and changes nothing.
  void follow(const QString& node);
  void subscribe();

  void on_fork(const ForkStateConstPtr& message);
  void on_joy(const sensor_msgs::JoyConstPtr& message);
  void refresh();
  void show_silence();
  void show_fork();

  template <typename Service>  // switches and choices wait for its effect
  void ask(const std::string& service, const typename Service::Request& request);

  ros_common::NodeName node_{"manipulation"};
  ForkStateConstPtr fork_;
  double fork_received_ = -1e9;  ///< [s]
  double free_at_ = 0.0;         ///< time from which switches and choices follow the node again [s]

  QWidget* controls_;
  DofControls* dofs_ = nullptr;
  QComboBox *integrator_ = nullptr, *tool_ = nullptr;
  QCheckBox* grasp_ = nullptr;
  QLineEdit *node_field_ = nullptr, *scene_ = nullptr;
  QLabel *held_ = nullptr, *answer_ = nullptr;
  StepFigures* figures_;
  ros_common::Subscriptions subscriptions_;
  ros_common::ServiceCaller services_;
};

}  // namespace spring_workbench::rviz_plugin

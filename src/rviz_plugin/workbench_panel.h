#pragma once

#ifndef Q_MOC_RUN
#include <ros/subscriber.h>
#include <rviz/panel.h>
#include <sensor_msgs/Joy.h>

#include <memory>

#include "service_caller.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/StepReport.h"
#endif

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QVBoxLayout;

namespace spring_workbench::rviz_plugin {

class DofControls;
class StepFigures;

/// Tunes the fork of the node `manipulation` while it is in use. Shows only what `~fork` and `~steps` report; each
/// change by the user is a service call. Greyed out while the node is silent.
class WorkbenchPanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit WorkbenchPanel(QWidget* parent = nullptr);
  void onInitialize() override;

 Q_SIGNALS:
  /// Reports the result of a service call in one line; from any thread.
  void answered(const QString& text);

 private:
  QWidget* make_controls();
  void make_dofs(QVBoxLayout* layout);
  void make_choices(QVBoxLayout* layout);
  void make_buttons(QVBoxLayout* layout);

  void on_fork(const ForkStateConstPtr& message);
  void on_steps(const StepReportConstPtr& message);
  void on_joy(const sensor_msgs::JoyConstPtr& message);
  void refresh();
  void show_fork();

  template <typename Service>  // switches and choices wait for its effect
  void ask(const std::string& service, const typename Service::Request& request);

  ros::Subscriber fork_subscriber_, steps_subscriber_, joy_subscriber_;
  ForkStateConstPtr fork_;
  double fork_received_ = -1e9;  ///< [s]
  double free_at_ = 0.0;         ///< time from which switches and choices follow the node again [s]

  QWidget* controls_;
  DofControls* dofs_ = nullptr;
  QComboBox *integrator_ = nullptr, *tool_ = nullptr;
  QCheckBox* grasp_ = nullptr;
  QLineEdit* scene_ = nullptr;
  QLabel *held_ = nullptr, *answer_ = nullptr;
  StepFigures* figures_;
  ServiceCaller services_;
};

}  // namespace spring_workbench::rviz_plugin

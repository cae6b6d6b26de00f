#pragma once

#ifndef Q_MOC_RUN
#include <rviz/view_controller.h>

#include <string>

#include "spring_workbench/motion/head_motion.h"
#endif

namespace rviz {
class FloatProperty;
class TfFrameProperty;
}  // namespace rviz

namespace spring_workbench::rviz_plugin {

/// The view from a tracked head: the camera is in the frame `head`, looking along its x axis, z up; predicted, if a
/// latency is given. Stays where it is while the frame is not there.
class HeadViewController : public rviz::ViewController {
  Q_OBJECT
 public:
  HeadViewController();

  void update(float dt, float ros_dt) override;
  void reset() override {}

 protected:
  void onInitialize() override;

 private:
  rviz::TfFrameProperty* frame_;
  rviz::FloatProperty* latency_;
  std::string followed_;  ///< frame and fixed frame
  motion::HeadMotion motion_;
};

}  // namespace spring_workbench::rviz_plugin

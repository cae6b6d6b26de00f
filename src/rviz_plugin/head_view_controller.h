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

/// The view from a tracked head: the camera is at the frame `head`, looking along its x axis with z up. The head's
/// motion is predicted if a latency is set. The view stays in place while the frame is missing.
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
  std::string followed_;  ///< name of the frame followed, and of the fixed frame
  motion::HeadMotion motion_;
};

}  // namespace spring_workbench::rviz_plugin

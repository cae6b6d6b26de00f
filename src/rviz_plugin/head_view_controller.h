#pragma once

#ifndef Q_MOC_RUN
#include <rviz/view_controller.h>
#endif

namespace rviz {
class TfFrameProperty;
}

namespace spring_workbench::rviz_plugin {

/// The view from the tracked head: the camera is in the frame `head`, looking along its x axis, z up. Stays where it is
/// while the frame is not there.
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
};

}  // namespace spring_workbench::rviz_plugin

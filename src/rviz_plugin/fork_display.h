#pragma once

#ifndef Q_MOC_RUN
#include <rviz/display.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drawn_fork.h"
#include "shared_master_watch.h"
#include "spring_workbench/ros/common/subscriptions.h"
#endif

namespace rviz {
class RosTopicProperty;
}  // namespace rviz

namespace spring_workbench::rviz_plugin {

/// Draws the forks of all styluses, at most once per frame of rviz: those on its topic and on the topics with the
/// suffixes _2, _3 and so on that the master knows. A fork is hidden if no message for it has arrived for two seconds.
class ForkDisplay : public rviz::Display {
  Q_OBJECT
 public:
  ForkDisplay();
  ~ForkDisplay() override { forks_.clear(); }

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

 protected:
  void onInitialize() override { shared_master_watch(); }
  void onEnable() override { subscribe(); }
  void onDisable() override { forks_.clear(); }

 private:
  struct Fork {
    Fork(Ogre::SceneManager* manager, Ogre::SceneNode* parent) : drawn(manager, parent) {}
    DrawnFork drawn;
    ForkStateConstPtr newest;  ///< not drawn yet
    double silence = 0.0;      ///< time since the newest message [s]
    ros_common::Subscriptions subscription;
  };
  Q_SLOT void subscribe();
  void listen(const std::string& topic);
  void listen_to_all();
  void draw(Fork& fork);

  rviz::RosTopicProperty* topic_;
  std::map<std::string, Fork> forks_;                                   ///< by topic
  std::shared_ptr<const ros_common::MasterWatch::Answer> last_answer_;  ///< the answer whose topics are subscribed to
};

}  // namespace spring_workbench::rviz_plugin

#include "spring_workbench/ros/common/background_log.h"

#include <log4cxx/asyncappender.h>
#include <log4cxx/logger.h>
#include <poll.h>
#include <ros/console.h>
#include <ros/rosout_appender.h>
#include <unistd.h>

namespace spring_workbench::ros_common {

void log_in_background() {
  ROSCONSOLE_AUTOINIT;                                       // adds the appender that writes to the terminal
  ros::console::register_appender(new ros::ROSOutAppender);  // its queue uses it until the program exits
  const log4cxx::LoggerPtr logger = log4cxx::Logger::getLogger(ROSCONSOLE_ROOT_LOGGER_NAME);
  const log4cxx::AppenderList appenders = logger->getAllAppenders();
  logger->removeAllAppenders();
  for (const log4cxx::AppenderPtr& appender : appenders) {
    const log4cxx::AsyncAppenderPtr queue(new log4cxx::AsyncAppender);
    queue->setBlocking(false);
    queue->addAppender(appender);
    logger->addAppender(queue);
  }
}

bool error_output_takes_more() {
  pollfd output{STDERR_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) == 1;
}

}  // namespace spring_workbench::ros_common

#include "spring_workbench/ros/common/exit_after_timeout.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <utility>

#include "constants.h"
#include "spring_workbench/ros/common/background_log.h"

namespace spring_workbench::ros_common {

void exit_after_timeout(std::function<bool()> ends, int status) {
  exit_after_timeout(std::move(ends), status, shutdown_timeout);
}

void exit_after_timeout(std::function<bool()> ends, int status, double timeout) {
  std::thread([ends = std::move(ends), status, timeout] {
    while (!ends()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::this_thread::sleep_for(std::chrono::duration<double>(timeout));
    if (error_output_takes_more()) {
      std::cerr << "shutdown has taken longer than " << timeout
                << " s, probably because the ROS master does not answer; exiting now" << std::endl;
    }
    std::_Exit(status);
  }).detach();
}

}  // namespace spring_workbench::ros_common

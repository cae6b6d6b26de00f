#include "spring_workbench/assembly/task_score.h"

#include <locale>
#include <sstream>

namespace spring_workbench::assembly {

std::string score_csv_header() {
  return "placed,targets,time_s,hand_path_m,object_path_m,grasps,collisions,drops,broken,largest_force_N,position_"
         "error_m,"
         "angle_error_rad";
}

std::string score_csv(const TaskScore& s) {
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line.precision(9);
  line << s.placed << ',' << s.targets << ',' << s.time << ',' << s.hand_path << ',' << s.object_path << ',' << s.grasps
       << ',' << s.collisions << ',' << s.drops << ',' << s.broken << ',' << s.largest_force << ',' << s.position_error
       << ',' << s.angle_error;
  return line.str();
}

}  // namespace spring_workbench::assembly

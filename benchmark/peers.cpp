#include "benchmark/peers.h"

#include <algorithm>
#include <iterator>

namespace spring_workbench::benchmark {
namespace {

template <typename Peer>
void append(std::vector<Peer> more, std::vector<Peer>& peers) {
  peers.insert(peers.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

Peers all_peers() {
  Peers peers;
  append(hand_written_peers(), peers.methods);
  append(cvode_peers(), peers.methods);
  append(solver_peers(), peers.methods);
  peers.found.push_back("CVODE and ARKODE " SPRING_WORKBENCH_CVODE_VERSION);
#ifdef SPRING_WORKBENCH_BULLET_VERSION
  append(bullet_peers(), peers.methods);
  append(bullet_rods(), peers.rods);
  append(bullet_drags(), peers.drags);
  append(bullet_boxes(), peers.boxes);
  peers.found.push_back("Bullet " SPRING_WORKBENCH_BULLET_VERSION);
#else
  peers.not_found.push_back("Bullet in double precision (libbullet-dev)");
#endif
#ifdef SPRING_WORKBENCH_MUJOCO_VERSION
  append(mujoco_peers(), peers.methods);
  append(mujoco_rods(), peers.rods);
  append(mujoco_drags(), peers.drags);
  append(mujoco_boxes(), peers.boxes);
  peers.found.push_back("MuJoCo " SPRING_WORKBENCH_MUJOCO_VERSION);
  const auto is_implicitfast = [](const MethodPtr& method) { return method->name() == "mujoco_joints_implicitfast"; };
  if (std::none_of(peers.methods.begin(), peers.methods.end(), is_implicitfast))
    peers.not_found.push_back("MuJoCo's implicitfast (MuJoCo 2.3.3 or later)");
#else
  peers.not_found.push_back("MuJoCo (libmujoco-dev)");
#endif
#ifdef SPRING_WORKBENCH_ODE_VERSION
  append(ode_peers(), peers.methods);
  append(ode_rods(), peers.rods);
  append(ode_drags(), peers.drags);
  append(ode_boxes(), peers.boxes);
  peers.found.push_back("ODE " SPRING_WORKBENCH_ODE_VERSION);
#else
  peers.not_found.push_back("ODE (libode-dev)");
#endif
#ifdef SPRING_WORKBENCH_DART_VERSION
  append(dart_peers(), peers.methods);
  append(dart_rods(), peers.rods);
  append(dart_drags(), peers.drags);
  peers.found.push_back("DART " SPRING_WORKBENCH_DART_VERSION);
#else
  peers.not_found.push_back("DART (libdart-dev)");
#endif
  return peers;
}

}  // namespace spring_workbench::benchmark

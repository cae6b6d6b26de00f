#include <iostream>

#include "benchmark/contact/wild_motions.h"
using namespace spring_workbench;
using namespace spring_workbench::benchmark;
int main(int argc, char** argv) {
  const unsigned n = static_cast<unsigned>(std::stoi(argv[1]));
  for (ContactMode mode : {ContactMode::stop, ContactMode::dynamic})
    for (WildScene s : wild_scenes()) {
      if (argc > 2 && std::string(argv[2]).find(name_of(s)) == std::string::npos) continue;
      if (argc > 3 && (mode == ContactMode::stop) != (std::string(argv[3]) == "stop")) continue;
      double worst = 0, sec = 0; int passed = 0, over = 0, guards = 0, steps = 0, thrown = 0; unsigned wseed = 0; double slowest=0;
      for (unsigned i = 0; i < n; ++i) {
        try {
        WildResult r = run({s, mode, i});
        if (r.penetration > worst) worst = r.penetration, wseed = i;
        passed += r.passed_through; over += r.penetration > 1e-4; sec += r.seconds; guards += r.guards_tripped; steps += r.steps;
        slowest = std::max(slowest, r.seconds);
        } catch (const std::exception& e) { if (!thrown++) std::cout << i << e.what() << "\n"; }
      }
      std::cout << (mode == ContactMode::stop ? "stop " : "dynamic ") << name_of(s) << " worst " << worst * 1e3 << " mm (seed " << wseed
                << ") over " << over << " passed " << passed << " of " << n << " guards " << guards << " steps " << steps << " s " << sec << " slowest " << slowest << " thrown " << thrown << std::endl;
    }
}

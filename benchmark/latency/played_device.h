#pragma once

#include <functional>
#include <vector>

#include "spring_workbench/simulated_fastrak/fastrak_simulator.h"

namespace spring_workbench::benchmark {

/// Where something was along x, and when.
struct Moment {
  double t = 0.0;  ///< by the steady clock [s]
  double x = 0.0;  ///< [m]
};

double steady_now();  ///< [s]

/// From and to when a motion goes evenly along x, and how long it is played, all in its own time [s].
struct Playing {
  double rate = 120.0;  ///< records of each station per second [Hz]
  int stations = 1;     ///< in use; they measure in turn
  int counted = 1;      ///< the station whose records are; may be set until `ready` says so
  double begin = 0.0, end = 0.0, until = 0.0;
};

/// Plays the device in real time, in which station 1 has `motion`; first it is served until `ready` says so. Gives the
/// moments at which records of the moving station `counted` were written.
std::vector<Moment> play(simulated_fastrak::FastrakSimulator& simulator, const simulated_fastrak::PlayedMotion& motion,
                         const Playing& playing, const std::function<bool()>& ready);

/// From each record to the first of those moments seen that have gone as far for good [s], in ascending order.
/// `offset`: how far what is seen is from the hand along x [m]. Throws std::runtime_error where hardly any record was
/// seen.
std::vector<double> latencies(const std::vector<Moment>& written, std::vector<Moment> seen, double offset);

/// Of values in ascending order, the one that `part` (0 … 1) of them do not exceed.
double quantile(const std::vector<double>& sorted, double part);

}  // namespace spring_workbench::benchmark

#pragma once

#include <functional>
#include <vector>

#include "spring_workbench/simulated_fastrak/fastrak_simulator.h"

namespace spring_workbench::benchmark {

/// Position along x at one time.
struct Moment {
  double t = 0.0;  ///< steady clock [s]
  double x = 0.0;  ///< [m]
};

double steady_now();  ///< [s]

/// When a motion moves along x at constant speed, and how long it is played, all in its own time [s].
struct Playing {
  double rate = 120.0;  ///< records of each station per second [Hz]
  int stations = 1;     ///< number of stations in use, which measure in turn
  int counted = 1;      ///< the station whose records are counted; may be set until `ready` returns true
  double begin = 0.0, end = 0.0, until = 0.0;
};

/// Serves the device until `ready` returns true, then plays `motion` on station 1 in real time. Returns the moments at
/// which records of the station `counted` were written.
std::vector<Moment> play(simulated_fastrak::FastrakSimulator& simulator, const simulated_fastrak::PlayedMotion& motion,
                         const Playing& playing, const std::function<bool()>& ready);

/// Time from each record to the first observed moment from which the position stays at least as far [s], in ascending
/// order. `offset`: distance of the observed point from the hand along x [m]. Throws std::runtime_error if hardly any
/// record was observed.
std::vector<double> latencies(const std::vector<Moment>& written, std::vector<Moment> observed, double offset);

/// Quantile of sorted values: the value that the fraction `part` (0 … 1) of them do not exceed.
double quantile(const std::vector<double>& sorted, double part);

}  // namespace spring_workbench::benchmark

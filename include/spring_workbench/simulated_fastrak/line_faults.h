#pragma once

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace spring_workbench::simulated_fastrak {

/// One thing that goes wrong on the line or in the device, from `from` to before `until` [s].
struct Fault {
  enum class Kind {
    garbage,     ///< random bytes before, in or after a record
    cut,         ///< a stretch of a record is missing
    silence,     ///< nothing passes in either direction, as with a pulled plug on the device's side
    error,       ///< error letters, and error records between the data
    wrong_mode,  ///< at `from`: the device streams in another format and other units
    unplug       ///< the port is gone, as with a pulled USB adaptor; it comes back with the device as at power-on
  };
  Kind kind = Kind::garbage;
  double rate = 1.0;  ///< part of the records that are hit, 0 … 1: of garbage, cut, error
  double from = 0.0;
  double until = std::numeric_limits<double>::infinity();
};

/// Reads `KIND[,rate=R][,from=S][,until=S]`. Throws InputError.
Fault parse_fault(const std::string& text);

/// The faults of one run; the same seed and records give bit-identical output.
class LineFaults {
 public:
  explicit LineFaults(std::vector<Fault> faults = {}, unsigned seed = 1);

  /// What arrives of what was sent at time `t` [s].
  std::string pass(std::string record, double t);

  bool active(Fault::Kind kind, double t) const;

  /// Whether the device changes its mode in (`before`, `t`].
  bool mode_changes(double before, double t) const;

 private:
  bool hits(double rate);
  std::size_t number(std::size_t least, std::size_t most);
  std::string noise(std::size_t size);
  void spoil(std::string& record);
  void shorten(std::string& record);
  void report_error(std::string& record);

  std::vector<Fault> faults_;
  std::mt19937 random_;
};

}  // namespace spring_workbench::simulated_fastrak

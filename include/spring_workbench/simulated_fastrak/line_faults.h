#pragma once

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace spring_workbench::simulated_fastrak {

/// A fault on the line or in the device that is active for `from` ≤ t < `until` [s].
struct Fault {
  enum class Kind {
    garbage,     ///< random bytes before, in or after a record
    cut,         ///< part of a record is missing
    silence,     ///< nothing passes in either direction, as if the device's plug were pulled
    error,       ///< error letters in records, and error records between the data
    wrong_mode,  ///< at `from`: the device streams in another format and other units
    unplug  ///< the port disappears, as if the USB adapter were pulled, and comes back with the device in its power-on
            ///< state
  };
  Kind kind = Kind::garbage;
  double rate = 1.0;  ///< fraction of the records that are affected, 0 … 1; for garbage, cut and error
  double from = 0.0;
  double until = std::numeric_limits<double>::infinity();
};

/// Reads `KIND[,rate=R][,from=S][,until=S]`. Throws InputError.
Fault parse_fault(const std::string& text);

/// The faults of one run. The same seed and records give bit-identical output.
class LineFaults {
 public:
  explicit LineFaults(std::vector<Fault> faults = {}, unsigned seed = 1);

  /// Returns what arrives of a record that was sent at time `t` [s].
  std::string pass(std::string record, double t);

  bool active(Fault::Kind kind, double t) const;

  /// Whether a `wrong_mode` fault begins in (`before`, `t`] [s].
  bool mode_changes(double before, double t) const;

 private:
  bool hits(double rate);
  std::size_t random_number(std::size_t min, std::size_t max);
  std::string noise(std::size_t size);
  void corrupt(std::string& record);
  void truncate(std::string& record);
  void report_error(std::string& record);

  std::vector<Fault> faults_;
  std::mt19937 random_;
};

}  // namespace spring_workbench::simulated_fastrak

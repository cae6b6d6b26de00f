#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// The states of a simulation's movable objects at one moment, as a value. It consists of blocks of 32 objects, and
/// unchanged blocks are shared with earlier values. So the cost of an update depends only on what has changed, and a
/// reader can skip the blocks that it already knows.
class SharedStates {
 public:
  using Part = std::vector<bodies::BodyState>;
  using Parts = std::vector<std::shared_ptr<const Part>>;

  /// Copies what has changed in the simulation since the last call.
  void update_from(const simulation::Simulation& simulation);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const bodies::BodyState& operator[](std::size_t object) const {
    return (*parts()[object / part_size])[object % part_size];
  }
  /// All parts but the last have the same number of objects.
  const Parts& parts() const { return *parts_; }
  /// Whether a part is shared with `other`, so that nothing in it differs.
  bool shares(std::size_t part, const SharedStates& other) const {
    return part < other.parts().size() && parts()[part] == other.parts()[part];
  }
  /// Index of the first object of a part.
  static std::size_t begin_of(std::size_t part) { return part * part_size; }
  /// Index of the part that contains an object.
  static std::size_t part_of(std::size_t object) { return object / part_size; }

  class Iterator {
   public:
    Iterator(const SharedStates& of, std::size_t object) : of_(&of), object_(object) {}
    const bodies::BodyState& operator*() const { return (*of_)[object_]; }
    const bodies::BodyState* operator->() const { return &(*of_)[object_]; }
    Iterator& operator++() {
      ++object_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return object_ != other.object_; }

   private:
    const SharedStates* of_;
    std::size_t object_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }

 private:
  enum : std::size_t { part_size = 32 };

  std::shared_ptr<const Parts> parts_ = std::make_shared<Parts>();  ///< shared by copies
  std::size_t size_ = 0;
  bodies::ChangeLog::Revision at_;  ///< moment of the simulation up to which it follows
};

}  // namespace spring_workbench::live

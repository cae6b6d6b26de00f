#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace spring_workbench::live {

/// Bounded queue of input, first in, first out, for one consumer. Its limit `capacity` keeps a stalled consumer from
/// exhausting memory.
template <typename T>
class Inbox {
 public:
  explicit Inbox(std::size_t capacity) : capacity_(capacity) {}
  /// Whether the limit is reached. If so, the caller must reject input instead of calling put().
  bool is_full() const { return kept_.size() >= capacity_; }
  void put(T one) { kept_.push_back(std::move(one)); }
  /// Removes and returns all items.
  std::vector<T> take() { return std::exchange(kept_, {}); }

 private:
  std::size_t capacity_;
  std::vector<T> kept_;
};

}  // namespace spring_workbench::live

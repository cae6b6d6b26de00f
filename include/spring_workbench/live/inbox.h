#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace spring_workbench::live {

/// What came and was not taken yet, in order, and no more than `most`: a loop that stands does not fill the memory.
template <typename T>
class Inbox {
 public:
  explicit Inbox(std::size_t most) : most_(most) {}
  /// Whether something has to be refused before more is put in.
  bool is_full() const { return kept_.size() >= most_; }
  void put(T one) { kept_.push_back(std::move(one)); }
  /// Returns all.
  std::vector<T> take() { return std::exchange(kept_, {}); }

 private:
  std::size_t most_;
  std::vector<T> kept_;
};

}  // namespace spring_workbench::live

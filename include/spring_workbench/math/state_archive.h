#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "spring_workbench/math/pack.h"

namespace spring_workbench::math {

/// Saves or restores the numbers of a state, always in the same order. A class lists the members that a step changes
/// in one function, `archive(StateArchive& state) { state(a_, b_); }`. This function both saves and restores, like
/// `serialize` of Boost. An archive contains only numbers: no pointer, no padding, no capacity.
class StateArchive {
 public:
  using Words = std::vector<std::uint64_t>;  ///< one word per number, with the bits of a double, integer or enumerator

  /// Makes an archive that saves the numbers of a state, about as many as `expected`.
  explicit StateArchive(std::size_t expected = 0) { words_.reserve(expected); }
  /// Makes an archive that restores the numbers of a state from `words`, which must outlive the archive.
  explicit StateArchive(const Words& words) : source_(&words) {}

  bool is_restoring() const { return source_ != nullptr; }  ///< whether it restores a state; otherwise it saves one
  const Words& words() const& { return words_; }            ///< the numbers that were saved
  Words words() && { return std::move(words_); }            ///< the numbers that were saved, moved out
  /// Whether no word is left to restore from.
  bool at_end() const { return source_ == nullptr || next_ == source_->size(); }

  /// Saves or restores the next values of the state. Throws std::out_of_range if there are too few words.
  template <typename... Values>
  void operator()(Values&... values) {
    (archive(values), ...);
  }

  /// Saves or restores the size of a container with at least one word per element; `present` is its present size.
  /// Returns the size. Throws std::out_of_range if fewer words are left.
  std::size_t archive_size(std::size_t present) {
    archive(present);
    if (is_restoring() && present > source_->size() - next_) throw std::out_of_range("it has too few numbers");
    return present;
  }

 private:
  void archive_word(std::uint64_t& word) {
    if (!is_restoring()) {
      words_.push_back(word);
    } else {
      if (next_ >= source_->size()) throw std::out_of_range("it has too few numbers");
      word = (*source_)[next_++];
    }
  }
  void archive_numbers(double* numbers, Eigen::Index count) {
    static_assert(sizeof(double) == sizeof(std::uint64_t));
    const auto size = static_cast<std::size_t>(count);
    if (size == 0) return;
    if (!is_restoring()) {
      words_.resize(words_.size() + size);
      std::memcpy(&words_[words_.size() - size], numbers, size * sizeof(double));
    } else {
      if (size > source_->size() - next_) throw std::out_of_range("it has too few numbers");
      std::memcpy(numbers, &(*source_)[next_], size * sizeof(double));
      next_ += size;
    }
  }

  template <typename T>
  void archive(T& value) {
    if constexpr (std::is_same_v<T, double>) {
      std::uint64_t word = 0;
      std::memcpy(&word, &value, sizeof word);
      archive_word(word);
      std::memcpy(&value, &word, sizeof word);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      auto word = static_cast<std::uint64_t>(value);
      archive_word(word);
      value = static_cast<T>(word);
    } else if constexpr (std::is_base_of_v<Eigen::EigenBase<T>, T>) {
      Eigen::Index rows = value.rows(), columns = value.cols();
      if constexpr (T::SizeAtCompileTime == Eigen::Dynamic) {
        archive(rows);
        archive(columns);
        if (is_restoring() && !fits<T>(rows, columns)) throw std::out_of_range("a matrix has another size");
        value.resize(rows, columns);
      }
      archive_numbers(value.data(), rows * columns);
    } else if constexpr (has_member<T>(nullptr)) {
      value.archive(*this);
    } else {
      archive_state(*this, value);  // next to the type
    }
  }
  template <typename T>
  static constexpr auto has_member(T* value) -> decltype(value->archive(std::declval<StateArchive&>()), true) {
    return true;
  }
  template <typename>
  static constexpr bool has_member(...) {
    return false;
  }
  template <typename T>
  static bool fits(Eigen::Index rows, Eigen::Index columns) {
    const auto is_allowed = [](Eigen::Index size, int fixed, int max) {
      return fixed == Eigen::Dynamic ? size >= 0 && (max == Eigen::Dynamic || size <= max) : size == fixed;
    };
    return is_allowed(rows, T::RowsAtCompileTime, T::MaxRowsAtCompileTime) &&
           is_allowed(columns, T::ColsAtCompileTime, T::MaxColsAtCompileTime);
  }
  void archive(RigidTransform& X) { archive(X.matrix()); }
  void archive(Twist& V) { (*this)(V.linear, V.angular); }
  void archive(Wrench& F) { (*this)(F.force, F.moment); }
  void archive(Pack& p) { archive_numbers(reinterpret_cast<double*>(&p), pack_size); }
  template <typename T, std::size_t n>
  void archive(std::array<T, n>& list) {
    for (T& value : list) archive(value);
  }
  template <typename T>
  void archive(std::optional<T>& value) {
    bool there = value.has_value();
    archive(there);
    if (there && !value) value.emplace();
    if (!there) value.reset();
    if (there) archive(*value);
  }
  void archive(std::string& text) { archive_list(text); }
  /// A vector, a deque.
  template <template <typename, typename> class List, typename T, typename Allocator>
  void archive(List<T, Allocator>& list) {
    archive_list(list);
  }
  template <typename List>
  void archive_list(List& list) {
    list.resize(archive_size(list.size()));
    for (auto& value : list) archive(value);
  }
  template <typename T>
  void archive(std::set<T>& set) {
    std::vector<T> list(set.begin(), set.end());
    archive(list);
    if (is_restoring()) set = std::set<T>(list.begin(), list.end());
  }
  template <typename Key, typename T>
  void archive(std::map<Key, T>& map) {
    std::vector<Key> keys;
    for (const auto& entry : map) keys.push_back(entry.first);
    archive(keys);
    if (is_restoring()) map.clear();
    for (const Key& key : keys) archive(map[key]);
  }

  Words words_;
  const Words* source_ = nullptr;
  std::size_t next_ = 0;
};

/// Returns the FNV-1a hash of the words' bytes, lowest byte first. It is the same on every machine.
inline std::uint64_t hash(const StateArchive::Words& words) {
  std::uint64_t h = 14695981039346656037u;
  for (const std::uint64_t word : words) {
    for (int shift = 0; shift < 64; shift += 8) h = (h ^ ((word >> shift) & 0xff)) * 1099511628211u;
  }
  return h;
}

/// Returns a word or a hash as 16 hexadecimal digits.
std::string to_hex(std::uint64_t word);
/// Returns the words whose digits by to_hex(), one word after the other, are `text`. Returns nothing for any other
/// text.
std::optional<StateArchive::Words> words_of_hex(const std::string& text);

}  // namespace spring_workbench::math

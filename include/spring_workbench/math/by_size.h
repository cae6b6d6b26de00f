#pragma once

#include <type_traits>
#include <utility>

namespace spring_workbench::math {

/// Calls `of(std::integral_constant<int, size>())` for a size of 1 … `max_size` that is known at run time only, and
/// returns its result; for any other size, a default value of this type.
template <int max_size = 6, typename Of>
auto by_size(int size, const Of& of) -> decltype(of(std::integral_constant<int, 1>())) {
  if (size == max_size) return of(std::integral_constant<int, max_size>());
  if constexpr (max_size > 1) return by_size<max_size - 1>(size, of);
  return decltype(of(std::integral_constant<int, 1>()))();
}

}  // namespace spring_workbench::math

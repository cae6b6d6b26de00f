#pragma once

#include <type_traits>
#include <utility>

namespace spring_workbench::math {

/// Calls `of(std::integral_constant<int, size>())` for a size of 1 … `most` that is known at run time only, and returns
/// its result; for any other size, a default value of this type.
template <int most = 6, typename Of>
auto by_size(int size, const Of& of) -> decltype(of(std::integral_constant<int, 1>())) {
  if (size == most) return of(std::integral_constant<int, most>());
  if constexpr (most > 1) return by_size<most - 1>(size, of);
  return decltype(of(std::integral_constant<int, 1>()))();
}

}  // namespace spring_workbench::math

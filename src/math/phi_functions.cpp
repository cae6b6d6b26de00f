#include "spring_workbench/math/phi_functions.h"

namespace spring_workbench {

PhiFunctions phi_functions(std::complex<double> z) {
  PhiFunctions p;
  p.zero = std::exp(z);
  if (std::norm(z) < 1.0) {
    // φ₃ by its series 1/6 + z/24 + z²/120 + …, the others from it upwards without cancellation.
    std::complex<double> sum = 0.0;
    for (int n = 19; n > 3; --n) sum = (sum + 1.0) * z / static_cast<double>(n);
    p.three = (sum + 1.0) / 6.0;
    p.two = p.three * z + 0.5;
    p.one = p.two * z + 1.0;
  } else {
    p.one = (p.zero - 1.0) / z;
    p.two = (p.one - 1.0) / z;
    p.three = (p.two - 0.5) / z;
  }
  return p;
}

}  // namespace spring_workbench

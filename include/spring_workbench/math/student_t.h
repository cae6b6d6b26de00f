#pragma once

namespace spring_workbench::math {

/// Returns the quantile of Student's t distribution with `degrees_of_freedom` > 0 at the probability `p`, 0 < p < 1.
/// With infinitely many degrees of freedom it is that of the standard normal distribution.
double student_t_quantile(double degrees_of_freedom, double p);

}  // namespace spring_workbench::math

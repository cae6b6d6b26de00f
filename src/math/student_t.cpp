// The only source that reads Boost's distributions, which take seconds to compile.
#include "spring_workbench/math/student_t.h"

#include <boost/math/distributions/students_t.hpp>

namespace spring_workbench::math {

double student_t_quantile(double degrees_of_freedom, double p) {
  using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return boost::math::quantile(boost::math::students_t_distribution<double, InDouble>(degrees_of_freedom), p);
}

}  // namespace spring_workbench::math

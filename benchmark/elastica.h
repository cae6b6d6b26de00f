#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Tip of a cantilever under a transverse dead load at its tip: slope [rad], deflection and shortening relative to the
/// length.
struct TipDeflection {
  double slope = 0.0;
  double deflection = 0.0;
  double shortening = 0.0;
};

/// The exact inextensible elastica for `alpha = P L² / EI` > 0, by elliptic integrals. With θ the slope, ψ its value at
/// the tip, k² = (1 + sin ψ)/2 and sin φ = 1/(k √2): √α = K(k) − F(φ, k), w/L = 1 − 2 (E(k) − E(φ, k))/√α,
/// 1 − u/L = √(2 sin ψ / α) (Bisshopp and Drucker 1945).
TipDeflection exact_elastica(double alpha);

/// The static deflection of a shape model with bending alone, by Newton's method on its equation of motion.
TipDeflection shape_deflection(const std::string& shape, double alpha);

/// Error of a shape model at a load: distance of its tip from the exact one, relative to the length.
struct ElasticaRow {
  std::string shape;
  double alpha = 0.0;
  TipDeflection exact, model;
  double tip_error = 0.0;    ///< distance of the tips over the length
  double slope_error = 0.0;  ///< [rad]
};
template <typename Fields>
void each_field(ElasticaRow& r, Fields& fields) {
  fields(r.shape, r.alpha, r.exact.slope, r.exact.deflection, r.exact.shortening, r.model.slope, r.model.deflection,
         r.model.shortening, r.tip_error, r.slope_error);
}
std::vector<ElasticaRow> elastica_table();

/// Cost of one evaluation of the equation of motion with a shape model, all DOFs on [ns].
double evaluation_cost(const std::string& shape);

/// Largest difference of exact_elastica() from the table `elastica.csv` of deflections, shortenings and slopes in
/// `folder`; negative if the file is missing.
double elastica_check(const std::string& folder);

std::string elastica_csv(const std::vector<ElasticaRow>& rows);

}  // namespace spring_workbench::benchmark

#include "spring_workbench/exponential/cluster_functions.h"

namespace spring_workbench::exponential {

Collocation::Weights<ClusterFunction> cluster_weights(const ModalRates::Matrix& z) {
  return Collocation::weights(ClusterFunction{z});
}

}  // namespace spring_workbench::exponential

#include "spring_workbench/rod/shape_model.h"

#include "bushing.h"
#include "spring_workbench/config/yaml_fields.h"
#include "strain_rod.h"

namespace spring_workbench {

const std::vector<std::string>& shape_model_names() {
  static const std::vector<std::string> names = {"constant", "linear", "bushing"};
  return names;
}

bool ShapeModel::rechart(StrainVector&, StrainVector&) const { return false; }

std::shared_ptr<const ShapeModel> make_shape_model(const std::string& name, double length) {
  check_number("fork", "length", length, positive());
  if (name == "constant") return std::make_shared<StrainRod>(name, length, 1);
  if (name == "linear") return std::make_shared<StrainRod>(name, length, 2);
  if (name == "bushing") return std::make_shared<Bushing>(length);
  refuse("fork", "shape", name, "one of " + join(shape_model_names()));
}

}  // namespace spring_workbench

#include "bindings.h"

namespace spring_workbench::python {

namespace py = pybind11;

namespace {

/// E.g. "an array of shape (3, 3)".
std::string shape_of(const Array& array) {
  return "an array of shape " + py::str(py::object(array.attr("shape"))).cast<std::string>();
}

}  // namespace

Array to_array(const RigidTransform& X) {
  Array matrix({4, 4});
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix.mutable_at(row, column) = X.matrix()(row, column);
  }
  return matrix;
}

RigidTransform to_pose(const Array& matrix, const std::string& what) {
  const auto refuse = [&](const std::string& given) {
    throw validation::InputError(what +
                                 ": expected a 4 x 4 array of finite numbers: a rotation, a position [m] and a last "
                                 "row 0 0 0 1, got " +
                                 given);
  };
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4) refuse(shape_of(matrix));
  Eigen::Matrix4d m;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) m(row, column) = matrix.at(row, column);
  }
  if (!m.allFinite()) refuse("NaN or infinity");
  const Matrix3d R = m.topLeftCorner<3, 3>();
  if (!(R.transpose() * R).isIdentity(1e-6) || R.determinant() < 0.0) refuse("a matrix that scales, shears or mirrors");
  if (m.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) refuse("a matrix with another last row");
  RigidTransform X = RigidTransform::Identity();
  X.matrix() = m;
  return X;
}

Array to_array(const Eigen::Ref<const Eigen::VectorXd>& vector) {
  Array array(vector.size());
  for (Eigen::Index i = 0; i < vector.size(); ++i) array.mutable_at(i) = vector[i];
  return array;
}

Array to_array(const Twist& V) {
  Eigen::Matrix<double, 6, 1> both;
  both << V.linear, V.angular;
  return to_array(both);
}

Array to_array(const Wrench& F) {
  Eigen::Matrix<double, 6, 1> both;
  both << F.force, F.moment;
  return to_array(both);
}

Wrench to_wrench(const Array& vector, const std::string& what) {
  if (vector.ndim() != 1 || vector.shape(0) != 6) {
    throw validation::InputError(what + ": expected six numbers: force [N] and moment [N m], got " + shape_of(vector));
  }
  return {Vector3d(vector.at(0), vector.at(1), vector.at(2)), Vector3d(vector.at(3), vector.at(4), vector.at(5))};
}

YAML::Node to_yaml(const py::handle& value, const std::string& key) {
  if (py::isinstance<py::bool_>(value)) return YAML::Node(value.cast<bool>() ? "true" : "false");
  if (py::isinstance<py::str>(value)) return YAML::Node(value.cast<std::string>());
  if (py::isinstance<py::dict>(value)) {
    YAML::Node map(YAML::NodeType::Map);
    for (const auto& [name, entry] : value.cast<py::dict>()) {
      const std::string text = py::str(name);
      map.force_insert(text, to_yaml(entry, key.empty() ? text : key + "." + text));
    }
    return map;
  }
  if (py::hasattr(value, "__float__") || py::hasattr(value, "__index__")) {
    const std::string text = py::str(value);  // every bit: the shortest text that is read as the same number
    if (text == "inf" || text == "-inf" || text == "nan") return YAML::Node(text == "-inf" ? "-.inf" : "." + text);
    return YAML::Node(text);
  }
  if (py::isinstance<py::iterable>(value)) {
    YAML::Node list(YAML::NodeType::Sequence);
    for (const py::handle& entry : value) list.push_back(to_yaml(entry, key));
    return list;
  }
  refuse(key, py::repr(value).cast<std::string>(), "a number, a boolean, a string, a list or a dictionary");
}

}  // namespace spring_workbench::python

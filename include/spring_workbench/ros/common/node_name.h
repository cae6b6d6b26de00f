#pragma once

#include <string>

namespace spring_workbench::ros_common {

/// The name of a node as the user writes it: absolute, or relative to the namespace of this process.
class NodeName {
 public:
  /// Throws InputError unless a node can have that name.
  explicit NodeName(const std::string& name);
  const std::string& text() const { return name_; }
  /// Name of a topic or service of the node itself.
  std::string of_node(const std::string& name) const { return name_ + "/" + name; }
  /// Name in the namespace of the node.
  std::string in_namespace(const std::string& name) const;

 private:
  std::string name_;
};

}  // namespace spring_workbench::ros_common

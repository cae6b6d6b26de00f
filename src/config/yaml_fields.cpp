#include "spring_workbench/config/yaml_fields.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "constants.h"
#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::config {
namespace {

/// The text of a node as written by the user, shortened to one line.
std::string node_text(const YAML::Node& node) {
  if (node.IsNull()) return "";
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out.SetMapFormat(YAML::Flow);
  out << node;
  const std::string text = node.IsScalar() ? node.Scalar() : out.c_str();
  return text.size() <= longest_value ? text : text.substr(0, longest_value) + "…";
}

/// Like IsScalar(), which throws for an undefined node.
bool is_scalar(const YAML::Node& node) { return node.IsDefined() && node.IsScalar(); }

[[noreturn]] void refuse_node(const YAML::Node& node, const std::string& where, const std::string& key,
                              const std::string& rule) {
  if (!node.IsDefined()) validation::refuse_missing(where, key, rule);
  validation::refuse(place(node, where), key, node_text(node), rule);
}

std::vector<double> read_numbers(const YAML::Node& node, const std::string& where, const std::string& key,
                                 std::size_t count, const std::string& rule) {
  std::vector<double> values;
  if (node.IsDefined() && node.IsSequence()) {
    for (const YAML::Node& item : node) {
      double value = 0.0;
      if (!item.IsScalar() || !YAML::convert<double>::decode(item, value)) refuse_node(node, where, key, rule);
      values.push_back(value);
    }
  } else if (is_scalar(node)) {
    std::istringstream in(node.Scalar());
    for (double value = 0.0; in >> value;) values.push_back(value);
    if (!in.eof()) refuse_node(node, where, key, rule);
  }
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (values.size() != count || !finite) refuse_node(node, where, key, rule);
  return values;
}

}  // namespace

std::string place(const YAML::Node& node, const std::string& where) {
  const YAML::Mark mark = node.IsDefined() ? node.Mark() : YAML::Mark::null_mark();
  return mark.is_null() || mark.line < 0 ? where : where + ":" + std::to_string(mark.line + 1);
}

double read_number(const YAML::Node& node, const std::string& where, const std::string& key,
                   const validation::NumberRule& rule) {
  double value = 0.0;
  if (!is_scalar(node) || !YAML::convert<double>::decode(node, value) || !rule.allows(value)) {
    refuse_node(node, where, key, rule.text(value));
  }
  return value;
}

int read_integer(const YAML::Node& node, const std::string& where, const std::string& key, int min, int max) {
  int value = 0;
  if (!is_scalar(node) || !YAML::convert<int>::decode(node, value) || value < min || value > max) {
    refuse_node(node, where, key, "an integer between " + std::to_string(min) + " and " + std::to_string(max));
  }
  return value;
}

bool read_bool(const YAML::Node& node, const std::string& where, const std::string& key) {
  bool value = false;
  if (!is_scalar(node) || !YAML::convert<bool>::decode(node, value)) refuse_node(node, where, key, "true or false");
  return value;
}

std::string read_string(const YAML::Node& node, const std::string& where, const std::string& key) {
  if (!is_scalar(node)) refuse_node(node, where, key, "a string");
  return node.Scalar();
}

std::string read_choice(const YAML::Node& node, const std::string& where, const std::string& key,
                        const std::vector<std::string>& choices) {
  if (!is_scalar(node) || std::find(choices.begin(), choices.end(), node.Scalar()) == choices.end()) {
    refuse_node(node, where, key, "one of " + validation::join(choices));
  }
  return node.Scalar();
}

std::vector<double> read_numbers(const YAML::Node& node, const std::string& where, const std::string& key,
                                 std::size_t count) {
  return read_numbers(node, where, key, count, std::to_string(count) + " finite numbers");
}

RigidTransform read_pose(const YAML::Node& node, const std::string& where, const std::string& key) {
  const std::string rule = "x y z qx qy qz qw (7 finite numbers, with a nonzero quaternion)";
  const std::vector<double> v = read_numbers(node, where, key, 7, rule);
  const Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(q.norm() > 1e-6)) refuse_node(node, where, key, rule);
  return make_transform(Vector3d(v[0], v[1], v[2]), q);
}

YAML::Node number_node(double number) {
  return std::isinf(number) ? YAML::Node(number > 0.0 ? ".inf" : "-.inf") : YAML::Node(number);
}

void check_keys(const YAML::Node& map, const std::string& where, const std::string& prefix,
                const std::vector<std::string>& allowed) {
  if (!map.IsDefined() || !map.IsMap()) {
    refuse_node(map, where, prefix.empty() ? "top level" : prefix.substr(0, prefix.size() - 1), "a map");
  }
  std::set<std::string> seen;
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : YAML::Dump(entry.first);
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      validation::refuse_because(place(entry.first, where), prefix + key, validation::unknown_key(key, allowed));
    }
    if (!seen.insert(key).second) validation::refuse_because(place(entry.first, where), prefix + key, "given twice");
  }
}

namespace {

/// Refuses files that aliases make endless or huge: `&a [*a]`, or lists of lists of aliases.
void check_extent(const YAML::Node& node, const std::string& path, int depth, long& values) {
  if (depth > max_nesting_depth)
    validation::refuse(path, "nesting", "at most " + std::to_string(max_nesting_depth) + " levels");
  if (++values > max_values) validation::refuse(path, "size", "at most " + std::to_string(max_values) + " values");
  if (node.IsSequence()) {
    for (const YAML::Node& entry : node) check_extent(entry, path, depth + 1, values);
  } else if (node.IsMap()) {
    for (const auto& entry : node) {
      check_extent(entry.first, path, depth + 1, values);
      check_extent(entry.second, path, depth + 1, values);
    }
  }
}

/// Takes no note of what a document contains.
class Unread final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// Not by YAML::LoadAll(), which finds documents without end in some malformed files (a comma that begins a line).
bool has_more_than_one_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Unread unread;
  return parser.HandleNextDocument(unread) && parser.HandleNextDocument(unread);
}

}  // namespace

YAML::Node load_yaml_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) validation::refuse("", path, std::string("a readable YAML file (") + std::strerror(errno) + ")");
  std::ostringstream text;
  if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();  // copying an empty file would fail
  if (file.bad() || text.fail())
    validation::refuse("", path, std::string("a readable YAML file (") + std::strerror(errno) + ")");
  try {
    if (has_more_than_one_document(text.str()))
      throw validation::InputError(path + ": contains several YAML documents: expected one");
    const YAML::Node document = YAML::Load(text.str());
    if (document.IsNull()) return YAML::Node(YAML::NodeType::Map);
    long values = 0;
    check_extent(document, path, 0, values);
    return document;
  } catch (const YAML::Exception& e) {
    throw validation::InputError(path + ":" + std::to_string(e.mark.line + 1) +
                                 ": not YAML: " + validation::one_line(e.msg));
  }
}

}  // namespace spring_workbench::config

#include "urdf_file.h"

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "constants.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/number_rule.h"
#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::scene {
namespace {

/// Captures what urdfdom logs to the console during its lifetime. The console's handler is global, so there can be only
/// one at a time.
class ConsoleCapture : private console_bridge::OutputHandler {
 public:
  ConsoleCapture() : lock_(mutex()), previous_(console_bridge::getOutputHandler()) {
    console_bridge::useOutputHandler(this);
  }
  ~ConsoleCapture() override { console_bridge::useOutputHandler(previous_); }
  ConsoleCapture(const ConsoleCapture&) = delete;
  ConsoleCapture& operator=(const ConsoleCapture&) = delete;

  const std::vector<std::string>& messages() const { return messages_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) messages_.push_back(validation::one_line(text));
  }

  std::lock_guard<std::mutex> lock_;
  console_bridge::OutputHandler* previous_;
  std::vector<std::string> messages_;
};

struct ParseResult {
  std::shared_ptr<urdf::ModelInterface> model;
  std::vector<std::string> complaints;
};

ParseResult parse(const TiXmlDocument& document) {
  TiXmlPrinter printer;
  document.Accept(&printer);
  const ConsoleCapture console;
  ParseResult result;
  try {
    result.model = urdf::parseURDF(printer.Str());
    result.complaints = console.messages();
  } catch (const std::exception& e) {
    result.model.reset();
    result.complaints = {validation::one_line(e.what())};
  }
  return result;
}

/// urdfdom's first error message about an element of a link, or an empty string. Materials are removed first, because
/// they may be defined elsewhere.
std::string complaint_about(TiXmlElement element) {
  while (TiXmlElement* material = element.FirstChildElement("material")) element.RemoveChild(material);
  TiXmlElement link("link");
  link.SetAttribute("name", "link");
  link.InsertEndChild(element);
  TiXmlElement robot("robot");
  robot.SetAttribute("name", "robot");
  robot.InsertEndChild(link);
  TiXmlDocument document;
  document.InsertEndChild(robot);
  const ParseResult result = parse(document);
  return result.complaints.empty() ? "" : result.complaints.front();
}

std::string place(const std::string& path, int line) { return line > 0 ? path + ":" + std::to_string(line) : path; }

const TiXmlElement* shape_of(const TiXmlElement& element) {
  const TiXmlElement* geometry = element.FirstChildElement("geometry");
  return geometry != nullptr ? geometry->FirstChildElement() : nullptr;
}

bool is_urdf_shape(const TiXmlElement* shape) {
  static const std::array<std::string, 4> known = {"box", "cylinder", "mesh", "sphere"};
  return shape != nullptr && std::find(known.begin(), known.end(), shape->ValueStr()) != known.end();
}

std::optional<double> mass_of(const TiXmlElement& inertial) {
  const TiXmlElement* mass = inertial.FirstChildElement("mass");
  const char* text = mass != nullptr ? mass->Attribute("value") : nullptr;
  if (text == nullptr) return std::nullopt;
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double value = 0.0;
  if (!(in >> value) || !(value > 0.0)) return std::nullopt;
  return value;
}

/// Removes an element that urdfdom cannot read from its link, with a warning; refuses a known shape with invalid
/// values.
void take_out(TiXmlElement& link, TiXmlElement& element, const std::string& complaint, UrdfFile& file) {
  const std::string name = link.Attribute("name");
  const std::string where = validation::one_line(place(file.path, element.Row()) + ": link '" + name + "': ");
  const std::string kind = element.ValueStr();
  if (kind == "inertial") {
    const std::optional<double> mass = file.unreadable_inertials[name] = mass_of(element);
    file.warnings.push_back(
        where + "inertial cannot be read (" + complaint + "); the inertia of its shape is used, " +
        (mass ? "with a mass of " + validation::number_text(*mass) + " kg" : "with the shape's mass"));
  } else {
    const TiXmlElement* shape = shape_of(element);
    if (is_urdf_shape(shape)) throw validation::InputError(where + kind + ": " + complaint);
    const std::string what = shape != nullptr ? "shape '" + shape->ValueStr() + "'" : "shape missing";
    file.warnings.push_back(where + kind + " skipped: " + what + ": expected box, cylinder, mesh or sphere");
  }
  link.RemoveChild(&element);
}

void try_elements(TiXmlElement& link, UrdfFile& file) {
  for (const char* kind : {"inertial", "visual", "collision"}) {
    TiXmlElement* next = nullptr;
    for (TiXmlElement* element = link.FirstChildElement(kind); element != nullptr; element = next) {
      next = element->NextSiblingElement(kind);
      const std::string complaint = complaint_about(*element);
      if (!complaint.empty()) take_out(link, *element, complaint, file);
    }
  }
}

/// Refuses what xacro would have replaced: urdfdom skips it silently.
void refuse_xacro(const TiXmlElement& element, const std::string& path) {
  if (element.ValueStr().rfind("xacro:", 0) == 0) {
    validation::refuse(place(path, element.Row()), validation::one_line(element.ValueStr()),
                       "a URDF without elements of xacro: expand it (rosrun xacro xacro FILE > NEW_FILE)");
  }
  for (auto child = element.FirstChildElement(); child; child = child->NextSiblingElement()) refuse_xacro(*child, path);
}

int depth_below(const TiXmlNode& node) {
  int deepest = 0;
  for (const TiXmlNode* child = node.FirstChild(); child != nullptr; child = child->NextSibling()) {
    deepest = std::max(deepest, 1 + depth_below(*child));
  }
  return deepest;
}

/// Whether TinyXML can parse the text without crashing. It uses a stack frame per nesting level, and only TinyXML knows
/// what it counts as an element, so if the stack might overflow, a child process tries first.
bool can_be_parsed(const std::string& xml) {
  const auto parse = [&] {
    TiXmlDocument document;
    document.Parse(xml.c_str());
    return std::string();
  };
  return std::count(xml.begin(), xml.end(), '<') < elements_parsed_in_child ||
         validation::run_in_child(parse, {5.0, std::uint64_t{1} << 30});
}

TiXmlDocument load_xml(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream stream;
  if (!in || !(stream << in.rdbuf())) {
    validation::refuse("", path, "a readable URDF file");
  }
  const std::string text = stream.str();
  TiXmlDocument document;
  const bool parsed = can_be_parsed(text);
  if (parsed) document.Parse(text.c_str());
  if (!parsed || depth_below(document) > max_nesting) {
    validation::refuse(path, "nesting",
                       "at most " + std::to_string(max_nesting) + " levels of elements, readable within 5 s and 1 GiB");
  }
  if (document.Error()) {
    throw validation::InputError(place(path, document.ErrorRow()) +
                                 ": not XML: " + validation::one_line(document.ErrorDesc()));
  }
  return document;
}

/// The "parent" or "child" link of a joint; empty if it names none, which urdfdom reports.
std::string end_of(const TiXmlElement& joint, const char* which) {
  const TiXmlElement* end = joint.FirstChildElement(which);
  const char* link = end != nullptr ? end->Attribute("link") : nullptr;
  return link != nullptr ? link : "";
}

struct ChildLink {
  std::string parent;
  const TiXmlElement* joint;
  std::size_t walk = 0;  ///< number of the walk that first reached the link
};

[[noreturn]] void refuse_joint(const TiXmlElement& joint, const std::string& path) {
  const char* name = joint.Attribute("name");
  validation::refuse(validation::one_line(place(path, joint.Row()) + ": joint '" + (name != nullptr ? name : "") + "'"),
                     "child", validation::one_line(end_of(joint, "child")),
                     "a link that is the child of no other joint, without loops");
}

/// Refuses links that do not form a tree: urdfdom accepts loops, but then walks them endlessly and never frees them.
void refuse_loops(const TiXmlElement& robot, const std::string& path) {
  std::map<std::string, ChildLink> links;
  for (auto joint = robot.FirstChildElement("joint"); joint; joint = joint->NextSiblingElement("joint")) {
    const std::string child = end_of(*joint, "child");
    if (!child.empty() && !links.insert({child, {end_of(*joint, "parent"), joint}}).second) refuse_joint(*joint, path);
  }
  std::size_t walk = 0;
  for (const auto& entry : links) {
    ++walk;
    auto at = links.find(entry.first);
    for (; at != links.end() && at->second.walk == 0; at = links.find(at->second.parent)) at->second.walk = walk;
    if (at != links.end() && at->second.walk == walk) refuse_joint(*at->second.joint, path);
  }
}

}  // namespace

std::string UrdfFile::where(const std::string& link) const {
  const auto line = link_lines.find(link);
  return place(path, line != link_lines.end() ? line->second : 0) + ": link '" + link + "'";
}

UrdfFile read_urdf_file(const std::string& path) {
  TiXmlDocument document = load_xml(path);
  UrdfFile file;
  file.path = path;
  if (TiXmlElement* robot = document.FirstChildElement("robot")) {
    refuse_xacro(*robot, path);
    refuse_loops(*robot, path);
    std::size_t links = 0;
    for (TiXmlElement* link = robot->FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
      if (++links > max_links) validation::refuse(path, "links", "at most " + std::to_string(max_links));
      if (link->Attribute("name") == nullptr)
        validation::refuse_missing(place(path, link->Row()), "link.name", "name of the link");
      file.link_lines[link->Attribute("name")] = link->Row();
      try_elements(*link, file);
    }
  }
  ParseResult result = parse(document);
  if (!result.model) {
    throw validation::InputError(
        path + ": not a URDF: " + (result.complaints.empty() ? "no reason was given" : result.complaints.front()));
  }
  file.model = result.model;
  for (const std::string& complaint : result.complaints) file.warnings.push_back(path + ": " + complaint);
  return file;
}

}  // namespace spring_workbench::scene

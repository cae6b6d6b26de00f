#include "spring_workbench/live/checkpoint.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "spring_workbench/config/output_file.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::live {
namespace {

const std::string header = "# spring_workbench checkpoint 1\n";

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  validation::refuse("manipulation", "checkpoint_file", path,
                     "the path of a checkpoint or of a new file, in a writable folder (" + reason + ")");
}

/// Opens a checkpoint and reads its header; null if there is no such file.
File open_ours(const std::string& path) {
  // Does not follow a symbolic link, and does not wait for the writer of a FIFO.
  const int descriptor = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) return File(nullptr, std::fclose);
  if (descriptor < 0) refuse(path, errno == ELOOP ? "it is a symbolic link" : std::strerror(errno));
  File file(fdopen(descriptor, "r"), std::fclose);
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) refuse(path, "it is not a regular file");
  std::string begin(header.size(), '\0');
  begin.resize(std::fread(begin.data(), 1, begin.size(), file.get()));
  if (begin != header) refuse(path, "it belongs to another program");
  return file;
}

}  // namespace

std::optional<Checkpoint::Kept> Checkpoint::changed() const {
  Kept now = runner_.locked([](const simulation::Simulation& simulation) {
    return Kept{simulation.scene().path, simulation.save()};
  });
  if (now.scene == kept_.scene && now.state == kept_.state) return std::nullopt;
  return now;
}

std::string Checkpoint::text_of(const Kept& kept) const {
  YAML::Emitter text;
  text << YAML::BeginMap;
  for (const auto& [key, value] : {std::pair<std::string, std::string>("given_scene", given_scene_),
                                   {"scene", kept.scene},
                                   {"state", serialise(kept.state)}})
    text << YAML::Key << key << YAML::Value << YAML::DoubleQuoted << value;
  text << YAML::EndMap;
  return text.c_str();
}

void Checkpoint::resume(const std::string& text, const std::string& where,
                        const std::vector<std::string>& scene_roots) {
  YAML::Node map;
  try {
    map = YAML::Load(text);
  } catch (const YAML::Exception&) {  // truncated: not a map
  }
  if (!map.IsMap()) validation::refuse_because("", where, "not a complete checkpoint");
  const std::string given = config::read_string(map["given_scene"], where, "given_scene");
  if (given != given_scene_)
    validation::refuse_because(
        where, "given_scene",
        "the checkpoint is of '" + given + "', but the node was started with '" + given_scene_ + "'");
  const std::string scene = config::read_string(map["scene"], where, "scene");
  const auto state = simulation::parse_state(config::read_string(map["state"], where, "state"));
  const std::shared_ptr<const scene::Scene> present = runner_.scene();
  runner_.resume(present->path == scene ? *present : scene::load_scene(scene, scene_roots), state);
}

CheckpointFile::CheckpointFile(const std::string& path) : path_(std::filesystem::absolute(path).string()) {}

std::string CheckpointFile::read() const {
  const File file = open_ours(path_);
  std::string text;
  char part[1 << 16];
  while (const std::size_t bytes = file ? std::fread(part, 1, sizeof part, file.get()) : 0) text.append(part, bytes);
  if (file && std::ferror(file.get()) != 0) refuse(path_, "cannot be read");
  return text;
}

void CheckpointFile::write(const std::string& text) const {
  open_ours(path_);
  try {
    config::OutputFile file(path_);
    file.write(header);
    file.write(text);
    file.commit();
  } catch (const validation::InputError& error) {
    throw validation::InputError("manipulation: checkpoint_file: " + std::string(error.what()));
  }
}

void CheckpointFile::set_aside() const {
  if (open_ours(path_)) std::rename(path_.c_str(), (path_ + ".ignored").c_str());
}

void CheckpointFile::remove() const {
  if (open_ours(path_)) std::remove(path_.c_str());
}

}  // namespace spring_workbench::live

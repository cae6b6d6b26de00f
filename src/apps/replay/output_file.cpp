#include "output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::replay {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw validation::InputError(path + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::is_directory(status)) throw validation::InputError(path + ": cannot be written: is a folder");
  const bool in_place = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  written_path_ = in_place ? path : path + ".part" + std::to_string(getpid());
  file_.open(written_path_, std::ios::binary | std::ios::trunc);
  if (!file_) fail(path_);
}

OutputFile::~OutputFile() {
  if (!committed_ && written_path_ != path_) std::remove(written_path_.c_str());
}

void OutputFile::commit() {
  file_.close();
  if (!file_) fail(path_);
  if (written_path_ != path_ && std::rename(written_path_.c_str(), path_.c_str()) != 0) fail(path_);
  committed_ = true;
}

}  // namespace spring_workbench::replay

#include "spring_workbench/config/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::config {
namespace {

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Flushes a folder: a rename survives a crash of the machine only if the folder is on disk, too.
bool sync_folder(const std::string& path) {
  const int descriptor = open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool synced = fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: a file system without fsync for folders
  close(descriptor);
  return synced;
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  std::error_code none;
  const auto status = std::filesystem::status(path_, none);
  if (std::filesystem::is_directory(status))
    throw validation::InputError(path_ + ": cannot be written: it is a folder");
  in_place_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  written_path_ = in_place_ ? path_ : path_ + ".part" + std::to_string(getpid());
  if (!in_place_) {
    const int descriptor = open(folder_of(path_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) file_ = fdopen(descriptor, "w");
    nameless_ = file_ != nullptr;
    if (nameless_) return;
    std::remove(written_path_.c_str());  // left by a killed process with the same id
  }
  file_ = std::fopen(written_path_.c_str(), in_place_ ? "we" : "wxe");
  check(file_ != nullptr);
}

OutputFile::~OutputFile() {
  std::fclose(file_);
  if (!committed_ && !in_place_ && !nameless_) std::remove(written_path_.c_str());
}

void OutputFile::write(const std::string& text) {
  check(std::fwrite(text.data(), 1, text.size(), file_) == text.size());
}

void OutputFile::write_begin(const std::string& bytes) {
  check(std::fseek(file_, 0, SEEK_SET) == 0);
  write(bytes);
  check(std::fseek(file_, 0, SEEK_END) == 0);
}

void OutputFile::commit() {
  check(std::fflush(file_) == 0);
  if (in_place_) return;
  check(fsync(fileno(file_)) == 0);
  if (nameless_) {
    std::remove(written_path_.c_str());  // left by a killed process with the same id
    const std::string itself = "/proc/self/fd/" + std::to_string(fileno(file_));
    check(linkat(AT_FDCWD, itself.c_str(), AT_FDCWD, written_path_.c_str(), AT_SYMLINK_FOLLOW) == 0);
    nameless_ = false;
  }
  check(std::rename(written_path_.c_str(), path_.c_str()) == 0);
  committed_ = true;
  check(sync_folder(path_));
}

void OutputFile::check(bool success) const {
  if (!success) throw validation::InputError(path_ + ": cannot be written: " + std::strerror(errno));
}

}  // namespace spring_workbench::config

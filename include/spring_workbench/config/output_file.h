#pragma once

#include <cstdio>
#include <string>

namespace spring_workbench::config {

/// A file that appears whole or not at all, even if the program or the machine ends meanwhile: it is written next to
/// its path (as `PATH.part<process>`), flushed to the disk, and renamed by commit(). Anything but a regular file (a
/// pipe, /dev/null) is written in place.
class OutputFile {
 public:
  /// Throws InputError if the file cannot be made.
  explicit OutputFile(std::string path);
  ~OutputFile();  ///< removes what was not committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws InputError if not everything can be written.
  void write(const std::string& text);
  /// Replaces the first bytes; what is written next goes behind the last. Throws InputError likewise.
  void write_begin(const std::string& bytes);
  /// Throws InputError if not everything is on the disk under its name. What was there before stays in that case,
  /// except if only the folder's entry could not be brought to the disk.
  void commit();

 private:
  void check(bool success) const;

  std::string path_, written_path_;
  bool in_place_ = false, committed_ = false;
  std::FILE* file_ = nullptr;
};

}  // namespace spring_workbench::config

#pragma once

#include <cstdio>
#include <string>

namespace spring_workbench::config {

/// A file that is written atomically, even if the program is killed or the machine crashes meanwhile: it has no name
/// (or `PATH.part<process>` on a file system that cannot do without) until commit() flushes it to disk and gives it its
/// own. Anything but a regular file (a pipe, /dev/null) is written in place.
class OutputFile {
 public:
  /// Throws InputError if the file cannot be created.
  explicit OutputFile(std::string path);
  ~OutputFile();  ///< removes a file that was not committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws InputError if not everything can be written.
  void write(const std::string& text);
  /// Overwrites the first bytes; later calls of write() still append at the end. Throws InputError like write().
  void write_begin(const std::string& bytes);
  /// Flushes and renames the file. Throws InputError on failure; an earlier file of the same name is then kept, unless
  /// only the flush of the folder failed.
  void commit();

 private:
  void check(bool success) const;

  std::string path_, written_path_;
  bool in_place_ = false, committed_ = false;
  bool nameless_ = false;  ///< has no name yet
  std::FILE* file_ = nullptr;
};

}  // namespace spring_workbench::config

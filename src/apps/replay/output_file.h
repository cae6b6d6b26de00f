#pragma once

#include <fstream>
#include <string>

namespace spring_workbench::replay {

/// A text file that appears whole or not at all: it is written under another name and renamed by commit().
/// What is no regular file (a pipe, /dev/null) is written in place.
class OutputFile {
 public:
  /// Throws InputError where the file cannot be made.
  explicit OutputFile(const std::string& path);
  ~OutputFile();  ///< takes away what was not committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const std::string& text) { file_ << text; }
  /// Throws InputError where not everything could be written.
  void commit();

 private:
  std::string path_;
  std::string written_path_;
  std::ofstream file_;
  bool committed_ = false;
};

}  // namespace spring_workbench::replay

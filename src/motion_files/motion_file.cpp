#include "spring_workbench/motion_files/motion_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <locale>
#include <sstream>
#include <utility>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::motion_files {
namespace {

const char* const kFields[] = {"t", "x", "y", "z", "qx", "qy", "qz", "qw", "button"};
constexpr std::size_t kFieldsWithoutButton = 8;
constexpr std::size_t kFieldsWithButton = 9;
// The times and positions that a PoseTrack accepts.

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Uses long double so that differences of stamps since 1970 are exact to the nanosecond.
long double read_word(const std::string& word, const std::string& where, const std::string& field,
                      const validation::NumberRule& rule) {
  std::istringstream in(word);
  in.imbue(std::locale::classic());
  long double value = 0.0L;
  const bool is_number = static_cast<bool>(in >> value) && in.peek() == std::istringstream::traits_type::eof();
  if (!is_number || !rule.allows(static_cast<double>(value)))
    validation::refuse(where, field, word.substr(0, 40), rule.text());
  return value;
}

/// Correctly rounded to the resolution of ROS time, so that the same stamps give bit-identical times whatever the
/// origin of time, and in a bag.
double whole_nanoseconds(long double seconds) { return static_cast<double>(std::round(seconds * 1e9L)) / 1e9; }

struct Line {
  long double stamp = 0.0;
  motion::StylusSample sample;
};

Line read_line(const std::vector<std::string>& words, const std::string& where) {
  const auto number = [&](std::size_t i, double largest, const char* unit) {
    return static_cast<double>(read_word(words[i], where, kFields[i], validation::between(-largest, largest).in(unit)));
  };
  Line line;
  line.stamp = read_word(words[0], where, kFields[0], validation::between(-farthest_time, farthest_time).in("s"));
  Vector3d p;
  for (std::size_t i = 0; i < 3; ++i) p[static_cast<Eigen::Index>(i)] = number(i + 1, farthest_position, "m");
  const Quaterniond q(number(7, 2.0, ""), number(4, 2.0, ""), number(5, 2.0, ""), number(6, 2.0, ""));
  validation::check_number(where, "norm of qx qy qz qw", q.norm(), validation::between(0.5, 2.0));
  line.sample.X = make_transform(p, q);
  line.sample.quaternion_norm = q.norm();
  if (words.size() == kFieldsWithButton) {
    if (words[8] != "0" && words[8] != "1") validation::refuse(where, "button", words[8].substr(0, 40), "0 or 1");
    line.sample.button = words[8] == "1";
  }
  return line;
}

[[noreturn]] void refuse_unreadable(const std::string& path) {
  validation::refuse("", path, std::string("a readable motion file (") + std::strerror(errno) + ")");
}

}  // namespace

std::vector<motion::StylusSample> read_motion_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) refuse_unreadable(path);
  std::vector<motion::StylusSample> samples;
  std::size_t fields = 0;
  long double first_stamp = 0.0L;
  std::string text;
  bool is_bag = false;
  for (long number = 1; std::getline(file, text); ++number) {
    if (number == 1) is_bag = text.rfind("#ROSBAG", 0) == 0;
    if (number == 1 && text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // a byte order mark
    const std::vector<std::string> words = words_of(text);
    if (words.empty()) continue;
    const std::string where = path + ":" + std::to_string(number);
    if (words.size() != kFieldsWithoutButton && words.size() != kFieldsWithButton) {
      validation::refuse(where, "line",
                         "t x y z qx qy qz qw [button], got " + std::to_string(words.size()) + " fields");
    }
    if (fields != 0 && words.size() != fields) {
      validation::refuse(
          where, "line",
          std::to_string(fields) + " fields, as in the lines before, got " + std::to_string(words.size()));
    }
    const Line line = read_line(words, where);
    if (samples.empty()) {
      fields = words.size();
      first_stamp = line.stamp;
    }
    samples.push_back(line.sample);
    samples.back().t = whole_nanoseconds(line.stamp - first_stamp);
  }
  if (file.bad()) refuse_unreadable(path);
  const std::string none = is_bag ? "got a bag: give it as --bag" : "got none";
  if (samples.empty()) validation::refuse("", path, "lines of t x y z qx qy qz qw [button], " + none);
  return samples;
}

RecordedSource::RecordedSource(std::vector<motion::StylusSample> samples) : samples_(std::move(samples)) {}

std::optional<motion::StylusSample> RecordedSource::next() {
  if (next_ == samples_.size()) return std::nullopt;
  return samples_[next_++];
}

}  // namespace spring_workbench::motion_files

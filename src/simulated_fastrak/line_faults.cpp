#include "spring_workbench/simulated_fastrak/line_faults.h"

#include <algorithm>
#include <utility>

#include "constants.h"
#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::simulated_fastrak {
namespace {

const char* const kWhere = "command line";
const char* const kLetters = "jklxy";  // the device's error letters for weak signals

}  // namespace

Fault parse_fault(const std::string& text) {
  Fault fault;
  std::size_t end = std::min(text.find(','), text.size());
  static const std::vector<std::string> kinds{"garbage", "cut", "silence", "error", "wrong_mode", "unplug"};
  const auto kind = std::find(kinds.begin(), kinds.end(), text.substr(0, end));
  if (kind == kinds.end())
    validation::refuse(kWhere, "--fault", text,
                       "one of " + validation::join(kinds) + ", optionally followed by ,rate=R ,from=S ,until=S");
  fault.kind = static_cast<Fault::Kind>(kind - kinds.begin());
  while (end < text.size()) {
    const std::size_t begin = end + 1;
    end = std::min(text.find(',', begin), text.size());
    const std::string field = text.substr(begin, end - begin);
    const std::size_t equals = std::min(field.find('='), field.size());
    const std::string key = field.substr(0, equals);
    const YAML::Node value(field.substr(std::min(equals + 1, field.size())));
    const std::string name = "--fault " + key;
    if (key == "rate") {
      fault.rate = config::read_number(value, kWhere, name, validation::between(0.0, 1.0));
    } else if (key == "from" || key == "until") {
      (key == "from" ? fault.from : fault.until) =
          config::read_number(value, kWhere, name, validation::not_negative().in("s"));
    } else {
      validation::refuse(kWhere, "--fault", field, "rate=, from= or until=");
    }
  }
  return fault;
}

LineFaults::LineFaults(std::vector<Fault> faults, unsigned seed) : faults_(std::move(faults)), random_(seed) {}

bool LineFaults::active(Fault::Kind kind, double t) const {
  return std::any_of(faults_.begin(), faults_.end(),
                     [&](const Fault& f) { return f.kind == kind && t >= f.from && t < f.until; });
}

bool LineFaults::mode_changes(double before, double t) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& f) {
    return f.kind == Fault::Kind::wrong_mode && f.from > before && f.from <= t;
  });
}

bool LineFaults::hits(double rate) { return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < rate; }

std::size_t LineFaults::random_number(std::size_t min, std::size_t max) {
  return std::uniform_int_distribution<std::size_t>(min, max)(random_);
}

std::string LineFaults::noise(std::size_t size) {
  std::string bytes(size, ' ');
  for (char& c : bytes) c = static_cast<char>(random_number(0, 255));
  return bytes;
}

std::string LineFaults::pass(std::string record, double t) {
  for (const Fault& fault : faults_) {
    if (record.empty() || t < fault.from || t >= fault.until) continue;
    if (fault.kind == Fault::Kind::silence || fault.kind == Fault::Kind::unplug) return "";
    if (fault.kind == Fault::Kind::wrong_mode || !hits(fault.rate)) continue;
    if (fault.kind == Fault::Kind::garbage) corrupt(record);
    if (fault.kind == Fault::Kind::cut) truncate(record);
    if (fault.kind == Fault::Kind::error) report_error(record);
  }
  return record;
}

void LineFaults::corrupt(std::string& record) {
  const std::size_t at = random_number(0, record.size() - 1);
  switch (random_number(0, 2)) {
    case 0:  // insert bytes
      record.insert(at, noise(random_number(1, longest_noise)));
      break;
    case 1: {  // overwrite bytes
      const std::size_t size = random_number(1, record.size() - at);
      record.replace(at, size, noise(size));
      break;
    }
    default:  // flip one bit
      record[at] = static_cast<char>(static_cast<unsigned char>(record[at]) ^ (1U << random_number(0, 7)));
  }
}

void LineFaults::truncate(std::string& record) {
  const std::size_t at = random_number(0, record.size() - 1);
  record.erase(at, random_number(1, record.size() - at));
}

void LineFaults::report_error(std::string& record) {
  const char letter = kLetters[random_number(0, 4)];
  if (hits(0.5)) {
    if (record.size() > 2 && record[0] == '0') record[2] = letter;
  } else {
    record.insert(0, "2 E*ERROR*?*ERROR* EC-99*PS0*FL0*ST0\r\n");
  }
}

}  // namespace spring_workbench::simulated_fastrak

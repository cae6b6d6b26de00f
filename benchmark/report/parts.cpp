#include "benchmark/report/parts.h"

#include <sys/time.h>

#include <algorithm>
#include <fstream>
#include <set>

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kFirst = "report part";

struct Head {
  std::string first = kFirst;
  Shard shard;
  bool quick = false;
  RunTime time;
  std::string warning;
  std::size_t facts = 0, units = 0;
};
template <typename Fields>
void each_field(Head& h, Fields& fields) {
  fields(h.first, h.shard.index, h.shard.count, h.quick, h.time.begun, h.time.ended, h.time.processor, h.warning,
         h.facts, h.units);
}

/// Header of the rows of a unit.
struct UnitHead {
  std::string name;
  double processor = 0.0;
  std::size_t rows = 0;
};
template <typename Fields>
void each_field(UnitHead& h, Fields& fields) {
  fields(h.name, h.processor, h.rows);
}

class PartFile {
 public:
  explicit PartFile(const std::string& path) : path_(path), file_(path) {
    if (!file_) validation::refuse("", path, "a readable file that report --shard wrote");
  }

  std::string line() {
    std::string text;
    if (!std::getline(file_, text) || file_.eof())
      validation::refuse(where(), "end of the file", "all rows before it; the shard was not finished");
    ++line_;
    return text;
  }
  template <typename Row>
  Row row() {
    const std::string text = line();
    return row_from_text<Row>(text, where());
  }
  std::string where() const { return path_ + ':' + std::to_string(line_); }

 private:
  std::string path_;
  std::ifstream file_;
  int line_ = 0;
};

ReportPart read_part(const std::string& path) {
  PartFile file(path);
  const Head head = file.row<Head>();
  if (head.first != kFirst || head.shard.count == 0 || head.shard.index - 1 >= head.shard.count) {
    validation::refuse(file.where(), "first line", head.first, "one that report --shard writes");
  }
  ReportPart part{head.shard, head.quick, head.time, head.warning, {}, {}};
  for (std::size_t i = 0; i < head.facts; ++i) part.facts.push_back(file.row<RunFact>());
  for (std::size_t i = 0; i < head.units; ++i) {
    const UnitHead unit = file.row<UnitHead>();
    UnitRows& rows = part.rows[unit.name];
    rows.processor = unit.processor;
    rows.where = file.where();
    for (std::size_t k = 0; k < unit.rows; ++k) rows.lines.push_back(file.line());
  }
  return part;
}

/// Appends `text` unless `all` already contains it.
void join(const std::string& text, std::string& all) {
  if (all.find(text) != std::string::npos) return;
  all += all.empty() ? text : " | " + text;
}

}  // namespace

RunTime run_time_now() {
  RunTime time;
  timeval clock{};
  gettimeofday(&clock, nullptr);
  time.ended = static_cast<double>(clock.tv_sec) + 1e-6 * static_cast<double>(clock.tv_usec);
  time.processor = processor_time_of_all();
  return time;
}

void write_part(const ReportPart& part, std::ostream& out) {
  const Head head{kFirst, part.shard, part.quick, part.time, part.warning, part.facts.size(), part.rows.size()};
  out << row_text(head) << '\n';
  for (const RunFact& fact : part.facts) out << row_text(fact) << '\n';
  for (const auto& [name, rows] : part.rows) {
    out << row_text(UnitHead{name, rows.processor, rows.lines.size()}) << '\n';
    for (const std::string& line : rows.lines) out << line << '\n';
  }
  out << std::flush;
}

ReportPart read_parts(const std::vector<std::string>& paths) {
  ReportPart all;
  std::set<std::size_t> seen;
  for (const std::string& path : paths) {
    const ReportPart part = read_part(path);
    const std::string name = std::to_string(part.shard.index) + '/' + std::to_string(part.shard.count);
    if (seen.empty()) {
      all.shard = part.shard;
      all.quick = part.quick;
      all.facts = part.facts;
    }
    if (part.shard.count != all.shard.count || part.quick != all.quick || part.facts.size() != all.facts.size()) {
      validation::refuse(path, "shard", name, "one of the same report as the others");
    }
    if (!seen.insert(part.shard.index).second)
      throw validation::InputError(validation::prefix(path, "shard " + name) + "given twice");
    all.time.begun = seen.size() == 1 ? part.time.begun : std::min(all.time.begun, part.time.begun);
    all.time.ended = std::max(all.time.ended, part.time.ended);
    all.time.processor += part.time.processor;
    join(part.warning, all.warning);
    for (std::size_t i = 0; i < part.facts.size(); ++i) join(part.facts[i].value, all.facts[i].value);
    all.rows.insert(part.rows.begin(), part.rows.end());
  }
  for (std::size_t i = 1; i <= all.shard.count; ++i) {
    if (seen.count(i) == 0) {
      validation::refuse("command line", "--merge",
                         "all " + std::to_string(all.shard.count) + " shards, got " + std::to_string(seen.size()) +
                             ", without shard " + std::to_string(i));
    }
  }
  return all;
}

}  // namespace spring_workbench::benchmark

#include "benchmark/full_map.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <numeric>
#include <random>
#include <tuple>

#include "benchmark/parallel.h"
#include "benchmark/progress.h"
#include "benchmark/row_text.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::benchmark {
namespace {

/// A line of the file.
struct NumberedCell {
  std::size_t number = 0;
  StabilityRun cell;
};

/// Reads the cells of the file; removes an incomplete last line.
std::vector<NumberedCell> read_cells(const std::string& path) {
  std::vector<NumberedCell> cells;
  std::ifstream in(path, std::ios::binary);
  if (!in) return cells;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string where = path + ":" + std::to_string(cells.size() + 1);
    const std::string line = text.substr(begin, end - begin), number = line.substr(0, line.find('\t'));
    if (number.empty() || number.size() > 9 || number.find_first_not_of("0123456789") != std::string::npos ||
        number.size() == line.size()) {
      validation::refuse(where, "number", number, "the number of a cell, with its row behind it");
    }
    cells.push_back({std::stoul(number), row_from_text<StabilityRun>(line.substr(number.size() + 1), where)});
  }
  if (begin < text.size()) std::filesystem::resize_file(path, begin);
  return cells;
}

/// All numbers below `size` in a seeded random order.
std::vector<std::size_t> shuffled(std::size_t size) {
  std::vector<std::size_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937 random(21);
  for (std::size_t i = size; i > 1; --i) std::swap(numbers[i - 1], numbers[random() % i]);
  return numbers;
}

auto place(const StabilityRun& one) {
  const StabilityCell& c = one.cell;
  return std::tie(one.integrator, one.shape, c.stiffness_factor, c.mass, c.step, c.damping_ratio);
}

}  // namespace

std::size_t full_map_size(const StabilityPlan& plan) {
  return plan.integrators.size() * plan.shapes.size() * plan.stiffness_factors.size() * plan.masses.size() *
         plan.steps.size() * plan.damping_ratios.size() * plan.dofs.size() * plan.hands.size() * plan.tails.size();
}

StabilityRun full_map_cell(const StabilityPlan& plan, std::size_t i) {
  std::size_t rest = i;
  const auto take = [&rest](const auto& values) {
    const std::size_t at = rest % values.size();
    rest /= values.size();
    return values[at];
  };
  StabilityRun one;
  one.integrator = take(plan.integrators);
  one.shape = take(plan.shapes);
  one.cell = cell_of(plan, take);
  one.cell.seconds = plan.seconds * (std::mt19937(static_cast<unsigned>(i))() % plan.long_one == 0 ? 6.0 : 1.0);
  return one;
}

std::vector<StabilityRun> run_full_map(const StabilityPlan& plan, const std::string& path, std::size_t most,
                                       std::ostream& log) {
  std::vector<NumberedCell> cells = read_cells(path);
  std::vector<bool> has(full_map_size(plan));
  for (const NumberedCell& cell : cells) {
    if (cell.number >= has.size() || place(cell.cell) != place(full_map_cell(plan, cell.number)))
      throw validation::InputError(path + ": has cells of another plan: move it away");
    has[cell.number] = true;
  }
  std::vector<std::size_t> missing;
  for (const std::size_t number : shuffled(has.size())) {
    if (!has[number] && missing.size() < most) missing.push_back(number);
  }
  std::ofstream out(path, std::ios::binary | std::ios::app);
  Progress progress(log, false, std::max<std::size_t>(1, missing.size()));
  std::mutex mutex;
  parallel_for(missing.size(), [&](std::size_t i) {
    NumberedCell cell{missing[i], full_map_cell(plan, missing[i])};
    cell.cell.outcome = run_cell(cell.cell.integrator, cell.cell.shape, cell.cell.cell);
    const std::lock_guard<std::mutex> lock(mutex);
    progress.next(cell.cell.integrator);
    out << cell.number << '\t' << row_text(cell.cell) << std::endl;
    if (!out) throw validation::InputError(path + ": cannot be written");
    cells.push_back(cell);
  });
  progress.finish();
  std::sort(cells.begin(), cells.end(), [](const NumberedCell& a, const NumberedCell& b) {
    return std::tuple_cat(place(a.cell), std::tie(a.number)) < std::tuple_cat(place(b.cell), std::tie(b.number));
  });
  std::vector<StabilityRun> run;
  for (NumberedCell& cell : cells) run.push_back(std::move(cell.cell));
  return run;
}

}  // namespace spring_workbench::benchmark

#include "benchmark/contact/limit_cases_table.h"

#include <iterator>
#include <sstream>

#include "benchmark/contact/bodies.h"
#include "benchmark/parallel.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr scene::ContactMode modes[] = {scene::ContactMode::stop, scene::ContactMode::dynamic};

/// Every stiffness with every step, each with a different seed; `quick` skips the stack, which costs most.
std::vector<LimitCaseCell> cells_of(ContactLimitCase limit_case, scene::ContactMode mode, bool quick) {
  const std::vector<double> stiffnesses = quick ? std::vector<double>{1e3} : std::vector<double>{1.0, 1e3, 1e6, 1e9};
  const std::vector<double> steps = quick ? std::vector<double>{0.02} : std::vector<double>{0.05, 0.02, 0.005, 0.001};
  std::vector<LimitCaseCell> cells;
  if (quick && limit_case == ContactLimitCase::stack_of_ten) return cells;
  for (const double stiffness : stiffnesses) {
    for (const double step : steps) {
      cells.push_back({limit_case, mode, stiffness, step, static_cast<unsigned>(cells.size())});
    }
  }
  return cells;
}

std::vector<LimitCaseRow> rows_of(ContactLimitCase limit_case, scene::ContactMode mode, bool quick) {
  const std::vector<LimitCaseCell> cells = cells_of(limit_case, mode, quick);
  std::vector<LimitCaseRow> rows(cells.size());
  try {
    parallel_for(cells.size(), [&](std::size_t i) {
      const LimitCaseCell& cell = cells[i];
      rows[i] = {name_of(limit_case), name_of(mode), cell.stiffness, cell.step, static_cast<int>(cell.seed), run(cell)};
    });
  } catch (const validation::InputError&) {  // this mode was not built
    return {};
  }
  return rows;
}

}  // namespace

std::size_t limit_case_unit_count() { return contact_limit_cases().size() * std::size(modes); }

std::vector<LimitCaseRow> limit_cases_table(bool quick, Units& units) {
  units.begin("contact's limit_cases");
  std::vector<LimitCaseRow> table;
  std::size_t number = 0;
  for (const scene::ContactMode mode : modes) {
    for (const ContactLimitCase limit_case : contact_limit_cases()) {
      const auto rows =
          units.rows<LimitCaseRow>(number++, "contact's limit_cases: " + name_of(mode) + ", " + name_of(limit_case),
                                   [&] { return rows_of(limit_case, mode, quick); });
      table.insert(table.end(), rows.begin(), rows.end());
    }
  }
  return table;
}

std::string limit_cases_csv(const std::vector<LimitCaseRow>& rows) {
  std::ostringstream out;
  out << "limit_case,contact,stiffness,step,seed,finite,bounded,penetration_um,energy_gained_um,steps_rejected,"
         "steps_blocked,steps_unsolved,passed\n";
  for (const LimitCaseRow& row : rows) {
    const LimitCaseOutcome& o = row.outcome;
    out << row.limit_case << ',' << row.contact << ',' << row.stiffness << ',' << row.step << ',' << row.seed << ','
        << o.finite << ',' << o.bounded << ',' << 1e6 * o.penetration << ',' << 1e6 * o.energy_gained << ','
        << o.rejected << ',' << o.steps_blocked << ',' << o.steps_unsolved << ',' << o.held() << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark

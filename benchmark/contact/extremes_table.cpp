#include "benchmark/contact/extremes_table.h"

#include <iterator>
#include <sstream>

#include "benchmark/contact/bodies.h"
#include "benchmark/parallel.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr scene::ContactMode modes[] = {scene::ContactMode::stop, scene::ContactMode::dynamic};

/// Every stiffness with every step, each with a different seed; `quick` skips the stack, which costs most.
std::vector<ExtremeCell> cells_of(ContactExtreme extreme, scene::ContactMode mode, bool quick) {
  const std::vector<double> stiffnesses = quick ? std::vector<double>{1e3} : std::vector<double>{1.0, 1e3, 1e6, 1e9};
  const std::vector<double> steps = quick ? std::vector<double>{0.02} : std::vector<double>{0.05, 0.02, 0.005, 0.001};
  std::vector<ExtremeCell> cells;
  if (quick && extreme == ContactExtreme::stack_of_ten) return cells;
  for (const double stiffness : stiffnesses) {
    for (const double step : steps) {
      cells.push_back({extreme, mode, stiffness, step, static_cast<unsigned>(cells.size())});
    }
  }
  return cells;
}

std::vector<ExtremeRow> rows_of(ContactExtreme extreme, scene::ContactMode mode, bool quick) {
  const std::vector<ExtremeCell> cells = cells_of(extreme, mode, quick);
  std::vector<ExtremeRow> rows(cells.size());
  try {
    parallel_for(cells.size(), [&](std::size_t i) {
      const ExtremeCell& cell = cells[i];
      rows[i] = {name_of(extreme), name_of(mode), cell.stiffness, cell.step, static_cast<int>(cell.seed), run(cell)};
    });
  } catch (const validation::InputError&) {  // this mode was not built
    return {};
  }
  return rows;
}

}  // namespace

std::size_t extreme_unit_count() { return contact_extremes().size() * std::size(modes); }

std::vector<ExtremeRow> extremes_table(bool quick, Units& units) {
  units.begin("contact's extremes");
  std::vector<ExtremeRow> table;
  std::size_t number = 0;
  for (const scene::ContactMode mode : modes) {
    for (const ContactExtreme extreme : contact_extremes()) {
      const auto rows =
          units.rows<ExtremeRow>(number++, "contact's extremes: " + name_of(mode) + ", " + name_of(extreme),
                                 [&] { return rows_of(extreme, mode, quick); });
      table.insert(table.end(), rows.begin(), rows.end());
    }
  }
  return table;
}

std::string extremes_csv(const std::vector<ExtremeRow>& rows) {
  std::ostringstream out;
  out << "extreme,contact,stiffness,step,seed,finite,bounded,penetration_um,energy_gained_um,steps_refused,"
         "steps_blocked,steps_unsolved,held\n";
  for (const ExtremeRow& row : rows) {
    const ExtremeOutcome& o = row.outcome;
    out << row.extreme << ',' << row.contact << ',' << row.stiffness << ',' << row.step << ',' << row.seed << ','
        << o.finite << ',' << o.bounded << ',' << 1e6 * o.penetration << ',' << 1e6 * o.energy_gained << ','
        << o.refused << ',' << o.steps_blocked << ',' << o.steps_unsolved << ',' << o.held() << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark

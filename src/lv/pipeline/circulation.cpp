#include "lv/pipeline/circulation.hpp"

#include "lv/base/log.hpp"
#include "lv/circulation/cycle.hpp"
#include "lv/report/cycle_tables.hpp"

#include <fmt/format.h>

namespace lv::pipeline {

void make_circulation(const case_file::Case& c, const std::filesystem::path& folder) {
  const circulation::Cycle cycle = circulation::run_alone(c.circulation);
  const std::string end = fmt::format(
      "{} after {} beats of {:.3g} s: the last changed the states by {:.2g} of themselves at most",
      cycle.is_limit ? "limit cycle" : "no limit cycle", cycle.beats.size(), c.circulation.period,
      cycle.change);
  if (!cycle.is_limit)
    log::warn("circulation: {}", end);
  const Table table = report::cycle_table(cycle.samples, cycle.columns, c.circulation.period);
  table.write_csv(folder / "cycle.csv");
  report::beats_table(cycle.beats).write_csv(folder / "beats.csv");
  drawing::write(report::pressure_volume_figure(table), folder / "pressure_volume.svg");
  drawing::write(report::wiggers_figure(table), folder / "wiggers.svg");
  write_file(folder / "circulation.txt",
             fmt::format("circulation with an elastance for the left ventricle\n{}\n\n{}", end,
                         report::beat_text(cycle.beats.back())));
}

}  // namespace lv::pipeline

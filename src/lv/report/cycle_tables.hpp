#pragma once

#include "lv/base/table.hpp"
#include "lv/circulation/beat_measures.hpp"
#include "lv/drawing/figure.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Tables and figures of whole heartbeats.
namespace lv::report {

/// cycle.csv: the signals of beats of a period [s], one row per sample.
[[nodiscard]] Table cycle_table(std::span<const circulation::Sample> samples,
                                const std::vector<circulation::Column>& columns, double period);

/// beats.csv: the measures of every beat.
[[nodiscard]] Table beats_table(std::span<const circulation::BeatMeasures> beats);

/// The measures of one beat as the columns of beats.csv name them.
[[nodiscard]] std::vector<std::pair<std::string, double>> beat_numbers(
    const circulation::BeatMeasures& beat);

/// The measures of one beat with their units, a line each.
[[nodiscard]] std::string beat_text(const circulation::BeatMeasures& beat);

/// What beats.csv holds of a beat.
struct BeatMeasure {
  std::string column;   ///< of beats.csv
  std::string words;    ///< "end-diastolic volume"
  std::string unit;     ///< empty of numbers without one
  std::string meaning;  ///< its definition
};
[[nodiscard]] const std::vector<BeatMeasure>& beat_measures();

/// Pressure against volume of all beats from cycle.csv, the last one marked, with the events of its
/// valves from beats.csv.
[[nodiscard]] drawing::Figure pressure_volume_figure(const Table& cycle, const Table& measured);

/// Wiggers diagram of the last beat from cycle.csv, with the phases between the valves' events
/// shaded: pressures, volume, flows, and calcium and tension from curves.csv where there is a wall.
[[nodiscard]] drawing::Figure wiggers_figure(const Table& cycle,
                                             const std::optional<Table>& curves = {});

}  // namespace lv::report

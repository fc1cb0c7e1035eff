#pragma once

#include "lv/base/table.hpp"
#include "lv/circulation/beat_measures.hpp"
#include "lv/drawing/figure.hpp"

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

/// Pressure against volume of all beats, the last one marked, from cycle.csv.
[[nodiscard]] drawing::Figure pressure_volume_figure(const Table& cycle);

/// Wiggers diagram of the last beat, from cycle.csv: pressures and volume, and flows, with the
/// phases between the valves' events shaded.
[[nodiscard]] drawing::Figure wiggers_figure(const Table& cycle);

}  // namespace lv::report

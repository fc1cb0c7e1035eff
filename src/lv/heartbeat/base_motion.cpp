#include "lv/heartbeat/base_motion.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/periodic.hpp"
#include "lv/base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::heartbeat {
namespace {

using Eigen::Vector4d;
using solid::BasePose;

constexpr const char* remedy =
    "The first line names the columns time_s (or cycle_share), axial_mm, septal_tilt_deg, "
    "anterior_tilt_deg and rotation_deg; docs/cycle.md says what they mean";

/// A component of the motion: its column, its size inside, and what hearts do at most.
struct Component {
  const char* column;
  const char* unit;
  double scale;    ///< of the column's unit inside
  double most;     ///< between any two lines [unit]
  double fastest;  ///< between two lines [unit/s]
};

constexpr std::array<Component, 4> components{
    {{"axial_mm", "mm", 1.0, 30.0, 400.0},
     {"septal_tilt_deg", "deg", units::degree, 20.0, 400.0},
     {"anterior_tilt_deg", "deg", units::degree, 20.0, 400.0},
     {"rotation_deg", "deg", units::degree, 30.0, 400.0}}};

Vector4d numbers_of(const BasePose& p) {
  return {p.axial, p.septal_tilt, p.anterior_tilt, p.rotation};
}

BasePose pose_of(const Vector4d& n) {
  return {n[0], n[1], n[2], n[3]};
}

/// One file, line by line.
class MotionReader {
 public:
  explicit MotionReader(const MotionFile& source) : source_(source), lines_(source.file) {
    if (!lines_.is_open())
      throw InputError(source.file, "cannot be read", "Check the name; it is read beside the case");
  }

  MeasuredMotion read() {
    read_header();
    while (next_line())
      read_row();
    if (rows_.size() < 4)
      throw InputError(
          lines_.where(),
          fmt::format("the motion has {} lines, and four are the least that show a beat",
                      rows_.size()),
          remedy);
    close();
    check_size();
    MeasuredMotion motion;
    for (const Row& row : rows_) {
      motion.times.push_back(row.time);
      Vector4d inside = row.values;
      for (int k = 0; k < 4; ++k)
        inside[k] *= components[static_cast<std::size_t>(k)].scale;
      motion.poses.push_back(pose_of(inside));
    }
    return motion;
  }

 private:
  struct Row {
    std::string where;
    double time;      ///< [s]
    Vector4d values;  ///< in the columns' units
  };

  bool next_line() {
    do
      if (!lines_.next())
        return false;
    while (trimmed(lines_.text()).starts_with('#'));
    fields_ = csv_fields(lines_.text());
    return true;
  }

  /// Where a column stands; nothing: nowhere.
  [[nodiscard]] std::size_t place_of(const std::string& column) const {
    return static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) -
                                    columns_.begin());
  }
  [[nodiscard]] bool has(const std::string& column) const {
    return place_of(column) < columns_.size();
  }

  void read_header() {
    if (!next_line())
      throw InputError(source_.file, "is empty", remedy);
    for (const std::string& field : fields_)
      columns_.push_back(lower_case(field));
    std::vector<std::string> known;
    if (has("time_s") == has("cycle_share"))
      throw InputError(lines_.where(),
                       has("time_s") ? "has both time_s and cycle_share"
                                     : "has neither the column time_s nor cycle_share",
                       remedy);
    is_share_ = has("cycle_share");
    known.emplace_back(is_share_ ? "cycle_share" : "time_s");
    for (const Component& c : components) {
      if (!has(c.column))
        throw InputError(lines_.where(), fmt::format("the column {} is missing", c.column), remedy);
      known.emplace_back(c.column);
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (std::find(known.begin(), known.end(), columns_[i]) == known.end())
        throw InputError(lines_.where(), fmt::format("the column {} is none of them", columns_[i]),
                         remedy);
      if (place_of(columns_[i]) != i)
        throw InputError(lines_.where(), fmt::format("the column {} is there twice", columns_[i]),
                         remedy);
    }
  }

  [[nodiscard]] double number(const std::string& column) const {
    const std::string& text = fields_[place_of(column)];
    const auto value = number_of<double>(text);
    if (!value || !std::isfinite(*value))
      throw InputError(lines_.where(),
                       fmt::format("{} {}", column, why_no_number(text, "is no number")), remedy);
    return *value;
  }

  void read_row() {
    if (fields_.size() != columns_.size())
      throw InputError(lines_.where(),
                       fmt::format("has {} values instead of {}", fields_.size(), columns_.size()),
                       remedy);
    Row row{
        lines_.where(), is_share_ ? source_.period * number("cycle_share") : number("time_s"), {}};
    for (int k = 0; k < 4; ++k)
      row.values[k] = number(components[static_cast<std::size_t>(k)].column);
    check_time(row);
    rows_.push_back(std::move(row));
  }

  void check_time(const Row& row) const {
    const double rounding = 1e-6 * source_.period;
    if (rows_.empty() && std::abs(row.time) > rounding)
      throw InputError(row.where, fmt::format("the first time is {:g} s", row.time),
                       "Begin with 0, when the calcium of a beat begins");
    if (!rows_.empty() && row.time <= rows_.back().time)
      throw InputError(
          row.where,
          fmt::format("{:g} s is not after the line before, {:g} s", row.time, rows_.back().time),
          "Write the lines in the order of time");
    if (row.time > source_.period + rounding)
      throw InputError(
          row.where,
          fmt::format("{:g} s is beyond the end of a beat, circulation.period = {:g} s", row.time,
                      source_.period),
          "Are times in seconds? Give one beat of the case's period, or the column cycle_share "
          "instead of time_s");
  }

  /// Takes away a last line that repeats the first.
  void close() {
    const double rounding = 1e-6 * source_.period;
    const Row& last = rows_.back();
    if (last.time >= source_.period - rounding) {
      for (std::size_t k = 0; k < components.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double gap = std::abs(last.values[i] - rows_.front().values[i]);
        if (gap > 0.01 * components[k].most)
          throw InputError(
              last.where,
              fmt::format("the table does not close: at the end of the beat {} is {:g}, and {:g} "
                          "where it begins",
                          components[k].column, last.values[i], rows_.front().values[i]),
              "Beats repeat: end where the motion begins, or leave the end of the beat out and the "
              "base goes back from the last line");
      }
      rows_.pop_back();
      return;
    }
    if (source_.period - last.time > 0.25 * source_.period + rounding)
      throw InputError(
          last.where,
          fmt::format("the table does not close: it ends at {:g} s of a beat of {:g} s", last.time,
                      source_.period),
          "Give the motion of the whole beat, of the case's circulation.period, or the column "
          "cycle_share instead of time_s");
  }

  void check_size() const {
    for (std::size_t k = 0; k < components.size(); ++k) {
      const Component& c = components[k];
      const auto i = static_cast<Eigen::Index>(k);
      const auto [least, most] = std::minmax_element(
          rows_.begin(), rows_.end(),
          [i](const Row& a, const Row& b) { return a.values[i] < b.values[i]; });
      if (const double range = most->values[i] - least->values[i]; range > c.most)
        throw InputError(
            most->where,
            fmt::format("{} moves by {:g} {} in a beat, more than a heart's base does ({:g} {})",
                        c.column, range, c.unit, c.most, c.unit),
            "Check the column and its unit");
      for (std::size_t n = 0; n < rows_.size(); ++n)
        check_speed(c, i, n);
    }
  }

  void check_speed(const Component& c, Eigen::Index i, std::size_t n) const {
    const bool is_last = n + 1 == rows_.size();
    const Row& next = rows_[is_last ? 0 : n + 1];
    const double dt = next.time + (is_last ? source_.period : 0.0) - rows_[n].time;
    const double speed = std::abs(next.values[i] - rows_[n].values[i]) / dt;
    if (speed <= c.fastest)
      return;
    throw InputError(
        rows_[n].where,
        fmt::format("{} moves at {:.4g} {}/s to the {}, faster than a heart's base ({:g} {}/s)",
                    c.column, speed, c.unit, is_last ? "first line of the next beat" : "next line",
                    c.fastest, c.unit),
        "Check the columns and their units");
  }

  const MotionFile& source_;
  LineReader lines_;
  std::vector<std::string> columns_, fields_;
  bool is_share_ = false;
  std::vector<Row> rows_;
};

/// The slope at a line between two stretches of length h with slopes d.
double slope_between(double h_before, double d_before, double h_after, double d_after) {
  if (d_before * d_after <= 0.0)
    return 0.0;
  const double w_before = 2.0 * h_after + h_before;
  const double w_after = h_after + 2.0 * h_before;
  return (w_before + w_after) / (w_before / d_before + w_after / d_after);
}

}  // namespace

MeasuredMotion read_motion(const MotionFile& source) {
  return MotionReader(source).read();
}

BaseMotion::BaseMotion(const MeasuredMotion& measured, const solid::BaseFrame& frame,
                       const Clock& clock)
    : clock_(clock), frame_(frame), times_(measured.times) {
  LV_CHECK(measured.times.size() >= 2 && measured.poses.size() == measured.times.size());
  for (const BasePose& p : measured.poses)
    poses_.push_back(numbers_of(p));
  times_.push_back(times_.front() + clock.period);
  poses_.push_back(poses_.front());
  const std::size_t n = measured.times.size();
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const std::size_t after = i % n;
    const double h_before = times_[before + 1] - times_[before];
    const double h_after = times_[after + 1] - times_[after];
    const Vector4d d_before = (poses_[before + 1] - poses_[before]) / h_before;
    const Vector4d d_after = (poses_[after + 1] - poses_[after]) / h_after;
    Vector4d slope;
    for (int k = 0; k < 4; ++k)
      slope[k] = slope_between(h_before, d_before[k], h_after, d_after[k]);
    slopes_.push_back(slope);
  }
  zero_ = pose(clock.zero);
}

Vector4d BaseMotion::pose(double time) const {
  const double t = time_in_period(time, clock_.period);
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, t);
  const auto i = static_cast<std::size_t>(next - times_.begin()) - 1;
  const double h = times_[i + 1] - times_[i];
  const double s = (t - times_[i]) / h;
  const double r = 1.0 - s;
  return r * r * (1.0 + 2.0 * s) * poses_[i] + s * s * (1.0 + 2.0 * r) * poses_[i + 1] +
         h * s * r * (r * slopes_[i] - s * slopes_[i + 1]);
}

solid::AffineField BaseMotion::at(double since) const {
  if (times_.empty())
    return {};
  return solid::displacement(pose_of(pose(since - clock_.onset) - zero_), frame_);
}

}  // namespace lv::heartbeat

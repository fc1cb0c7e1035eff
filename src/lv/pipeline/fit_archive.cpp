#include "lv/pipeline/fit_archive.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::pipeline {
namespace {

using calibrate::FitParameters;
using calibrate::Fitted;
using calibrate::OtherPressure;
using calibrate::RecordedFit;
using heartbeat::Archive;

std::vector<Fitted> load_fitted(const Archive& archive) {
  std::vector<Fitted> fitted;
  const auto& all = calibrate::all_parameters();
  for (const std::string& name : archive.get_words("fitted")) {
    const auto* found =
        std::find_if(all.begin(), all.end(), [&](const Fitted& p) { return p.name == name; });
    if (found == all.end())
      archive.refuse(fmt::format("'{}' is no parameter of a fit", name));
    fitted.push_back(*found);
  }
  return fitted;
}

void store_volumes(const RecordedFit& fit, Archive& archive) {
  std::vector<std::string> names;
  std::vector<double> volumes;
  std::vector<double> by_parameter;
  for (const calibrate::RecordedVolume& v : fit.volumes) {
    names.push_back(v.name);
    volumes.insert(volumes.end(), {v.pressure, v.target, v.model});
    for (const Fitted& p : fit.fitted)
      by_parameter.push_back(v.by_parameter.at(p.name));
  }
  archive.set_words("volumes.names", names);
  archive.set("volumes", std::move(volumes));
  archive.set("volumes.by_parameter", std::move(by_parameter));
}

void load_volumes(const Archive& archive, RecordedFit& fit) {
  const auto names = archive.get_words("volumes.names");
  const auto& volumes = archive.get_rows("volumes", 3, names.size());
  const auto& by_parameter =
      archive.get_rows("volumes.by_parameter", 1, names.size() * fit.fitted.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    fit.volumes.push_back({names[k], volumes[3 * k], volumes[3 * k + 1], volumes[3 * k + 2], {}});
    for (std::size_t j = 0; j < fit.fitted.size(); ++j)
      fit.volumes.back().by_parameter[fit.fitted[j].name] = by_parameter[k * fit.fitted.size() + j];
  }
}

/// A row of the pressure, whether there is a fit, the volume without load and all parameters.
constexpr std::size_t other_width = 3 + parameter_count;

void store_other_pressures(const RecordedFit& fit, Archive& archive) {
  std::vector<double> rows;
  std::vector<std::string> why_not;
  for (const OtherPressure& o : fit.other_pressures) {
    rows.insert(rows.end(), {o.pressure, o.parameters ? 1.0 : 0.0, o.unloaded_volume});
    const auto values = numbers(o.parameters.value_or(FitParameters{}));
    rows.insert(rows.end(), values.begin(), values.end());
    why_not.push_back(o.why_not);
  }
  archive.set("other_pressures", std::move(rows));
  archive.set_words("other_pressures.why_not", why_not);
}

constexpr std::size_t segment_width = 4;

void store_segments(const RecordedFit& fit, Archive& archive) {
  std::vector<double> rows;
  for (const calibrate::FittedSegment& s : fit.segments)
    rows.insert(rows.end(), {static_cast<double>(s.segment), s.factor, s.error, s.resolution});
  archive.set("segments", std::move(rows));
}

void load_segments(const Archive& archive, RecordedFit& fit) {
  const auto& rows = archive.get_rows("segments", segment_width);
  for (std::size_t k = 0; k < rows.size(); k += segment_width)
    fit.segments.push_back({archive.whole_number(rows[k], {1.0, mesh::aha_count}), rows[k + 1],
                            rows[k + 2], rows[k + 3]});
}

void load_other_pressures(const Archive& archive, RecordedFit& fit) {
  const auto why_not = archive.get_words("other_pressures.why_not");
  const auto& rows = archive.get_rows("other_pressures", other_width, why_not.size());
  for (std::size_t k = 0; k < why_not.size(); ++k) {
    const double* row = &rows[other_width * k];
    OtherPressure other{row[0], {}, row[2], why_not[k]};
    if (archive.whole_number(row[1], {0.0, 1.0}) == 1)
      other.parameters =
          parameters_of(std::span<const double, parameter_count>(row + 3, parameter_count));
    fit.other_pressures.push_back(std::move(other));
  }
}

}  // namespace

std::vector<double> numbers(const FitParameters& parameters) {
  std::vector<double> values;
  for (const Fitted& p : calibrate::all_parameters())
    values.push_back(parameters.*p.member);
  values.insert(values.end(), parameters.segments.begin(), parameters.segments.end());
  return values;
}

FitParameters parameters_of(std::span<const double, parameter_count> numbers) {
  FitParameters parameters;
  auto next = numbers.begin();
  for (const Fitted& p : calibrate::all_parameters())
    parameters.*p.member = *next++;
  std::copy(next, numbers.end(), parameters.segments.begin());
  return parameters;
}

void store(const FitParameters& parameters, Archive& archive, const std::string& name) {
  archive.set(name, numbers(parameters));
}

FitParameters load_parameters(const Archive& archive, const std::string& name) {
  return parameters_of(std::span<const double, parameter_count>(
      archive.get_rows(name, parameter_count, 1).data(), parameter_count));
}

void store(const RecordedFit& fit, Archive& archive) {
  store(fit.parameters, archive);
  std::vector<std::string> fitted;
  for (const Fitted& p : fit.fitted)
    fitted.push_back(p.name);
  archive.set_words("fitted", fitted);
  store_volumes(fit, archive);
  archive.set("klotz_pressure", fit.klotz_pressure ? std::vector<double>{*fit.klotz_pressure}
                                                   : std::vector<double>{});
  store_other_pressures(fit, archive);
  store_segments(fit, archive);
  if (fit.shape) {
    const auto& [distances, before, after] = *fit.shape;
    archive.set("shape", {before.rms, before.bias, after.rms, after.bias});
  }
}

RecordedFit load_fit(const Archive& archive) {
  RecordedFit fit{load_parameters(archive), load_fitted(archive), {}, {}, {}};
  load_volumes(archive, fit);
  if (!archive.get("klotz_pressure").empty())
    fit.klotz_pressure = archive.number("klotz_pressure");
  load_other_pressures(archive, fit);
  load_segments(archive, fit);
  if (archive.has("shape")) {
    const auto& row = archive.get_rows("shape", 4, 1);
    fit.shape = calibrate::ShapeFit{{}, {row[0], row[1]}, {row[2], row[3]}};
  }
  return fit;
}

}  // namespace lv::pipeline

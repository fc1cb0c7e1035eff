#include "lv/report/quality_sheet.hpp"

#include "lv/base/json_file.hpp"
#include "lv/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::report {
namespace {

using geometry::ImageReport;
using geometry::Residual;
using json = nlohmann::ordered_json;

double ml(double mm3) {
  return 1e-3 * mm3;
}

/// Of all loops of one side on the short axis.
Residual together(const geometry::FitReport& fit, std::optional<Residual> ImageReport::*side) {
  Residual sum;
  for (const ImageReport& image : fit.short_axis)
    if (const auto& r = image.*side) {
      sum.points += r->points;
      sum.mean += r->points * r->mean;
      sum.rms += r->points * r->rms * r->rms;
      sum.max = std::max(sum.max, r->max);
    }
  if (sum.points > 0) {
    sum.mean /= sum.points;
    sum.rms = std::sqrt(sum.rms / sum.points);
  }
  return sum;
}

json distance_json(const std::optional<Residual>& r) {
  if (!r)
    return nullptr;
  return {{"points", r->points}, {"mean_mm", r->mean}, {"rms_mm", r->rms}, {"max_mm", r->max}};
}

json optional_json(const std::optional<double>& value, double factor) {
  return value ? json(factor * *value) : json(nullptr);
}

json slice_json(const ImageReport& image) {
  return {{"slice", image.slice},
          {"endo", distance_json(image.endo)},
          {"epi", distance_json(image.epi)},
          {"endo_area_mm2", optional_json(image.endo_area, 1.0)},
          {"epi_area_mm2", optional_json(image.epi_area, 1.0)},
          {"shift_mm", image.shift.norm()}};
}

std::string change(double value, double reference) {
  return fmt::format("{:+.1f}%", 100.0 * (value / reference - 1.0));
}

/// "195.31 ml; contours 191.30 ml (+2.1%); labels 194.84 ml (+0.2%)"
std::string volumes_text(double fitted, double contours, const std::optional<double>& labels) {
  std::string text = fmt::format("{:.2f} ml", ml(fitted));
  if (contours > 0.0)
    text += fmt::format("; area x slab of the contours {:.2f} ml ({})", ml(contours),
                        change(fitted, contours));
  if (labels && *labels > 0.0)
    text += fmt::format("; voxels {:.2f} ml ({})", ml(*labels), change(fitted, *labels));
  return text;
}

std::string distance_text(const Residual& r) {
  return fmt::format("mean {:.2f}, rms {:.2f}, at most {:.2f} mm ({} points)", r.mean, r.rms, r.max,
                     r.points);
}

std::string thickness_text(const geometry::Thickness& t) {
  return fmt::format("{:.1f} mm near slice {}", t.value, t.slice);
}

int endo_slices(const geometry::FitReport& fit) {
  return static_cast<int>(std::count_if(fit.short_axis.begin(), fit.short_axis.end(),
                                        [](const ImageReport& i) { return i.endo.has_value(); }));
}

}  // namespace

Table quality_table(const QualitySheet& sheet) {
  const geometry::FitReport& fit = sheet.fit;
  Table table({"quantity", "slice", "value", "unit"});
  const auto add = [&](const std::string& quantity, const std::string& slice, double value,
                       const char* unit) {
    table.add_row({quantity, slice, Table::number(value), unit});
  };
  add("cavity_fitted", "", ml(fit.volume_cavity), "ml");
  add("cavity_contours_area_times_slab", "", ml(fit.contour_cavity), "ml");
  if (sheet.label_cavity)
    add("cavity_label_voxels", "", ml(*sheet.label_cavity), "ml");
  add("wall_fitted", "", ml(fit.volume_wall), "ml");
  add("wall_contours_area_times_slab", "", ml(fit.contour_wall), "ml");
  if (sheet.label_muscle)
    add("wall_label_voxels", "", ml(*sheet.label_muscle), "ml");
  add("slices_with_epicardium", "", fit.wall_slices, "-");
  add("slice_spacing", "", fit.slice_spacing, "mm");
  add("base_plane_above_most_basal_slice", "", fit.base_height, "mm");
  add("thinnest_wall", std::to_string(fit.thinnest.slice), fit.thinnest.value, "mm");
  add("thickest_wall", std::to_string(fit.thickest.slice), fit.thickest.value, "mm");
  for (const ImageReport& image : fit.short_axis) {
    const std::string slice = std::to_string(image.slice);
    const auto distances = [&](const char* side, const std::optional<Residual>& r) {
      if (!r)
        return;
      add(fmt::format("{}_distance_mean", side), slice, r->mean, "mm");
      add(fmt::format("{}_distance_max", side), slice, r->max, "mm");
    };
    distances("endo", image.endo);
    distances("epi", image.epi);
    if (image.endo_area)
      add("endo_area", slice, *image.endo_area, "mm2");
    if (image.epi_area)
      add("epi_area", slice, *image.epi_area, "mm2");
    add("shift", slice, image.shift.norm(), "mm");
  }
  return table;
}

std::string quality_json(const QualitySheet& sheet) {
  const geometry::FitReport& fit = sheet.fit;
  json slices = json::array();
  for (const ImageReport& image : fit.short_axis)
    slices.push_back(slice_json(image));
  const json object{
      {"source", sheet.source},
      {"cavity_ml",
       {{"fitted", ml(fit.volume_cavity)},
        {"contours_area_times_slab", ml(fit.contour_cavity)},
        {"label_voxels", optional_json(sheet.label_cavity, 1e-3)}}},
      {"wall_ml",
       {{"fitted", ml(fit.volume_wall)},
        {"contours_area_times_slab", ml(fit.contour_wall)},
        {"slices_with_epicardium", fit.wall_slices},
        {"label_voxels", optional_json(sheet.label_muscle, 1e-3)}}},
      {"wall_thickness_mm", {{"least", fit.thinnest.value}, {"most", fit.thickest.value}}},
      {"slice_spacing_mm", fit.slice_spacing},
      {"base_plane", {{"rule", sheet.base_rule}, {"above_most_basal_slice_mm", fit.base_height}}},
      {"distance_to_contours",
       {{"endo", distance_json(together(fit, &ImageReport::endo))},
        {"epi", distance_json(together(fit, &ImageReport::epi))}}},
      {"slices", slices},
      {"notes", sheet.notes}};
  return json_text(object) + "\n";
}

std::string quality_text(const QualitySheet& sheet) {
  const geometry::FitReport& fit = sheet.fit;
  std::string text = fmt::format("anatomy from {}\n", sheet.source);
  text += fmt::format("  cavity: {}\n",
                      volumes_text(fit.volume_cavity, fit.contour_cavity, sheet.label_cavity));
  text += fmt::format(
      "  wall: {}{}\n", volumes_text(fit.volume_wall, fit.contour_wall, sheet.label_muscle),
      fit.wall_slices < endo_slices(fit)
          ? fmt::format("; {} of {} slices have an epicardium", fit.wall_slices, endo_slices(fit))
          : "");
  text += fmt::format("  wall thickness: {} to {}\n", thickness_text(fit.thinnest),
                      thickness_text(fit.thickest));
  text += fmt::format("  base plane: {} ({:.1f} mm above the most basal slice)\n", sheet.base_rule,
                      fit.base_height);
  text += fmt::format("  distance to the endocardial contours: {}\n",
                      distance_text(together(fit, &ImageReport::endo)));
  text += fmt::format("  distance to the epicardial contours: {}\n",
                      distance_text(together(fit, &ImageReport::epi)));
  for (const ImageReport& image : fit.short_axis)
    if (image.shift.norm() > 0.0)
      text += fmt::format("  slice {} was moved by {:.1f} mm\n", image.slice, image.shift.norm());
  for (const std::string& note : sheet.notes)
    text += fmt::format("  note: {}\n", note);
  return printable_lines(text);
}

}  // namespace lv::report

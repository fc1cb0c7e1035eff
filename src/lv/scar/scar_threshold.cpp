#include "lv/scar/scar_threshold.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace lv::scar {
namespace {

using case_file::Case;

/// The wall's elements as an image shows them.
struct Elements {
  WallGreys wall;
  std::vector<int> segments;  ///< AHA, 1 to 17
};

Elements elements_of(const Case& c, const mesh::Mesh& mesh, const std::vector<double>& greys) {
  return {{greys, mesh::cell_volumes(mesh)}, mesh::divide(mesh, c.regions).aha};
}

std::optional<double> threshold_of(const Elements& all, const std::vector<int>& remote,
                                   double deviations) {
  std::vector<char> chosen;
  for (const int segment : all.segments)
    chosen.push_back(std::find(remote.begin(), remote.end(), segment) != remote.end() ? 1 : 0);
  return above_remote(all.wall, chosen, deviations);
}

/// Volume of the elements whose centre is brighter [ml].
double scar_above(const WallGreys& wall, double threshold) {
  double V = 0.0;
  for (std::size_t e = 0; e < wall.greys.size(); ++e)
    V += wall.greys[e] > threshold ? wall.volumes[e] : 0.0;
  return 1e-3 * V;
}

/// "1: 24.1, 2: 20.3 and so on ml".
std::string scar_by_segment(const Elements& all, double deviations) {
  std::vector<std::string> each;
  for (const int segment : std::set<int>(all.segments.begin(), all.segments.end()))
    if (const auto threshold = threshold_of(all, {segment}, deviations))
      each.push_back(fmt::format("{}: {:.1f}", segment, scar_above(all.wall, *threshold)));
  return fmt::format("{} ml", fmt::join(each, ", "));
}

double by_deviations(const Case& c, const Elements& all) {
  const mesh::LateEnhancement& lge = c.scar.lge;
  const std::string each = scar_by_segment(all, lge.deviations);
  if (lge.remote.empty())
    throw InputError(
        case_file::place_of(c, "infarct.source"),
        fmt::format(
            "infarct.lge.remote is not set; the scar that one segment as remote would make is {}",
            each),
        "Name the AHA segments of remote, healthy muscle, or set threshold = \"fwhm\"");
  const auto threshold = threshold_of(all, lge.remote, lge.deviations);
  if (!threshold)
    throw InputError(case_file::place_of(c, "infarct.lge.remote"),
                     "the image shows nothing of the remote segments",
                     "Name segments between 1 and 17 that the image covers");
  log::info("late enhancement: {:.1f} ml of scar by the remote segments {}; by one alone, {}",
            scar_above(all.wall, *threshold), fmt::join(lge.remote, ", "), each);
  const double brightest = brightest_of(all.wall.greys);
  if (brightest <= *threshold)
    throw InputError(
        case_file::place_of(c, "infarct.lge.remote"),
        fmt::format("nothing of the wall is brighter than the threshold {:.4g}, {:g} standard "
                    "deviations above the mean of the remote segments {}: the brightest is {:.4g}",
                    *threshold, lge.deviations, fmt::join(lge.remote, ", "), brightest),
        "Name segments without scar in infarct.lge.remote, for scar in them raises the threshold; "
        "an image of inverted contrast shows scar dark: invert it. A heart without scar has no "
        "[infarct]");
  return *threshold;
}

/// All pixels of an image, or those of its edge, and of them the one below which a part lies.
double quantile(const image::Cine& image, bool edge_alone, double part) {
  std::vector<float> pixels;
  for (const image::CineSlice& slice : image.slices) {
    const image::Picture& p = slice.frames.front();
    for (int j = 0; j < p.plane.rows; ++j)
      for (int i = 0; i < p.plane.columns; ++i)
        if (!edge_alone || i == 0 || j == 0 || i == p.plane.columns - 1 || j == p.plane.rows - 1)
          pixels.push_back(p.at(i, j));
  }
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(pixels.size() - 1));
  std::nth_element(pixels.begin(), pixels.begin() + at, pixels.end());
  return pixels[static_cast<std::size_t>(at)];
}

/// The grey value of no signal.
double zero_level(const Case& c, const image::Cine& image, double brightest) {
  constexpr double largest_offset = 0.2;  // of the brightest: the threshold is a tenth of it off
  if (case_file::is_set(c, "infarct.lge.zero", case_file::Stage::mesh))
    return c.scar.lge.zero;
  const double darkest = quantile(image, false, 0.01);
  if (brightest > 0.0 && darkest <= largest_offset * brightest)
    return c.scar.lge.zero;
  throw InputError(case_file::place_of(c, "infarct.lge.threshold"),
                   fmt::format("the darkest hundredth of {} reaches {:.4g} where the brightest of "
                               "the wall is {:.4g}: the image has an offset (phase-sensitive "
                               "reconstruction), so that half of the brightest says nothing",
                               c.scar.lge.image, darkest, brightest),
                   fmt::format("Set infarct.lge.zero to the grey value of no signal, that of air "
                               "(the median at the edge of the image is {:.4g})",
                               quantile(image, true, 0.5)));
}

/// Throws InputError for an image of one grey value.
void check_contrast(const Case& c, const image::Cine& image) {
  const double darkest = quantile(image, false, 0.0);
  if (quantile(image, false, 1.0) == darkest)
    throw InputError(case_file::place_of(c, "infarct.lge.image"),
                     fmt::format("{} is constant: all its pixels have the grey value {:.4g}",
                                 c.scar.lge.image, darkest),
                     "Name the image of late enhancement");
}

}  // namespace

double brightest_of(const std::vector<double>& greys) {
  double brightest = -std::numeric_limits<double>::infinity();
  for (const double grey : greys)
    if (grey > brightest)
      brightest = grey;
  return brightest;
}

std::optional<double> above_remote(const WallGreys& wall, const std::vector<char>& remote,
                                   double deviations) {
  double V = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t e = 0; e < wall.greys.size(); ++e) {
    const double grey = wall.greys[e];
    if (std::isnan(grey) || remote[e] == 0)
      continue;
    V += wall.volumes[e];
    first += wall.volumes[e] * grey;
    second += wall.volumes[e] * grey * grey;
  }
  if (V == 0.0)
    return std::nullopt;
  const double mean = first / V;
  return mean + deviations * std::sqrt(std::max(0.0, second / V - mean * mean));
}

double half_of_brightest(const Case& c, const image::Cine& image,
                         const std::vector<double>& greys) {
  const double brightest = brightest_of(greys);
  const double zero = zero_level(c, image, brightest);
  if (zero >= brightest)
    throw InputError(
        case_file::place_of(c, "infarct.lge.zero"),
        fmt::format("nothing of the wall is brighter than {:.4g}: the brightest is {:.4g}", zero,
                    brightest),
        "Give the grey value of air");
  return zero + 0.5 * (brightest - zero);
}

double scar_threshold(const Case& c, const mesh::Mesh& mesh, const image::Cine& image,
                      const std::vector<double>& greys) {
  check_contrast(c, image);
  return c.scar.lge.threshold == mesh::ScarThreshold::fwhm
             ? half_of_brightest(c, image, greys)
             : by_deviations(c, elements_of(c, mesh, greys));
}

}  // namespace lv::scar

#include "lv/anatomy/moments.hpp"

#include "lv/anatomy/drawn.hpp"
#include "lv/base/units.hpp"
#include "lv/image/label_contours.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::anatomy {
namespace {

constexpr std::size_t whole_beat = 5;  // moments that show the course of the volume

Moments among(std::vector<int> numbers, std::vector<double> volumes) {
  Moments m{std::move(numbers), std::move(volumes), 0, 0, {}};
  if (m.numbers.empty())
    return m;
  const image::Phases p = image::propose_phases(m.volumes);
  m.end_diastole = m.numbers[static_cast<std::size_t>(p.end_diastole)];
  m.end_systole = m.numbers[static_cast<std::size_t>(p.end_systole)];
  if (m.numbers.size() >= whole_beat && p.early_diastole != p.end_systole)
    m.early_diastole = m.numbers[static_cast<std::size_t>(p.early_diastole)];
  return m;
}

}  // namespace

double Moments::volume(int number) const {
  const auto found = std::find(numbers.begin(), numbers.end(), number);
  return found == numbers.end() ? 0.0 : volumes[static_cast<std::size_t>(found - numbers.begin())];
}

Moments moments_of(const image::Volume& map, const std::vector<int>& cavity) {
  const std::vector<double> curve = image::volume_curve(map, cavity);
  std::vector<int> numbers;
  std::vector<double> volumes;
  for (std::size_t f = 0; f < curve.size(); ++f)
    if (curve[f] > 0.0) {
      numbers.push_back(static_cast<int>(f) + 1);
      volumes.push_back(curve[f]);
    }
  return among(std::move(numbers), std::move(volumes));
}

Moments moments_of(const std::map<int, geometry::Contours>& drawn) {
  std::vector<int> numbers;
  std::vector<double> volumes;
  for (const auto& [number, contours] : drawn)
    if (const double volume = volume_of(contours); volume > 0.0) {
      numbers.push_back(number);
      volumes.push_back(volume);
    }
  return among(std::move(numbers), std::move(volumes));
}

case_file::CaseLine choice(const std::string& parameter, const Moments& m) {
  if (m.numbers.empty())
    return {parameter, case_file::fill_in, "none shows the cavity"};
  const auto ml = [&](int number) { return 1e-3 * m.volume(number); };
  if (m.early_diastole)
    return {parameter, std::to_string(*m.early_diastole),
            fmt::format("early diastole ({:.1f} ml), whose shape is taken as free of stress; "
                        "end-diastole seems {} ({:.1f} ml), end-systole {} ({:.1f} ml)",
                        ml(*m.early_diastole), m.end_diastole, ml(m.end_diastole), m.end_systole,
                        ml(m.end_systole))};
  if (m.numbers.size() == 1)
    return {parameter, std::to_string(m.numbers.front()),
            fmt::format("the only one ({:.1f} ml)", ml(m.numbers.front()))};
  return {parameter, std::to_string(m.end_diastole),
          fmt::format("end-diastole ({:.1f} ml); end-systole seems {} ({:.1f} ml)",
                      ml(m.end_diastole), m.end_systole, ml(m.end_systole))};
}

case_file::CaseLine unloading_line(const std::string& comment) {
  const case_file::Case defaults;
  return {"unloaded.pressure",
          case_file::quoted(fmt::format("{:g} mmHg", defaults.protocol.ed_pressure / units::mmHg)),
          comment};
}

std::string end_diastole_note(const case_file::Case& c, const std::string& which) {
  if (case_file::is_loaded(c))
    return "";
  return fmt::format(
      "{}, and its shape is taken as free of stress: a wall that is filled already will be filled "
      "once more. Set unloaded.pressure to the pressure that it bears (such as that of "
      "protocol.ed_pressure), or choose early diastole",
      which);
}

std::string end_diastole_note(const case_file::Case& c, const Moments& m, int chosen) {
  if (m.numbers.size() < 2 || chosen != m.end_diastole)
    return "";
  return end_diastole_note(
      c, fmt::format("number {} of {} seems to be end-diastole ({:.1f} ml, the largest)", chosen,
                     m.numbers.size(), 1e-3 * m.volume(chosen)));
}

}  // namespace lv::anatomy

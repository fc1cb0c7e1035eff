#include "lv/beating_wall/activation.hpp"

#include "lv/activation/sites.hpp"
#include "lv/activation/times_file.hpp"
#include "lv/base/check.hpp"
#include "lv/base/log.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::beating_wall {
namespace {

using case_file::Case;

std::vector<double> times_by_front(const Case& c, const anatomy::MeshResult& mesh) {
  const activation::Speeds& speeds = c.activation.speeds;
  activation::ActivatedWall wall{
      mesh.mesh, mesh.regions, {}, case_file::place_of(c, "activation.sites")};
  for (const Mat3& frame : activation::cell_frames(mesh.mesh))
    wall.metrics.push_back(activation::travel_metric(frame, speeds));
  std::vector<activation::Start> starts;
  for (const std::string& words : c.activation.sites) {
    const auto more = activation::starts_at(activation::site_of(words), wall);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  return activation::arrival_times(mesh.mesh, wall.metrics, speeds, starts);
}

}  // namespace

std::vector<double> activation_times(const Case& c, const anatomy::MeshResult& mesh) {
  std::vector<double> times;
  if (c.activation.kind == activation::Kind::eikonal)
    times = times_by_front(c, mesh);
  else if (c.activation.kind == activation::Kind::file)
    times = activation::read_times({case_file::beside(c, c.activation.file).string(),
                                    c.activation.array, c.activation.time_unit},
                                   mesh.mesh);
  if (times.empty())
    return times;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  log::info("activation reaches the wall from {:.1f} to {:.1f} ms", 1e3 * *first, 1e3 * *last);
  if (*last >= c.circulation.period)
    throw InputError(
        case_file::place_of(c, "activation.kind"),
        fmt::format("activates the last muscle after {:.4g} s, when the next beat has begun "
                    "(circulation.period {:g} s)",
                    *last, c.circulation.period),
        "Look at the speeds, the sites or the unit of the file (activation.time_unit)");
  return times;
}

}  // namespace lv::beating_wall

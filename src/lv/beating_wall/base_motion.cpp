#include "lv/beating_wall/base_motion.hpp"

#include "lv/cine/strain.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::beating_wall {

using case_file::Case;

Case with_base_of_cine(Case c, const std::filesystem::path& strain) {
  c.base_motion.file = std::filesystem::absolute(strain / cine::base_motion_name).string();
  return c;
}

heartbeat::MeasuredMotion measured_base_motion(const Case& c) {
  return heartbeat::read_motion(
      {case_file::beside(c, c.base_motion.file).string(), c.circulation.period});
}

heartbeat::BaseMotion base_motion(const Case& c, const mesh::Mesh& mesh) {
  if (c.base_motion.file.empty())
    return {};
  const double period = c.circulation.period;
  const bool has_atria = c.circulation.kind == circulation::Kind::closed_loop;
  return {measured_base_motion(c),
          solid::base_frame(mesh, c.regions.septum_angle),
          {period, has_atria ? c.circulation.left_ventricle.t_C : 0.0, c.base_motion.zero}};
}

std::string base_away_from_apex(const Case& c) {
  if (c.base_motion.file.empty())
    return "";
  double towards = 0.0;
  double away = 0.0;
  const std::vector<solid::BasePose> poses = measured_base_motion(c).poses;
  for (const solid::BasePose& p : poses) {
    towards = std::max(towards, p.axial - poses.front().axial);
    away = std::max(away, poses.front().axial - p.axial);
  }
  if (away <= towards)
    return "";
  return fmt::format(
      "{} moves the base away from the apex by {:.1f} mm from where a beat begins, "
      "and towards it by {:.1f} mm: a contracting ventricle pulls it towards the "
      "apex, which is positive in axial_mm",
      c.base_motion.file, away, towards);
}

}  // namespace lv::beating_wall

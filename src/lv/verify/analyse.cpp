#include "lv/verify/analyse.hpp"

#include "lv/base/parallel.hpp"

namespace lv::verify {

Analysis analyse(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                 const solid::CardiacModel& heart) {
  const analysis::FieldAnalysis analysis(mesh, heart);
  Analysis a{{analysis.at_rest(), {}}, {}};
  for (const heartbeat::NamedMoment& m : beat.moments)
    a.fields.moments.push_back({m.name, analysis.fields(m.wall)});
  if (parallel::is_root())
    a.results = analysis::results(mesh, mesh::divide(mesh, {}), beat, a.fields);
  return a;
}

}  // namespace lv::verify

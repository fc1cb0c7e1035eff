#include "lv/verify/analyse.hpp"

#include "lv/base/parallel.hpp"

namespace lv::verify {

Analysis analyse(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                 const solid::CardiacModel& heart) {
  const analysis::FieldAnalysis analysis(mesh, heart);
  Analysis a{
      {analysis.at_rest(), analysis.fields(beat.end_diastole), analysis.fields(beat.end_systole)},
      {}};
  if (parallel::is_root())
    a.results = analysis::results(mesh, mesh::divide(mesh, {}), beat, a.fields);
  return a;
}

}  // namespace lv::verify

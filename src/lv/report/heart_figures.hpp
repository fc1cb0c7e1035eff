#pragma once

#include "lv/analysis/results.hpp"
#include "lv/report/figure.hpp"

namespace lv::report {

/// The undeformed wall from outside and cut open along its long axis, with the edges of its
/// elements.
[[nodiscard]] Figure mesh_figure(const mesh::Mesh& mesh);

/// The fibres of the undeformed wall on the epicardium and the endocardium, and the helix angle in
/// a long-axis section.
[[nodiscard]] Figure fibre_figure(const mesh::Mesh& mesh,
                                  const std::vector<analysis::CellFields>& undeformed);

/// The extent of the infarct, M, on the undeformed wall: from outside, from inside, and in a
/// long-axis section through the infarct's middle.
[[nodiscard]] Figure infarct_figure(const mesh::Mesh& mesh);

/// The wall cut open at early diastole, end-diastole and end-systole, coloured by the fibre
/// stretch, all by one camera.
[[nodiscard]] Figure states_figure(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                                   const analysis::BeatFields& fields);

/// The Cauchy stress along the fibre at end-diastole and end-systole, and the active tension at
/// end-systole.
[[nodiscard]] Figure stress_figure(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                                   const analysis::BeatFields& fields);

}  // namespace lv::report

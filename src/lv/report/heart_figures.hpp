#pragma once

#include "lv/analysis/results.hpp"
#include "lv/drawing/figure.hpp"

namespace lv::report {

// Views are those of orientation.hpp, with letters and a bar of scale: long axes have the base up,
// the four-chamber view has the septum on the left; short axes are seen from the apex, anterior up.
// What was assumed of the anatomy has stars.

/// The undeformed wall from the anterior side, cut open in the four-chamber view, and from the
/// apex, with the edges of its elements.
[[nodiscard]] drawing::Figure mesh_figure(const mesh::Mesh& mesh,
                                          const drawing::Orientation& orientation);

/// The fibres of the undeformed wall on the epicardium and the endocardium, and the helix angle in
/// a four-chamber section.
[[nodiscard]] drawing::Figure fibre_figure(const mesh::Mesh& mesh,
                                           const std::vector<analysis::CellFields>& undeformed,
                                           const drawing::Orientation& orientation);

/// The extent of the infarct, M, on the undeformed wall: from outside with the infarct in front, in
/// a short-axis section through the infarct's middle, and cut open in both long-axis views.
[[nodiscard]] drawing::Figure infarct_figure(const mesh::Mesh& mesh,
                                             const drawing::Orientation& orientation);

/// The wall at early diastole, end-diastole and end-systole, coloured by the fibre stretch: cut
/// open in the four-chamber view, and below it the middle short-axis section, all by one camera.
[[nodiscard]] drawing::Figure states_figure(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                                            const analysis::BeatFields& fields,
                                            const drawing::Orientation& orientation);

/// In the same views, the Cauchy stress along the fibre at end-diastole and end-systole, and the
/// active tension at end-systole.
[[nodiscard]] drawing::Figure stress_figure(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                                            const analysis::BeatFields& fields,
                                            const drawing::Orientation& orientation);

}  // namespace lv::report

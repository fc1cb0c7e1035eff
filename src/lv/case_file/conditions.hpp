#pragma once

#include "lv/case_file/parameters.hpp"
#include "lv/image/volume_file.hpp"

/// What a case must be like for parameters to count, for parameters.cpp.
namespace lv::case_file::conditions {

using Source = AnatomySource;
using Scar = mesh::InfarctSource;

/// A fit and the search for the wall without load work on the quasi-static engine, whatever engine
/// runs the beat.
inline bool is_static(const Case& c, Stage s) {
  return c.engine == EngineChoice::quasi_static || s == Stage::calibrate || s == Stage::unload;
}
inline bool may_have_infarct(const Case& c) {
  return c.scar.source == Scar::mesh ? c.anatomy.source == Source::mesh
                                     : c.scar.source != Scar::none;
}
/// A fit before the beat runs heartbeats only if it is to them.
inline bool beats_in(const Case& c, Stage s) {
  return is_cycle(c) && (s != Stage::calibrate || c.calibration.cycle);
}
/// By itself it always may run; with the wall it does in a cycle.
inline bool has_circuit(const Case& c, Stage s) {
  return c.circulation.asked() && (s == Stage::circulation || beats_in(c, s));
}
inline bool has_passive_fit(const Case& c) {
  return c.calibration.passive != calibrate::FittedPassive::none;
}
inline bool has_kinetics(const Case& c) {
  return c.active_law == ActiveChoice::niederer || c.active_law == ActiveChoice::land2017;
}
inline bool has_alpha_function(const Case& c) {
  return c.protocol.calcium.shape == material::Calcium::CurveShape::alpha_function;
}

#define LV_DRAWN                                                                          \
  "for a wall that is drawn (anatomy.source = \"contours\", \"labels\", \"sunnybrook\", " \
  "\"guide_points\", \"cine\", \"contour_file\" or \"surfaces\")"

#define LV_CONDITION(name, holds, words)                                                      \
  inline constexpr Condition name{                                                            \
      []([[maybe_unused]] const Case& c, [[maybe_unused]] Stage s) -> bool { return holds; }, \
      words};

/// One choice of a parameter that is called as its place in the case is.
#define LV_CHOSEN(name, member, Choice, word) \
  LV_CONDITION(name, c.member == Choice::word, "with " #member " = \"" #word "\"")

// engines
LV_CHOSEN(immersed_engine, engine, EngineChoice, immersed)
LV_CONDITION(static_engine, is_static(c, s),
             "with engine = \"quasi_static\", with a fit ([calibrate]) or with a wall to unload "
             "([unloaded])")
LV_CHOSEN(static_beat, engine, EngineChoice, quasi_static)
LV_CONDITION(iterative,
             c.quasi_static.solver.newton.linear.method == implicit::LinearMethod::iterative,
             "with quasi_static.linear_solver = \"iterative\"")
LV_CHOSEN(quadrature, coupling.kind, immersed::CouplingKind, quadrature)
LV_CONDITION(mean_dilatations, c.volumetric_points == material::VolumetricPoints::mean,
             "with volumetric.points = \"mean\"")
LV_CONDITION(heartbeats, beats_in(c, s), "with protocol.kind = \"cycle\"")
LV_CONDITION(of_beats, s != Stage::calibrate || c.calibration.cycle, "of the beat")
LV_CONDITION(paper_protocol, s == Stage::calibrate ? c.calibration.fits_muscle() : !is_cycle(c),
             "with protocol.kind = \"paper\"")
LV_CONDITION(no_beats, !is_cycle(c), "with protocol.kind = \"paper\"")
LV_CONDITION(filled_in_time, c.engine == EngineChoice::immersed || !is_cycle(c),
             "with engine = \"immersed\" or protocol.kind = \"paper\"")
LV_CONDITION(calcium_in_time,
             s == Stage::calibrate ? beats_in(c, s)
                                   : c.engine == EngineChoice::immersed || is_cycle(c),
             "with engine = \"immersed\" or protocol.kind = \"cycle\"")
LV_CONDITION(
    rates,
    (c.engine == EngineChoice::immersed && s == Stage::beat) ||
        (beats_in(c, s) && s != Stage::unload),
    "with engine = \"immersed\" or protocol.kind = \"cycle\", for without time nothing has a rate")
LV_CONDITION(static_rates, beats_in(c, s) && s != Stage::unload,
             "with protocol.kind = \"cycle\", for without time nothing has a rate")
LV_CONDITION(inertia, c.protocol.cycle.inertia, "with cycle.inertia = true")
LV_CONDITION(elastic_base, c.base.kind == solid::BasalSupport::Kind::elastic,
             "with base.support = \"elastic\"")
LV_CONDITION(rigid_base, c.base.kind != solid::BasalSupport::Kind::elastic,
             "with base.support = \"sliding\" or \"fixed\"")
LV_CONDITION(
    beats_of_moving_base, beats_in(c, s),
    "with protocol.kind = \"cycle\" (a motion over the beat says nothing to loads without a time)")
LV_CONDITION(moving_base, c.base_motion.source != heartbeat::BaseMotionSource::none,
             "with base.motion = \"table\" or \"cine\"")
LV_CONDITION(base_table, c.base_motion.source == heartbeat::BaseMotionSource::table,
             "with base.motion = \"table\"")
// dashpots alone are none where nothing has a rate
LV_CONDITION(pericardium,
             c.surroundings.epicardium.has_springs() ||
                 (rates.holds(c, s) && c.surroundings.epicardium.has_dashpots()),
             "with springs or dashpots of the pericardium")
LV_CONDITION(weighted_pericardium,
             c.surroundings.epicardium.weight.shape != solid::AxialWeight::WeightShape::even,
             "with pericardium.weight = \"linear\" or \"sigmoid\"")
LV_CONDITION(sigmoid_pericardium,
             c.surroundings.epicardium.weight.shape == solid::AxialWeight::WeightShape::sigmoid,
             "with pericardium.weight = \"sigmoid\"")
LV_CHOSEN(eikonal, activation.kind, activation::Kind, eikonal)
LV_CHOSEN(activation_file, activation.kind, activation::Kind, file)
LV_CONDITION(held_calcium, c.protocol.calcium.mode == material::Calcium::Mode::hold,
             "with calcium.mode = \"hold\"")

// anatomy
LV_CHOSEN(ellipsoid, anatomy.source, Source, ellipsoid)
LV_CHOSEN(from_contours, anatomy.source, Source, contours)
LV_CHOSEN(from_labels, anatomy.source, Source, labels)
LV_CHOSEN(from_sunnybrook, anatomy.source, Source, sunnybrook)
LV_CHOSEN(from_guide_points, anatomy.source, Source, guide_points)
LV_CHOSEN(from_cine, anatomy.source, Source, cine)
LV_CHOSEN(from_contour_file, anatomy.source, Source, contour_file)
LV_CHOSEN(from_surfaces, anatomy.source, Source, surfaces)
LV_CHOSEN(from_mesh, anatomy.source, Source, mesh)
LV_CONDITION(tagged, c.anatomy.mesh.import.sides == mesh::SideSource::tags,
             "with anatomy.mesh.sides = \"tags\"")
LV_CONDITION(drawn, is_drawn(c), LV_DRAWN)
LV_CONDITION(fitted, s == Stage::strain ? !c.strain.long_axis_cine.empty() : is_drawn(c),
             LV_DRAWN ", or with strain.long_axis_cine")
LV_CONDITION(base_may_tilt,
             s == Stage::strain ? !c.strain.long_axis_cine.empty()
                                : is_drawn(c) && c.anatomy.source != Source::surfaces,
             "for a wall that is drawn in slices (anatomy.source = \"contours\", \"labels\", "
             "\"sunnybrook\", \"guide_points\", \"cine\" or \"contour_file\"; surfaces are cut "
             "across the long axis), or with strain.long_axis_cine")
LV_CONDITION(septum_shown, s == Stage::strain ? !c.strain.septum_point : is_drawn(c),
             LV_DRAWN ", or with strain.cine and no strain.septum_point")

// fibres
LV_CONDITION(fibres_given, !c.anatomy.mesh.import.fibres.empty(), "with anatomy.mesh.fibres")
LV_CONDITION(fibres_by_rule,
             c.anatomy.source != Source::mesh || c.anatomy.mesh.import.fibres.empty(),
             "without anatomy.mesh.fibres, which brings the directions")
LV_CONDITION(sheets_by_rule,
             c.anatomy.source != Source::mesh || c.anatomy.mesh.import.sheets.empty(),
             "without anatomy.mesh.sheets, which brings the directions")

// meshes
LV_CONDITION(meshed_here, c.anatomy.source != Source::mesh,
             "for a wall that is meshed here, of every anatomy.source but \"mesh\"")
LV_CONDITION(linear_elements,
             c.quasi_static.order == 1 || (s == Stage::mesh && c.engine == EngineChoice::immersed),
             "with engine = \"immersed\", or with quasi_static.order = 1")
LV_CONDITION(quadratic_elements, c.quasi_static.order == 2, "with quasi_static.order = 2")

// the infarct
LV_CONDITION(infarcted, may_have_infarct(c), "with an infarct (infarct.source)")
LV_CONDITION(infarct_of_mesh, c.scar.source == Scar::mesh, "with infarct.source = \"mesh\"")
LV_CONDITION(infarct_laid_on, c.scar.source != Scar::mesh && c.scar.source != Scar::none,
             "with infarct.source = \"described\", \"elements\", \"surface\", \"labels\", "
             "\"strain\" or \"lge\"")
LV_CONDITION(infarct_described, c.scar.source == Scar::described,
             "with infarct.source = \"described\"")
LV_CONDITION(infarct_of_elements, c.scar.source == Scar::elements,
             "with infarct.source = \"elements\"")
LV_CONDITION(infarct_of_surface, c.scar.source == Scar::surface,
             "with infarct.source = \"surface\"")
LV_CONDITION(infarct_of_labels, c.scar.source == Scar::labels, "with infarct.source = \"labels\"")
LV_CONDITION(infarct_of_strain, c.scar.source == Scar::strain, "with infarct.source = \"strain\"")
LV_CONDITION(infarct_of_lge, c.scar.source == Scar::lge, "with infarct.source = \"lge\"")
LV_CONDITION(infarct_of_images, c.scar.source == Scar::labels || c.scar.source == Scar::lge,
             "with infarct.source = \"labels\" or \"lge\"")
LV_CONDITION(infarct_without_unit,
             c.scar.source == Scar::surface ||
                 (c.scar.source == Scar::labels && !image::is_volume_name(c.scar.labels)),
             "with infarct.source = \"surface\", or \"labels\" whose file is of VTK")
LV_CONDITION(labels_in_image, c.scar.labels.empty() || image::is_volume_name(c.scar.labels),
             "where infarct.labels.file is NIfTI, NRRD or MetaImage")
LV_CONDITION(labels_in_vtk, !image::is_volume_name(c.scar.labels),
             "where infarct.labels.file is of VTK")
LV_CONDITION(moved_labels, c.scar.in_plane, "with infarct.labels.in_plane = true")
LV_CONDITION(lge_in_dicom, !image::is_volume_name(c.scar.lge.image),
             "where infarct.lge.image is a folder of DICOM files")
LV_CONDITION(threshold_sd, c.scar.lge.threshold == mesh::ScarThreshold::sd,
             "with infarct.lge.threshold = \"sd\"")
LV_CONDITION(threshold_fwhm, c.scar.lge.threshold == mesh::ScarThreshold::fwhm,
             "with infarct.lge.threshold = \"fwhm\"")
LV_CONDITION(moved_lge, c.scar.lge.in_plane, "with infarct.lge.in_plane = true")
LV_CONDITION(fitted_or_moved,
             s == Stage::strain    ? !c.strain.long_axis_cine.empty()
             : s == Stage::anatomy ? is_drawn(c)
                                   : c.scar.source == Scar::labels && c.scar.in_plane,
             LV_DRAWN ", with strain.long_axis_cine, or with infarct.labels.in_plane")

// muscle and blood
LV_CHOSEN(holzapfel_ogden, passive.law, PassiveChoice, holzapfel_ogden)
LV_CHOSEN(guccione, passive.law, PassiveChoice, guccione)
LV_CHOSEN(neo_hookean, passive.law, PassiveChoice, neo_hookean)
LV_CONDITION(niederer, c.active_law == ActiveChoice::niederer, "with active.law = \"niederer\"")
LV_CONDITION(land2017, c.active_law == ActiveChoice::land2017, "with active.law = \"land2017\"")
LV_CONDITION(prescribed_tension, !has_kinetics(c),
             "with active.law = \"second_piola\" or \"cauchy\"")
LV_CONDITION(moving_fibres,
             (c.engine == EngineChoice::immersed && s == Stage::beat) ||
                 (beats_in(c, s) && s != Stage::unload),
             "with engine = \"immersed\" or protocol.kind = \"cycle\"")
LV_CONDITION(calcium_counts, has_kinetics(c) || moving_fibres.holds(c, s),
             "with active.law = \"niederer\" or \"land2017\", or with engine = \"immersed\"")
LV_CONDITION(alpha_function, has_alpha_function(c), "with calcium.shape = \"alpha_function\"")
LV_CONDITION(double_exponential, !has_alpha_function(c),
             "with calcium.shape = \"double_exponential\"")
LV_CONDITION(mass_counts,
             s == Stage::results || (s == Stage::beat || s == Stage::calibrate
                                         ? c.protocol.cycle.inertia && beats_in(c, s)
                                         : may_have_infarct(c)),
             "for the masses of wall and infarct, and with cycle.inertia = true")

// circulation
LV_CONDITION(circuit, has_circuit(c, s),
             "with circulation.kind = \"windkessel\" or \"closed_loop\"")
LV_CONDITION(windkessel, has_circuit(c, s) && c.circulation.kind == circulation::Kind::windkessel,
             "with circulation.kind = \"windkessel\"")
LV_CONDITION(closed_loop, has_circuit(c, s) && c.circulation.kind == circulation::Kind::closed_loop,
             "with circulation.kind = \"closed_loop\"")
LV_CONDITION(onset_counts,
             s == Stage::circulation ||
                 (has_circuit(c, s) && c.circulation.kind == circulation::Kind::closed_loop),
             "with circulation.kind = \"windkessel\" or \"closed_loop\"")
LV_CHOSEN(quadratic_valves, circulation.valves.law, circulation::ValveLaw, quadratic)

// measurements
LV_CONDITION(fit, c.calibration.asked(),
             "with a fit: set calibrate.passive, calibrate.active or calibrate.cycle")
LV_CONDITION(passive_fit, has_passive_fit(c), "with a passive fit: set calibrate.passive")
LV_CONDITION(exponent_fit,
             c.calibration.passive == calibrate::FittedPassive::scale_and_exponent ||
                 c.calibration.passive == calibrate::FittedPassive::klotz,
             "with calibrate.passive = \"scale_and_exponent\" or \"klotz\"")
LV_CONDITION(klotz_fit, c.calibration.passive == calibrate::FittedPassive::klotz,
             "with calibrate.passive = \"klotz\"")
LV_CONDITION(edv_fit,
             c.calibration.cycle ||
                 (has_passive_fit(c) && c.calibration.passive != calibrate::FittedPassive::klotz),
             "with a passive fit: set calibrate.passive (to another than \"klotz\"), or with "
             "calibrate.cycle = true")
LV_CONDITION(esv_fit, c.calibration.cycle || c.calibration.active,
             "with calibrate.active = true or calibrate.cycle = true")
LV_CONDITION(fit_to_beats, c.calibration.cycle, "with calibrate.cycle = true")
LV_CONDITION(active_fit, c.calibration.active, "with calibrate.active = true")
LV_CONDITION(strains_given, !c.calibration.strains.empty(), "with calibrate.strains")
LV_CONDITION(segments_fitted, c.calibration.contractility == FittedContractility::segments,
             "with calibrate.contractility = \"segments\"")
LV_CONDITION(shape_fit, c.calibration.shape, "with calibrate.shape = true")
LV_CONDITION(fit_to_regions, c.calibration.shape || !c.calibration.strains.empty(),
             "with calibrate.strains or calibrate.shape = true")
LV_CONDITION(loaded, c.unloaded.pressure > 0.0, "with unloaded.pressure above 0")
LV_CONDITION(cine, c.strain.asked(), "with the images of strain.cine")
LV_CONDITION(measured, !c.strain.measured.empty(), "with strain.measured")

#undef LV_CHOSEN
#undef LV_CONDITION
#undef LV_DRAWN

}  // namespace lv::case_file::conditions

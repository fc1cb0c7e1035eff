#pragma once

#include "lv/activation/parameters.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/fit.hpp"
#include "lv/circulation/parameters.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/geometry/parameters.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/image/sunnybrook.hpp"
#include "lv/immersed/model.hpp"
#include "lv/implicit/engine.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh/wall_mesh.hpp"
#include "lv/segment/segment.hpp"
#include "lv/strain/warp.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::case_file {

/// Where the ventricle's shape comes from.
enum class AnatomySource {
  ellipsoid,
  contours,
  mesh,
  labels,
  sunnybrook,
  guide_points,
  cine,
  contour_file,
  surfaces
};

/// Which passive law the wall follows.
enum class PassiveChoice { holzapfel_ogden, guccione, neo_hookean };

/// Which active law the wall follows; `second_piola` and `cauchy` are forms of a prescribed
/// tension.
enum class ActiveChoice { niederer, second_piola, cauchy, land2017 };

/// Which solver runs the beat.
enum class EngineChoice { immersed, quasi_static };

/// Where the base plane lies; `automatic`: as is usual for the source.
enum class BaseChoice { automatic, slice, slab, annulus };

/// Contours, and how surfaces are fitted to contours of whatever source. File names as the case
/// file gives them.
struct ContourAnatomy {
  std::string short_axis, long_axis, apex_endo, apex_epi;
  std::string es_short_axis;  ///< drawn at end-systole, for comparison
  std::string landmarks;      ///< points that an observer named
  BaseChoice base_at = BaseChoice::automatic;
  geometry::SplineFitParameters fit;
};

/// A map of labels and what they mean.
struct LabelAnatomy {
  std::string file;                                  ///< of voxels, or a DICOM segmentation
  std::vector<int> cavity, muscle, right_ventricle;  ///< empty: not said
  int frame = 0;                                     ///< from 1; 0: the only one
};

/// Contours in pixels of DICOM images.
struct SunnybrookAnatomy {
  std::string contours, dicom;      ///< folders
  std::vector<std::string> series;  ///< of the DICOM files; empty: the only one
  int phase = 0;                    ///< from 1 in order of time; 0: not said
  image::PixelOrigin pixel_origin = image::PixelOrigin::corner;
  image::DrawnBy drawn_by = image::DrawnBy::manual;
};

/// Contours in a file of another program.
struct ContourFileAnatomy {
  std::string file;
  std::string images;               ///< folder of the DICOM images they were drawn on; may be empty
  std::vector<std::string> series;  ///< of these; empty: the only one
  std::string endo, epi;            ///< names of structures; empty: as the format fixes them
  int phase = 0;                    ///< from 1 in order of time; 0: the only one
};

/// In which space the coordinates of surfaces are; `stated`: as their files say.
// NOLINTNEXTLINE(readability-identifier-naming): as files call them
enum class SurfaceSpace { stated, LPS, RAS };

/// Endocardium and epicardium as surfaces of triangles.
struct SurfaceAnatomy {
  std::string endo, epi;
  double unit = 0.0;  ///< length of the files' unit [mm]; 0: not said
  SurfaceSpace space = SurfaceSpace::stated;
};

/// A list of points.
struct GuidePointAnatomy {
  std::string file;
  int frame = -1;  ///< -1: the only one
  geometry::Side apex_point = geometry::Side::epi;
};

/// At which time of a cine the shape is taken.
enum class ShapeMoment { early_diastole, end_diastole };

/// A short-axis cine in which the program draws the borders.
struct CineAnatomy {
  std::string images, series;          ///< a DICOM folder or a NIfTI file
  std::vector<std::string> long_axis;  ///< long-axis cines: files, or series of that folder
  segment::SegmentParameters segmentation;
  ShapeMoment moment = ShapeMoment::early_diastole;
};

/// A mesh made elsewhere.
struct MeshAnatomy {
  mesh::ImportParameters import;  ///< file name as the case file gives it
  int refinements = 0;            ///< each cuts every element into eight
};

struct Anatomy {
  AnatomySource source = AnatomySource::ellipsoid;
  geometry::Ellipsoid ellipsoid;
  ContourAnatomy contours;
  MeshAnatomy mesh;
  LabelAnatomy labels;
  SunnybrookAnatomy sunnybrook;
  GuidePointAnatomy guide_points;
  CineAnatomy cine;
  ContourFileAnatomy contour_file;
  SurfaceAnatomy surfaces;
};

struct Passive {
  PassiveChoice law = PassiveChoice::holzapfel_ogden;
  material::HolzapfelOgden holzapfel_ogden;
  double C_a = 1.0;  ///< factor of a_f, a_s, a_fs (2.25)
  material::Guccione guccione;
  material::NeoHookean neo_hookean;
};

/// The box Omega around the ventricle.
struct Box {
  std::array<double, 3> size{150.0, 150.0, 200.0};  ///< [mm]
  std::array<int, 3> cells{96, 96, 128};
};

/// The quasi-static engine and the mesh that it works on.
struct QuasiStatic {
  int order = 2;             ///< of its finite elements
  double edge_length = 7.0;  ///< target, of quadratic elements [mm]
  int layers = 0;            ///< quadratic elements through the wall; 0: as edge_length asks
  double apex = 0.3, endocardium = 0.5;  ///< see mesh::WallMeshParameters
  material::Volumetric stabilisation = implicit::StaticModel::default_stabilisation;
  implicit::SolverParameters solver;
};

/// Which measure of strain a file holds: E = (lambda^2 - 1)/2 or lambda - 1.
enum class StrainMeasure { green_lagrange, engineering };

/// An infarct from strain alone: parts of the wall that shorten by less. The threshold is that of
/// feature tracking against late enhancement in patients (docs/infarct.md).
struct StrainInfarct {
  std::string file;  ///< of regional strains
  StrainMeasure measure = StrainMeasure::green_lagrange;
  double threshold = -0.0756;  ///< of circumferential l/L - 1 at end-systole
  double error = 0.03;         ///< standard deviation of those strains
};

/// Whether contractility is fitted as one number or beside it with a factor of each AHA segment.
enum class FittedContractility { even, segments };

/// Which parameters are fitted to which measured volumes, at the pressures of the protocol, and to
/// which data of heartbeats.
struct Calibration {
  calibrate::FittedPassive passive = calibrate::FittedPassive::none;
  bool active = false;
  bool cycle = false;           ///< circulation and contractility to what heartbeats come to
  double edv = 0.0, esv = 0.0;  ///< 0: not measured [mm^3]
  double cuff_systolic = 0.0, cuff_diastolic = 0.0;  ///< of heartbeats; 0: not measured [kPa]
  double tolerance = 0.01;                           ///< of volumes and pressures, as a fraction
  calibrate::Range stiffness{0.05, 50.0};
  calibrate::Range exponent{0.2, 5.0};
  calibrate::Range T_scale{0.1, 20.0};
  calibrate::Range factor{0.1, 10.0};  ///< of what is fitted to heartbeats, to the case's values
  std::string strains;                 ///< file of regional strains, fitted to besides; empty: none
  StrainMeasure strain_measure = StrainMeasure::green_lagrange;  ///< of that file
  bool shape = false;        ///< the surfaces that are drawn at end-systole are fitted to besides
  calibrate::Errors errors;  ///< of what was measured, which weigh it
  FittedContractility contractility = FittedContractility::even;
  double contractility_spread = 0.5;  ///< standard deviation of ln factor over segments beforehand
  bool confirm = false;               ///< with the immersed engine
  /// By which the end-diastolic pressure of a fit to Klotz's curve may be off: fitted anew [kPa].
  double pressure_error = 4.0 * units::mmHg;

  /// Whether parameters of the muscle are fitted at given pressures.
  [[nodiscard]] bool fits_muscle() const {
    return passive != calibrate::FittedPassive::none || active;
  }
  [[nodiscard]] bool asked() const { return fits_muscle() || cycle; }
};

/// Strain measured from cine images, or by somebody else. File names as the case file gives them.
struct StrainStudy {
  std::string cine, series;                 ///< short-axis images
  std::vector<std::string> long_axis_cine;  ///< long-axis images
  std::string contours, long_axis;          ///< drawn at end-diastole
  std::string es_contours;                  ///< drawn at end-systole, for comparison
  int end_diastole = 1, end_systole = 0;    ///< numbers of the images in order of time
  std::optional<std::array<double, 3>> septum_point;
  strain::RegistrationParameters registration;
  std::string measured, measured_column;  ///< a table of strains instead of images
  StrainMeasure measured_kind = StrainMeasure::engineering;

  [[nodiscard]] bool asked() const { return !cine.empty(); }
};

/// A family of heartbeats around those of the case: the factors that each list names, see
/// circulation::Factors.
struct Study {
  std::vector<double> preload, afterload, contractility, heart_rate;

  [[nodiscard]] bool asked() const {
    return !(preload.empty() && afterload.empty() && contractility.empty() && heart_rate.empty());
  }
};

/// All that a case file says, checked once and constant from then on. Member initialisers are the
/// defaults; names, units, ranges and meanings are in parameters.cpp.
struct Case {
  std::string name = "ventricle";
  Anatomy anatomy;
  mesh::WallMeshParameters mesh;
  mesh::FibreRule fibres;
  mesh::RegionParameters regions;
  Passive passive;
  material::Volumetric volumetric;
  material::VolumetricPoints volumetric_points = material::VolumetricPoints::mean;
  material::Volumetric stabilisation = material::Myocardium::stabilisation_of_heartbeats;
  ActiveChoice active_law = ActiveChoice::niederer;
  double prescribed_tension = 60.0;  ///< of second_piola and cauchy [kPa]
  material::NiedererHunterSmith active;
  material::Land2017 land2017;
  mesh::InfarctParameters scar;  ///< where the infarct is
  StrainInfarct scar_strain;
  material::InfarctScaling infarct;
  std::string contractility_file;  ///< factors of the tension by AHA segment; empty: 1
  std::optional<mesh::SegmentFactors> fitted_contractility;  ///< instead
  double muscle_density = 1.05e-6;  ///< of printed masses, and of a wall with inertia [kg/mm^3]
  material::Viscosity viscosity;
  double bulk_modulus = 0.0;  ///< of the implicit engine's wall; 0: incompressible [kPa]
  fluid::Blood blood;
  Box box;
  immersed::CouplingParameters coupling;
  solid::BasalSupport base;
  heartbeat::BaseMotionParameters base_motion;
  solid::Surroundings surroundings;
  double septal_pressure = 0.0;  ///< as a part of the cavity's
  activation::ActivationParameters activation;
  EngineChoice engine = EngineChoice::immersed;
  QuasiStatic quasi_static;
  implicit::UnloadParameters unloaded{.tolerance = 0.05};
  Calibration calibration;
  StrainStudy strain;
  circulation::CircuitParameters circulation;
  heartbeat::Protocol protocol;
  double cuff_systolic = 0.0;  ///< of a cuff on the arm; 0: not measured [kPa]
  heartbeat::StepControl time;
  heartbeat::OutputSchedule output;
  Study study;

  std::filesystem::path file;  ///< the case file
  std::map<std::string, std::string>
      origin;  ///< parameter -> "file:line" where the case file sets it
  std::vector<std::string>
      without_effect;  ///< what is set in [mesh] and does nothing, as sentences
};

/// End-systolic pressure / systolic pressure of a cuff on the arm (R. P. Kelly et al., Circulation
/// 86:513, 1992).
inline constexpr double systolic_share = 0.9;

/// Whether the anatomy of a case is drawn, not given as an ellipsoid or a mesh.
[[nodiscard]] inline bool is_drawn(const Case& c) {
  return c.anatomy.source != AnatomySource::ellipsoid && c.anatomy.source != AnatomySource::mesh;
}

/// Whether the wall beats in a circulation.
[[nodiscard]] inline bool is_cycle(const Case& c) {
  return c.protocol.kind == heartbeat::ProtocolKind::cycle;
}

/// Whether the wall that was seen is a loaded one.
[[nodiscard]] inline bool is_loaded(const Case& c) {
  return c.unloaded.pressure > 0.0;
}

/// A file named in a case file; relative names are relative to the case file.
[[nodiscard]] std::filesystem::path beside(const Case& c, const std::string& name);

/// The line of the case file that sets a parameter, else the file.
[[nodiscard]] std::string place_of(const Case& c, const std::string& parameter);

/// Passive and active law as the walls of both engines know them.
[[nodiscard]] material::Myocardium myocardium(const Case& c);

/// How the wall is meshed for the engine of the case.
[[nodiscard]] mesh::WallMeshParameters mesh_parameters(const Case& c);

/// Factors of the active tension: those fitted, or those of muscle.contractility. Throws InputError
/// naming file and line.
[[nodiscard]] mesh::SegmentFactors segment_factors(const Case& c);

/// The ventricle as the engine of the case knows it, its base held by the springs of the case or by
/// the quasi-static engine's, so stiff that it does not move.
[[nodiscard]] solid::CardiacModel cardiac_model(const Case& c);

/// The same for the quasi-static engine, whichever is the engine of the case.
[[nodiscard]] implicit::StaticModel static_model(const Case& c);

/// The immersed engine's parameters, with the box placed around the middle of the wall.
[[nodiscard]] immersed::ModelParameters model_parameters(const Case& c, const mesh::Mesh& mesh);

/// What the immersed engine runs of a case.
[[nodiscard]] heartbeat::BeatSetup beat_setup(const Case& c, const mesh::Mesh& mesh);

}  // namespace lv::case_file

#pragma once

#include <array>
#include <numbers>
#include <string>
#include <vector>

namespace lv::mesh {

/// How finely the wall is meshed.
struct WallMeshParameters {
  double edge_length = 1.4;  ///< target length of element edges [mm]
  int layers = 0;            ///< elements through the wall; 0: as the edge length asks, at least 3
  int order =
      1;  ///< of the mesh; 2: even numbers of elements, which hang together as quadratic ones
  /// Lengths of the elements next to the apex, along the wall, and next to the endocardium, through
  /// it, as fractions of those of an even mesh with as many elements. Others are longer: where
  /// fibres run together at the apex the solution is steep.
  double apex = 1.0, endocardium = 1.0;
};

/// How the sides of the wall are recognised in a file.
enum class SideSource {
  tags,     ///< by the names or numbers that the file gives them
  geometry  ///< the flat opening is the base; of the other two parts the inner one is the
            ///< endocardium
};

/// A wall mesh that exists already, and what its file calls things.
///
/// What a tag is depends on the file. Gmsh: the name or number of a physical surface. ABAQUS: the
/// name of a *Surface, of an *Elset of surface elements, or of an *Nset. VTK: with `side_array`, a
/// number in that cell-data array on the triangles and quadrilaterals stored beside the volume
/// cells; without, the name of a point array that is 1 on the side's nodes and 0 elsewhere; or the
/// .vtp file of the side's surface, as SimVascular writes it. A face belongs to a set of nodes if
/// all its nodes do; if that makes it part of the base and of another side, it is base.
struct ImportParameters {
  std::string file;   ///< .inp (ABAQUS), .msh (Gmsh 2.2 or 4.1), .vtk or .vtu
  double unit = 1.0;  ///< length of the file's unit [mm]
  SideSource sides = SideSource::tags;
  std::string endo = "endo";  ///< tag of the endocardium
  std::string epi = "epi";    ///< tag of the epicardium
  std::string base = "base";  ///< tag of the base
  std::string side_array;     ///< VTK: cell-data array with the sides' numbers
  std::string infarct_array;  ///< VTK: point array of M(X); empty: "infarct", if the file has it
  std::string infarct_set;    ///< infarcted elements: an ABAQUS *Elset, the name or number of a
                              ///< Gmsh physical volume, a VTK cell array that is 1 on them and less
                              ///< elsewhere; empty: none are asked for
  /// VTK: the array, at cells or points, of the fibres' directions (empty: they follow a rule) and
  /// of the sheets'; or a .vtk or .vtu file with the same cells and such an array, as SimVascular's
  /// FIB_DIR
  std::string fibres, sheets;
  double base_tolerance = 0.1;  ///< largest distance of the base's nodes from their plane [mm]
  double shortest = 20.0;       ///< smallest believable extent of a wall [mm]
  double longest = 200.0;       ///< largest believable extent of a wall [mm]
};

/// Where the extent of the infarct, M(X), comes from.
enum class InfarctSource {
  mesh,       ///< M at the nodes of an imported mesh; 0 if it brings none
  none,       ///< no infarct
  described,  ///< an idealised description
  elements,   ///< a set of elements of an imported mesh
  surface,    ///< a closed surface in image space
  labels,     ///< a labelled volume in image space
  strain,     ///< segments that hardly shorten
  lge         ///< the brightness of a late-enhancement image in the wall
};

/// An idealised infarct in the wall's own directions: a sector of the wall and the apex all round,
/// from the endocardium outwards. Heights are fractions of the wall's length, 0 at the apex of the
/// epicardium and 1 at the base. The defaults are antero-septal and apical.
struct DescribedInfarct {
  double angle = std::numbers::pi / 6.0;  ///< of the sector's middle about the long axis, from
                                          ///< the middle of the septum towards the anterior
                                          ///< wall [rad]
  double width = 2.0 * std::numbers::pi / 3.0;  ///< of the sector [rad]
  double bottom = 0.0;                          ///< height at which the sector begins
  double top = 0.7;                             ///< height at which it ends
  double apex = 0.3;           ///< below this height the wall is infarcted all round
  double transmurality = 1.0;  ///< transmural coordinate that the infarct reaches
};

/// What of a late-enhancement image is bright enough for scar.
enum class ScarThreshold {
  sd,   ///< the mean of remote muscle and some standard deviations
  fwhm  ///< half way from no signal to the brightest in the wall
};

/// A late-enhancement image and its threshold.
struct LateEnhancement {
  std::string image;                ///< NIfTI file, or folder of DICOM files
  std::vector<std::string> series;  ///< of the DICOM files; empty: the only one
  std::string drawn;                ///< CSV of the scar's pixels, instead of a threshold; or empty
  ScarThreshold threshold = ScarThreshold::sd;
  double deviations = 5.0;    ///< above the mean of remote muscle
  std::vector<int> remote;    ///< AHA segments of remote muscle; empty: not said
  double zero = 0.0;          ///< grey value without signal, for fwhm
  double largest_part = 0.5;  ///< of the wall that may be scar
  bool fill_no_reflow = true;
  bool in_plane = false;       ///< move each slice onto the wall
  double largest_shift = 8.0;  ///< of a slice [mm]
};

/// The infarct and its border zone. Files as the case file names them.
struct InfarctParameters {
  InfarctSource source = InfarctSource::mesh;
  double border = 10.0;  ///< width of the border zone, l^bz of (2.11) [mm]
  DescribedInfarct described;
  std::string set;             ///< of elements; see ImportParameters::infarct_set
  std::string surface;         ///< .stl, .ply, .obj, .vtp or .vtk
  std::string labels;          ///< .vti or .vtk
  std::string array;           ///< of labels; empty: the file's only array
  std::vector<int> scar{1};    ///< the labels that mean scar
  std::vector<int> no_reflow;  ///< the labels that mean its dark core; may be empty
  std::vector<int> muscle;     ///< the labels of other muscle, for in_plane; may be empty
  int frame = 0;               ///< of a label map of several times, from 1; 0: the only one
  bool in_plane = false;       ///< move each slice of a label map onto the wall
  std::array<double, 3> shift{0.0, 0.0, 0.0};  ///< of the images in image space [mm]
  LateEnhancement lge;
  double length_unit = 1.0;  ///< of the surface's or labels' file [mm]
};

}  // namespace lv::mesh

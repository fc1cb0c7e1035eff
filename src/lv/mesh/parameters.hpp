#pragma once

#include <string>

namespace lv::mesh {

/// How finely the wall is meshed.
struct WallMeshParameters {
  double edge_length = 1.4;  ///< target length of element edges [mm]
  int layers = 0;            ///< elements through the wall; 0: as the edge length asks, at least 3
  int order =
      1;  ///< of the mesh; 2: even numbers of elements, which hang together as quadratic ones
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
/// cells; without, the name of a point array that is 1 on the side's nodes and 0 elsewhere. A face
/// belongs to a set of nodes if all its nodes do.
struct ImportParameters {
  std::string file;   ///< .inp (ABAQUS), .msh (Gmsh 2.2 or 4.1), .vtk or .vtu
  double unit = 1.0;  ///< length of the file's unit [mm]
  SideSource sides = SideSource::tags;
  std::string endo = "endo";    ///< tag of the endocardium
  std::string epi = "epi";      ///< tag of the epicardium
  std::string base = "base";    ///< tag of the base
  std::string side_array;       ///< VTK: cell-data array with the sides' numbers
  std::string infarct_array;    ///< VTK: point array of M(X); empty: "infarct", if the file has it
  double base_tolerance = 0.1;  ///< largest distance of the base's nodes from their plane [mm]
  double shortest = 20.0;       ///< smallest believable extent of a wall [mm]
  double longest = 200.0;       ///< largest believable extent of a wall [mm]
};

}  // namespace lv::mesh

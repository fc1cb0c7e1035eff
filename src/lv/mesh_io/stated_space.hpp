#pragma once

#include "lv/base/tensor.hpp"

#include <string>

class vtkDataObject;

/// Image space is LPS (x to the patient's left, y to the back, z to the head), as DICOM has it. 3D
/// Slicer and programs after it say in what space a file's coordinates are: "SPACE=RAS" or
/// "SPACE=LPS" in the header of an STL file, a comment of PLY, the title of a legacy VTK file, the
/// field array SPACE of an XML one. A file that says nothing is taken to be in LPS.
namespace lv::mesh_io {

/// From RAS to LPS.
inline const Vec3 ras_to_lps(-1.0, -1.0, 1.0);

/// Whether the beginning of a file says that its coordinates are in RAS. Throws InputError when it
/// says another space than RAS and LPS.
[[nodiscard]] bool says_ras(const std::string& file);

/// What a file that VTK has read says, "RAS" or "LPS", in its field array, else in its beginning;
/// empty if it says nothing. Throws InputError when it says another space.
[[nodiscard]] std::string space_of(const std::string& file, vtkDataObject& data);

/// The same of what VTK has read from a file: its field array, else the file's beginning.
[[nodiscard]] bool says_ras(const std::string& file, vtkDataObject& data);

}  // namespace lv::mesh_io

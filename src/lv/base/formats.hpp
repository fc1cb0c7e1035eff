#pragma once

/// How the files that are read are named, for messages: each list stands once.
namespace lv::formats {

#define LV_NIFTI "NIfTI (.nii, .nii.gz, or .hdr with .img)"

inline constexpr const char* nifti = LV_NIFTI;
inline constexpr const char* images = "DICOM (files of any name, or a folder) and " LV_NIFTI;
inline constexpr const char* meshes = ".inp (ABAQUS), .vtk, .vtu (VTK) and .msh (Gmsh)";
inline constexpr const char* surfaces = ".stl, .ply, .vtp and .vtk (polygons)";
inline constexpr const char* label_volumes = LV_NIFTI ", .vti and .vtk (structured points)";

#undef LV_NIFTI

}  // namespace lv::formats

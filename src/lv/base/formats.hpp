#pragma once

/// How the files that are read are named, for messages: each list stands once.
namespace lv::formats {

#define LV_NIFTI "NIfTI (.nii, .nii.gz, or .hdr with .img)"

#define LV_VOLUMES LV_NIFTI ", NRRD (.nrrd, .nhdr) and MetaImage (.mha, .mhd)"

inline constexpr const char* volumes = LV_VOLUMES;
inline constexpr const char* images = "DICOM (files of any name, or a folder), " LV_VOLUMES;
inline constexpr const char* contours = "Segment (.mat), DICOM RTSTRUCT and cvi42 (.cvi42wsx)";
inline constexpr const char* meshes = ".inp (ABAQUS), .vtk, .vtu (VTK) and .msh (Gmsh)";
inline constexpr const char* surfaces = ".stl, .ply, .obj, .vtp and .vtk (polygons)";
inline constexpr const char* label_volumes = LV_VOLUMES ", .vti and .vtk (structured points)";
/// What `images` and `new --from` take.
inline constexpr const char* sources =
    "Read are label maps and images (NIfTI .nii, .nii.gz, .hdr; NRRD .nrrd, .nhdr; MetaImage .mha, "
    ".mhd; DICOM SEG), contours of other programs (Segment .mat, DICOM RTSTRUCT, cvi42 .cvi42wsx), "
    "surfaces (.stl, .ply, .obj, .vtp), folders of DICOM files or of Sunnybrook contours, contours "
    "(.csv), lists of guide points (columns separated by tabs), and meshes (ABAQUS .inp, Gmsh "
    ".msh, .vtk, .vtu)";

#undef LV_VOLUMES
#undef LV_NIFTI

}  // namespace lv::formats

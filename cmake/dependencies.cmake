# Debian 12 packages only. The targets they make are system includes: their warnings are not ours.
find_package(PkgConfig REQUIRED)
pkg_check_modules(MPI REQUIRED IMPORTED_TARGET ompi)  # the C interface alone, without OpenMPI's retired C++ one
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
find_library(FFTW_MPI_LIBRARY fftw3_mpi REQUIRED)  # has no pkg-config file of its own
add_library(fftw3_mpi UNKNOWN IMPORTED)
set_target_properties(fftw3_mpi PROPERTIES IMPORTED_LOCATION ${FFTW_MPI_LIBRARY})
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp REQUIRED)  # Debian's CMake target wants a library of xtl that does not exist
add_library(xsimd_headers INTERFACE)
target_include_directories(xsimd_headers SYSTEM INTERFACE ${XSIMD_INCLUDE_DIR})
find_package(fmt 9 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOCore IOGeometry IOLegacy IOPLY IOXML)

# OpenMPI's retired C++ interface is neither used nor linked.
target_compile_definitions(PkgConfig::MPI INTERFACE OMPI_SKIP_MPICXX)

find_package(Boost 1.74 REQUIRED)  # headers alone: the R-tree

find_path(LAPACKE_INCLUDE lapacke.h REQUIRED)
find_library(LAPACKE lapacke REQUIRED)
find_path(METIS_INCLUDE metis.h REQUIRED)
find_library(METIS metis REQUIRED)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)

# The images alone, without ITK's factories: what is read and written is named where it is used.
set(ITK_NO_IO_FACTORY_REGISTER_MANAGER ON)
find_package(ITK 5.2 REQUIRED COMPONENTS ITKCommon ITKIOGDCM ITKIONIFTI ITKMetaIO ITKNrrdIO ITKImageFunction ITKImageGrid ITKRegistrationMethodsv4 ITKOptimizersv4 ITKMetricsv4 ITKThresholding ITKLabelMap ITKPath)
add_library(itk INTERFACE)
target_include_directories(itk SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
target_link_libraries(itk INTERFACE ${ITK_LIBRARIES})
# Files of MATLAB, as Segment writes them. Not by pkg-config, which adds headers of another HDF5 than PETSc's.
find_path(MATIO_INCLUDE matio.h REQUIRED)
find_library(MATIO matio REQUIRED)
find_package(pugixml 1.13 REQUIRED)  # XML, as cvi42 writes it
find_path(MINIZIP_INCLUDE minizip/unzip.h REQUIRED)  # cvi42's files in zip archives
find_library(MINIZIP minizip REQUIRED)
find_package(ZLIB REQUIRED)  # NIfTI images are packed with it
# ITK brings an older Eigen of its own: the sources that include ITK or GDCM are told to use the system's. ITK's headers also
# step back from the null pointer of an empty neighbourhood, which is no finding of ours. So they cannot share the precompiled header.
function(lv_uses_itk)
  set(options -isystem ${GDCM_INCLUDE_DIRS})
  if(LV_SANITIZE)
    list(APPEND options -fno-sanitize=pointer-overflow)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES
    COMPILE_DEFINITIONS ITK_USE_SYSTEM_EIGEN COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

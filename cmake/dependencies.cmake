# Debian 12 packages only. The targets they make are system includes: their warnings are not ours.
find_package(PkgConfig REQUIRED)
pkg_check_modules(MPI REQUIRED IMPORTED_TARGET ompi)  # the C interface alone, without OpenMPI's retired C++ one
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp REQUIRED)  # Debian's CMake target wants a library of xtl that does not exist
add_library(xsimd_headers INTERFACE)
target_include_directories(xsimd_headers SYSTEM INTERFACE ${XSIMD_INCLUDE_DIR})
find_package(fmt 9 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOXML IOLegacy)

# OpenMPI's retired C++ interface is neither used nor linked.
target_compile_definitions(PkgConfig::MPI INTERFACE OMPI_SKIP_MPICXX)

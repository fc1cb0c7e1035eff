#pragma once

#include "lv/image/nifti.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <zlib.h>

#include <string>

namespace lv::test {

/// Directions that are aligned with nothing.
inline Mat3 oblique() {
  return Eigen::AngleAxisd(1.1, Vec3(0.4, 0.5, -0.6).normalized()).toRotationMatrix();
}

/// The image written as map.nii and read.
inline image::Volume read_back(const NiftiSpec& spec) {
  const TemporaryFolder folder;
  write_bytes(folder / "map.nii", nifti_bytes(spec));
  return image::read_nifti(folder / "map.nii");
}

inline std::string gzipped(const std::string& bytes) {
  const TemporaryFolder folder;
  const gzFile stream = gzopen((folder / "x").c_str(), "wb");
  gzwrite(stream, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(stream);
  return bytes_of(folder / "x");
}

}  // namespace lv::test

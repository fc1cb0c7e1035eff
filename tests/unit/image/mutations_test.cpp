// Files as a scanner writes them, with bytes changed, cut out and put in: every reader either reads
// them or says in words what is wrong. Run under sanitizers (preset "sanitize") this is a fuzz
// test; the environment variable VENTRICLE_MUTATIONS sets how many.
#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/guide_points.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/nifti.hpp"
#include "lv/image/sunnybrook.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <random>

namespace {

using namespace lv;
using namespace lv::image;

int mutations() {
  const char* set = std::getenv("VENTRICLE_MUTATIONS");
  return set != nullptr ? std::atoi(set) : 30;
}

std::string mutated(std::string bytes, std::mt19937& random) {
  const int changes = 1 + static_cast<int>(random() % 4);
  for (int n = 0; n < changes && !bytes.empty(); ++n) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 4) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, random() % 40);
        break;
      case 2:
        bytes.insert(at, std::string(random() % 40, static_cast<char>(random())));
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

/// How many mutations were read; the rest must be refused as wrong input.
int survivors(const std::string& name, const std::string& bytes,
              const std::function<void(const std::filesystem::path&)>& read) {
  const test::TemporaryFolder folder;
  std::mt19937 random(12345);
  int fine = 0;
  for (int n = 0; n < mutations(); ++n) {
    test::write_bytes(folder / name, mutated(bytes, random));
    try {
      read(folder / name);
      ++fine;
    } catch (const InputError&) {
    }
  }
  return fine;
}

test::DicomSpec dicom() {
  test::DicomSpec spec;
  spec.plane = {Vec3(1, 2, 3), Vec3::UnitX(), Vec3::UnitY(), 1.5, 1.5, 8, 8};
  spec.pixels.assign(64, 7);
  spec.trigger_ms = 10.0;
  return spec;
}

}  // namespace

TEST_CASE("mutated DICOM files are read or refused", "[unit][image][mutations]") {
  const auto read = [](const std::filesystem::path& file) {
    static_cast<void>(read_dicom_cine(std::array{file}));
  };
  CHECK(survivors("x.dcm", test::dicom_bytes(dicom()), read) < mutations());
}

TEST_CASE("mutated NIfTI files are read or refused", "[unit][image][mutations]") {
  const auto spec = test::label_map({12, 12, 6}, Mat3::Identity(), {4.0, 4.0, 8.0}, Vec3::Zero(),
                                    [](const Vec3& x) {
                                      const double r = (x - Vec3(22, 22, x.z())).norm();
                                      return r < 12.0 ? 1 : r < 18.0 ? 2 : 0;
                                    });
  const auto read = [](const std::filesystem::path& file) {
    const Volume volume = read_nifti(file);
    require_labels(volume, 0, {1, 2}, "case", "cavity");
    geometry::check_contours(trace_labels(volume, {{1}, {2}, {}}, 0).contours);
  };
  CHECK(survivors("x.nii", test::nifti_bytes(spec), read) < mutations());
}

TEST_CASE("mutated contours and lists of points are read or refused", "[unit][image][mutations]") {
  std::string circle, list = "x\ty\tz\ttype\tslice\n";
  for (int i = 0; i < 24; ++i) {
    const double x = 30 + 9 * std::cos(0.26 * i);
    const double y = 30 + 9 * std::sin(0.26 * i);
    circle += fmt::format("{:.2f} {:.2f}\n", x, y);
    for (int s = 0; s < 3; ++s)
      list += fmt::format("{:.2f}\t{:.2f}\t{}\tSAX_LV_ENDOCARDIAL\t{}\n", x, y, 10 * s, s);
  }
  DicomStack stack;
  DicomImage image;
  image.instance = 1;
  image.plane = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 64, 64};
  stack.slices.push_back({0.0, {image}});
  const auto contours = [&](const std::filesystem::path& file) {
    static_cast<void>(
        read_sunnybrook(file.parent_path(), stack, PixelOrigin::corner, DrawnBy::manual));
  };
  CHECK(survivors("IM-0001-0001-icontour-manual.txt", circle, contours) <= mutations());
  const auto points = [](const std::filesystem::path& file) {
    geometry::check_contours(read_guide_points(file, std::nullopt, geometry::Side::epi).contours);
  };
  CHECK(survivors("points.txt", list, points) <= mutations());
}

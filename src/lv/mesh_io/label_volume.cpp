#include "lv/mesh_io/label_volume.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/mesh_io/foreign_mesh.hpp"
#include "lv/mesh_io/stated_space.hpp"
#include "lv/mesh_io/vtk_file.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace lv::mesh_io {
namespace {

vtkSmartPointer<vtkImageData> read_legacy_image(const std::string& file) {
  vtkNew<vtkStructuredPointsReader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkImageData> read_xml_image(const std::string& file) {
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  if (reader->GetNumberOfTimeSteps() > 1)
    throw InputError(file, fmt::format("has {} times", reader->GetNumberOfTimeSteps()),
                     "Save the one that shows the infarct");
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkImageData> read_image(const std::string& file) {
  require_readable(file, "Check the name of the labelled volume");
  const std::string ending = ending_of(file);
  if (ending != ".vti" && ending != ".vtk")
    throw InputError(file, fmt::format("has the unknown ending \"{}\"", ending),
                     fmt::format("Labelled volumes are read from {}", formats::label_volumes));
  vtkSmartPointer<vtkImageData> image = read_by_vtk(
      file, [&] { return ending == ".vti" ? read_xml_image(file) : read_legacy_image(file); });
  const double* sizes = image->GetSpacing();
  for (int d = 0; d < 3; ++d)
    if (sizes[d] < 0.0)
      throw InputError(file, fmt::format("has the negative voxel size {:g}", sizes[d]),
                       "Give sizes without a sign: a negative one may mean that the volume is "
                       "mirrored, or nothing");
  return image;
}

/// The names of the arrays at points and in cells.
std::vector<std::string> voxel_arrays(vtkImageData& image) {
  std::vector<std::string> names;
  for (vtkFieldData* data :
       std::initializer_list<vtkFieldData*>{image.GetPointData(), image.GetCellData()})
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      if (data->GetArrayName(i) != nullptr)
        names.emplace_back(data->GetArrayName(i));
  return names;
}

std::string chosen_array(const std::string& file, vtkImageData& image, const std::string& array) {
  if (!array.empty())
    return array;
  const auto names = voxel_arrays(image);
  if (names.size() != 1)
    throw InputError(file,
                     fmt::format("has {} arrays{}{}", names.size(), names.empty() ? "" : ": ",
                                 fmt::join(names, ", ")),
                     "Name the array of labels");
  return names.front();
}

}  // namespace

struct LabelVolume::Image {
  vtkSmartPointer<vtkImageData> data;
  vtkDataArray* labels;
  bool in_cells;
  Vec3 scale;  ///< from the file's coordinates to millimetres in LPS

  /// The number of the voxel that holds x; -1 outside.
  [[nodiscard]] vtkIdType voxel_at(const Vec3& x) const {
    const Vec3 in_file = x.cwiseQuotient(scale);
    std::array<double, 3> place{};  // counted in voxels
    data->TransformPhysicalPointToContinuousIndex(in_file.data(), place.data());
    const int* extent = data->GetExtent();
    std::array<int, 3> ijk{};
    for (int d = 0; d < 3; ++d) {
      const double nearest = in_cells ? std::floor(place[d]) : std::round(place[d]);
      const int last = in_cells ? extent[2 * d + 1] - 1 : extent[2 * d + 1];
      if (!(nearest >= extent[2 * d] && nearest <= last))
        return -1;
      ijk[d] = static_cast<int>(nearest);
    }
    return in_cells ? data->ComputeCellId(ijk.data()) : data->ComputePointId(ijk.data());
  }
};

LabelVolume::LabelVolume(const std::string& file, const std::string& array, double unit)
    : image_(std::make_unique<Image>()) {
  image_->data = read_image(file);
  image_->scale = unit * (says_ras(file, *image_->data) ? ras_to_lps : Vec3(Vec3::Ones()));
  const std::string name = chosen_array(file, *image_->data, array);
  image_->labels = image_->data->GetPointData()->GetArray(name.c_str());
  image_->in_cells = image_->labels == nullptr;
  if (image_->in_cells)
    image_->labels = image_->data->GetCellData()->GetArray(name.c_str());
  if (image_->labels == nullptr)
    fail_missing_tag(file, "array", name, voxel_arrays(*image_->data));
  const vtkIdType voxels =
      image_->in_cells ? image_->data->GetNumberOfCells() : image_->data->GetNumberOfPoints();
  if (image_->labels->GetNumberOfTuples() != voxels)
    throw InputError(file,
                     fmt::format("array \"{}\" has {} labels for {} voxels", name,
                                 image_->labels->GetNumberOfTuples(), voxels),
                     "The file seems to be truncated or damaged");
  if (image_->labels->GetNumberOfComponents() != 1)
    throw InputError(file,
                     fmt::format("array \"{}\" has {} numbers for each voxel", name,
                                 image_->labels->GetNumberOfComponents()),
                     "Labels are one number a voxel");
  std::set<int> found;
  for (vtkIdType i = 0; i < image_->labels->GetNumberOfTuples(); ++i) {
    const double label = image_->labels->GetComponent(i, 0);
    if (!(std::abs(label) <= std::numeric_limits<int>::max()) || label != std::round(label))
      throw InputError(file, fmt::format("array \"{}\" is {} in voxel {}", name, label, i),
                       "Labels are whole numbers");
    found.insert(static_cast<int>(label));
  }
  labels_.assign(found.begin(), found.end());
}
LabelVolume::~LabelVolume() = default;
LabelVolume::LabelVolume(LabelVolume&&) noexcept = default;
LabelVolume& LabelVolume::operator=(LabelVolume&&) noexcept = default;

bool LabelVolume::has(const Vec3& x, const std::vector<int>& labels) const {
  const vtkIdType voxel = image_->voxel_at(x);
  if (voxel < 0)
    return false;
  const double label = image_->labels->GetComponent(voxel, 0);
  return std::any_of(labels.begin(), labels.end(), [&](int wanted) { return label == wanted; });
}

Eigen::AlignedBox3d LabelVolume::box() const {
  const double* b = image_->data->GetBounds();
  return bounds(std::array{image_->scale.cwiseProduct(Vec3(b[0], b[2], b[4])).eval(),
                           image_->scale.cwiseProduct(Vec3(b[1], b[3], b[5])).eval()});
}

}  // namespace lv::mesh_io

#include "lv/image/nifti_header.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

namespace lv::image {
namespace {

constexpr std::int32_t length_1 = 348;
constexpr std::int32_t length_2 = 540;

/// Numbers at places among bytes.
class Numbers {
 public:
  Numbers(std::span<const char> bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  template <class Number>
  [[nodiscard]] Number at(std::size_t place) const {
    std::array<char, sizeof(Number)> number{};
    std::memcpy(number.data(), bytes_.data() + place, sizeof(Number));
    if (swapped_)
      std::reverse(number.begin(), number.end());
    return std::bit_cast<Number>(number);
  }

  /// n numbers in a row, as doubles.
  template <class Number, std::size_t n>
  [[nodiscard]] std::array<double, n> row(std::size_t place) const {
    std::array<double, n> values{};
    for (std::size_t i = 0; i < n; ++i)
      values[i] = static_cast<double>(at<Number>(place + i * sizeof(Number)));
    return values;
  }

  template <class Number>
  [[nodiscard]] Vec3 vector(std::size_t place) const {
    return Vec3(row<Number, 3>(place).data());
  }

  template <class Number>
  [[nodiscard]] Eigen::Matrix<double, 3, 4> matrix(std::size_t place) const {
    return Eigen::Matrix<double, 3, 4, Eigen::RowMajor>(row<Number, 12>(place).data());
  }

 private:
  std::span<const char> bytes_;
  bool swapped_;
};

bool stands_at(std::span<const char> bytes, std::size_t place, std::string_view text) {
  return bytes.size() >= place + text.size() &&
         std::string_view(bytes.data() + place, text.size()) == text;
}

/// Whether a header of so many bytes begins here, in this or the other byte order.
bool has_length(std::span<const char> bytes, std::int32_t length, bool swapped) {
  return bytes.size() >= static_cast<std::size_t>(length) &&
         Numbers(bytes, swapped).at<std::int32_t>(0) == length;
}

/// Where the numbers of a header stand.
struct Places {
  std::int32_t length;
  std::size_t magic, datatype, bits, dim, pixdim, voxels_begin, slope, intercept, units, qform_code,
      sform_code, quaternion, offset, rows;
};

constexpr Places places_1{length_1, 344, 70,  72,  40,  76,  108, 112,
                          116,      123, 252, 254, 256, 268, 280};
constexpr Places places_2{length_2, 4,   12,  14,  16,  104, 168, 176,
                          184,      500, 344, 348, 352, 376, 400};

/// `Size` is the type of dim, `Begin` that of vox_offset, `Real` that of other real numbers,
/// `Units` and `Code` those of xyzt_units and of the codes of sform and qform.
template <class Size, class Begin, class Real, class Units, class Code>
NiftiHeader parse(std::span<const char> bytes, bool swapped, const Places& at) {
  const Numbers n(bytes, swapped);
  NiftiHeader header;
  header.length = static_cast<std::size_t>(at.length);
  header.swapped = swapped;
  header.beside = stands_at(bytes, at.magic, "ni");
  header.dim = n.row<Size, 8>(at.dim);
  header.datatype = n.at<std::int16_t>(at.datatype);
  header.bits = n.at<std::int16_t>(at.bits);
  header.pixdim = n.row<Real, 8>(at.pixdim);
  header.voxels_begin = static_cast<double>(n.at<Begin>(at.voxels_begin));
  header.slope = n.at<Real>(at.slope);
  header.intercept = n.at<Real>(at.intercept);
  header.units = n.at<Units>(at.units);
  header.qform_code = n.at<Code>(at.qform_code);
  header.sform_code = n.at<Code>(at.sform_code);
  header.quaternion = n.vector<Real>(at.quaternion);
  header.offset = n.vector<Real>(at.offset);
  header.rows = n.matrix<Real>(at.rows);
  return header;
}

}  // namespace

std::optional<NiftiHeader> parse_nifti_header(std::span<const char> bytes) {
  for (const bool swapped : {false, true}) {
    if (has_length(bytes, length_1, swapped) &&
        (stands_at(bytes, 344, "n+1") || stands_at(bytes, 344, "ni1")))
      return parse<std::int16_t, float, float, std::uint8_t, std::int16_t>(bytes, swapped,
                                                                           places_1);
    if (has_length(bytes, length_2, swapped) &&
        (stands_at(bytes, 4, "n+2") || stands_at(bytes, 4, "ni2")))
      return parse<std::int64_t, std::int64_t, double, std::int32_t, std::int32_t>(bytes, swapped,
                                                                                   places_2);
  }
  return std::nullopt;
}

bool is_analyze_header(std::span<const char> bytes) {
  return (has_length(bytes, length_1, false) || has_length(bytes, length_1, true)) &&
         !parse_nifti_header(bytes);
}

}  // namespace lv::image

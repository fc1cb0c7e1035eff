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

NiftiHeader parse_1(std::span<const char> bytes, bool swapped) {
  const Numbers n(bytes, swapped);
  NiftiHeader header;
  header.length = length_1;
  header.swapped = swapped;
  header.beside = stands_at(bytes, 344, "ni1");
  header.dim = n.row<std::int16_t, 8>(40);
  header.datatype = n.at<std::int16_t>(70);
  header.bits = n.at<std::int16_t>(72);
  header.pixdim = n.row<float, 8>(76);
  header.voxels_begin = n.at<float>(108);
  header.slope = n.at<float>(112);
  header.intercept = n.at<float>(116);
  header.units = n.at<std::uint8_t>(123);
  header.qform_code = n.at<std::int16_t>(252);
  header.sform_code = n.at<std::int16_t>(254);
  header.quaternion = n.vector<float>(256);
  header.offset = n.vector<float>(268);
  header.rows = n.matrix<float>(280);
  return header;
}

NiftiHeader parse_2(std::span<const char> bytes, bool swapped) {
  const Numbers n(bytes, swapped);
  NiftiHeader header;
  header.length = length_2;
  header.swapped = swapped;
  header.beside = stands_at(bytes, 4, "ni2");
  header.datatype = n.at<std::int16_t>(12);
  header.bits = n.at<std::int16_t>(14);
  header.dim = n.row<std::int64_t, 8>(16);
  header.pixdim = n.row<double, 8>(104);
  header.voxels_begin = static_cast<double>(n.at<std::int64_t>(168));
  header.slope = n.at<double>(176);
  header.intercept = n.at<double>(184);
  header.qform_code = n.at<std::int32_t>(344);
  header.sform_code = n.at<std::int32_t>(348);
  header.quaternion = n.vector<double>(352);
  header.offset = n.vector<double>(376);
  header.rows = n.matrix<double>(400);
  header.units = n.at<std::int32_t>(500);
  return header;
}

}  // namespace

std::optional<NiftiHeader> parse_nifti_header(std::span<const char> bytes) {
  for (const bool swapped : {false, true}) {
    if (has_length(bytes, length_1, swapped) &&
        (stands_at(bytes, 344, "n+1") || stands_at(bytes, 344, "ni1")))
      return parse_1(bytes, swapped);
    if (has_length(bytes, length_2, swapped) &&
        (stands_at(bytes, 4, "n+2") || stands_at(bytes, 4, "ni2")))
      return parse_2(bytes, swapped);
  }
  return std::nullopt;
}

bool is_analyze_header(std::span<const char> bytes) {
  return (has_length(bytes, length_1, false) || has_length(bytes, length_1, true)) &&
         !parse_nifti_header(bytes);
}

}  // namespace lv::image

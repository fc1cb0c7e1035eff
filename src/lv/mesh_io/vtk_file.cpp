#include "lv/mesh_io/vtk_file.hpp"

#include "lv/base/table.hpp"

#include <vtkCellArray.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <optional>
#include <string_view>

namespace lv::mesh_io {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// Whole numbers from the front of a text, or of big-endian bytes.
class WholeNumbers {
 public:
  WholeNumbers(std::string_view rest, bool binary) : rest_(rest), binary_(binary) {}

  std::optional<std::int64_t> next() { return binary_ ? next_raw() : next_written(); }

 private:
  std::optional<std::int64_t> next_written() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc())
      return {};
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  std::optional<std::int64_t> next_raw() {
    std::array<char, 4> bytes{};
    if (rest_.size() < bytes.size())
      return {};
    std::reverse_copy(rest_.begin(), rest_.begin() + bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    return std::bit_cast<std::int32_t>(bytes);
  }

  std::string_view rest_;
  bool binary_;
};

/// Whether `count` lists, each behind its length, take `size` numbers in all.
bool lists_fit(WholeNumbers numbers, std::int64_t count, std::int64_t size) {
  for (std::int64_t cell = 0; cell < count; ++cell) {
    const auto length = numbers.next();
    if (!length || *length < 0 || *length >= size)
      return false;
    size -= *length + 1;
    for (std::int64_t i = 0; i < *length; ++i)
      if (!numbers.next())
        return false;
  }
  return size == 0;
}

/// Whether what follows the word of a heading is "count size" and lists that fit; the lists of
/// version 5 have a heading of their own, and VTK measures them.
bool cells_fit(std::string_view rest, bool binary) {
  WholeNumbers heading(rest, false);
  const auto count = heading.next();
  const auto size = heading.next();
  if (!count || !size)
    return false;
  rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  return rest.starts_with("OFFSETS") || lists_fit({rest, binary}, *count, *size);
}

}  // namespace

void check_legacy_cells(const std::string& file) {
  const std::string text = read_file(file);
  const auto after_title = text.find('\n', text.find('\n') + 1);
  const bool binary = text.substr(0, 600).find("BINARY") != std::string::npos;
  for (const std::string_view word : {"CELLS", "POLYGONS", "LINES", "VERTICES", "TRIANGLE_STRIPS"})
    for (auto at = text.find(word, after_title); at != std::string::npos;
         at = text.find(word, at + 1)) {
      const bool heads_list = blanks.find(text[at - 1]) != std::string_view::npos;
      const std::string_view rest = std::string_view(text).substr(at + word.size());
      if (heads_list && !rest.empty() && !cells_fit(rest, binary))
        throw InputError(file, fmt::format("its {} are not as many as their heading says", word),
                         "The file seems to be truncated or damaged");
    }
}

void check_cells(const std::string& file, vtkCellArray* cells, std::int64_t points) {
  if (cells == nullptr)
    return;
  if (!cells->IsValid())
    throw InputError(file, "has cells of which the lists of points end too early or too late",
                     "The file seems to be damaged");
  vtkDataArray& corners = *cells->GetConnectivityArray();
  for (vtkIdType i = 0; i < corners.GetNumberOfTuples(); ++i) {
    const double point = corners.GetComponent(i, 0);
    if (!(point >= 0.0 && point < static_cast<double>(points)))
      throw InputError(file, fmt::format("has cells on point {:.0f} of {} points", point, points),
                       "Points are counted from 0; the file seems to be damaged");
  }
}

}  // namespace lv::mesh_io

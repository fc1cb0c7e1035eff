#include "lv/image/segment_mat.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/trial.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

/// A file of MATLAB and a variable of it, as their library has them.
using MatFile = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using MatVariable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

[[noreturn]] void fail_segment(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what,
                   "Save it again with Segment; other files of MATLAB are not read");
}

MatVariable read_setstruct(const fs::path& file) {
  const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY), Mat_Close);
  if (!mat)
    fail_segment(file, "cannot be read as a file of MATLAB");
  MatVariable variable(Mat_VarRead(mat.get(), "setstruct"), Mat_VarFree);
  if (!variable || variable->class_type != MAT_C_STRUCT || variable->data == nullptr)
    fail_segment(file, "has no structure \"setstruct\", which holds Segment's stacks");
  return variable;
}

/// A field of numbers: points x times x slices, or less.
struct FieldNumbers {
  std::vector<double> values;
  std::array<std::size_t, 3> size{1, 1, 1};

  [[nodiscard]] double at(std::size_t point, std::size_t time, std::size_t slice) const {
    return values[(slice * size[1] + time) * size[0] + point];
  }
};

template <class Stored>
std::vector<double> converted(const matvar_t& v, std::size_t count) {
  const auto* stored = static_cast<const Stored*>(v.data);
  return {stored, stored + count};
}

/// The numbers as they are stored; none for what is no real number.
std::optional<std::vector<double>> values_of(const matvar_t& v, std::size_t count) {
  if (v.isComplex != 0 || v.data == nullptr ||
      v.nbytes < count * static_cast<std::size_t>(v.data_size))
    return std::nullopt;
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return converted<double>(v, count);
    case MAT_C_SINGLE:
      return converted<float>(v, count);
    case MAT_C_INT8:
      return converted<std::int8_t>(v, count);
    case MAT_C_UINT8:
      return converted<std::uint8_t>(v, count);
    case MAT_C_INT16:
      return converted<std::int16_t>(v, count);
    case MAT_C_UINT16:
      return converted<std::uint16_t>(v, count);
    case MAT_C_INT32:
      return converted<std::int32_t>(v, count);
    case MAT_C_UINT32:
      return converted<std::uint32_t>(v, count);
    default:
      return std::nullopt;
  }
}

/// A stack: an element of setstruct.
class Stack {
 public:
  Stack(const fs::path& file, matvar_t& setstruct, std::size_t index)
      : file_(file), setstruct_(&setstruct), index_(index) {}

  /// None if there is no such field, or an empty one.
  [[nodiscard]] std::optional<FieldNumbers> numbers(const char* field) const {
    const matvar_t* v = Mat_VarGetStructFieldByName(setstruct_, field, index_);
    if (v == nullptr || v->rank < 1 || v->rank > 3 || v->dims == nullptr)
      return std::nullopt;
    constexpr std::size_t most_numbers = 1'000'000;  // along one axis
    FieldNumbers numbers;
    std::size_t count = 1;
    for (int d = 0; d < v->rank; ++d) {
      numbers.size[static_cast<std::size_t>(d)] = v->dims[d];
      if (v->dims[d] > most_numbers)  // damaged: the product might overflow
        fail_segment(file_, fmt::format("its {} holds no real numbers", field));
      count *= v->dims[d];
    }
    if (count == 0)
      return std::nullopt;
    auto values = values_of(*v, count);
    if (!values)
      fail_segment(file_, fmt::format("its {} holds no real numbers", field));
    numbers.values = std::move(*values);
    return numbers;
  }

  /// So many finite numbers, which must be there.
  [[nodiscard]] std::vector<double> required(const char* field, std::size_t count) const {
    const auto found = numbers(field);
    if (!found || found->values.size() != count)
      fail_segment(file_, fmt::format("its {} is not there, or not {} number{}", field, count,
                                      count == 1 ? "" : "s"));
    for (const double value : found->values)
      if (!std::isfinite(value))
        fail_segment(file_, fmt::format("its {} is no finite number", field));
    return found->values;
  }

  [[nodiscard]] double number(const char* field) const { return required(field, 1).front(); }

 private:
  fs::path file_;
  matvar_t* setstruct_;
  std::size_t index_;
};

/// Where the voxels of a stack lie: place = origin + rows (X - 1) + columns (Y - 1) + slices (z -
/// 1).
struct Lattice {
  Vec3 origin, rows, columns, slices;
};

Lattice lattice_of(const fs::path& file, const Stack& stack) {
  constexpr double cosine_error = 1e-2;
  const std::vector<double> io = stack.required("ImageOrientation", 6);
  const Vec3 r(io[0], io[1], io[2]);
  const Vec3 c(io[3], io[4], io[5]);
  if (std::abs(r.norm() - 1.0) > cosine_error || std::abs(c.norm() - 1.0) > cosine_error ||
      std::abs(r.dot(c)) > cosine_error)
    fail_segment(file, "its ImageOrientation holds no two unit vectors at right angles");
  const double x = stack.number("ResolutionX");
  const double y = stack.number("ResolutionY");
  const double step = stack.number("SliceThickness") + stack.number("SliceGap");
  for (const double size : {x, y, step})
    if (!(size >= smallest_pixel && size <= largest_pixel))
      fail_segment(file, fmt::format("its voxels measure {:g} x {:g} x {:g} mm", x, y, step));
  return {Vec3(stack.required("ImagePosition", 3).data()), x * c, y * r, -step * r.cross(c)};
}

/// The loops of one structure.
void add_loops(const fs::path& file, const Stack& stack, const Lattice& lattice,
               const std::string& structure, const std::string& name,
               std::vector<ForeignLoop>& loops) {
  const auto X = stack.numbers((structure + "X").c_str());
  const auto Y = stack.numbers((structure + "Y").c_str());
  if (!X && !Y)
    return;
  if (!X || !Y || X->size != Y->size)
    fail_segment(file, fmt::format("its {0}X and {0}Y are not of one size", structure));
  for (std::size_t z = 0; z < X->size[2]; ++z)
    for (std::size_t t = 0; t < X->size[1]; ++t) {
      ForeignLoop loop{name, "", static_cast<int>(t) + 1, {}};
      for (std::size_t p = 0; p < X->size[0]; ++p)
        if (const double x = X->at(p, t, z), y = Y->at(p, t, z);
            std::isfinite(x) && std::isfinite(y))
          loop.points.emplace_back(lattice.origin + (x - 1.0) * lattice.rows +
                                   (y - 1.0) * lattice.columns +
                                   static_cast<double>(z) * lattice.slices);
      if (!loop.points.empty())
        loops.push_back(std::move(loop));
    }
}

constexpr std::array<const char*, 3> segment_structures{"Endo", "Epi", "RVEndo"};

/// What the stack says of the times that it has contours of.
void note_moments(const Stack& stack, const std::vector<ForeignLoop>& loops,
                  ForeignContours& drawn) {
  const auto marked = [&](const char* field) {
    const auto time = stack.numbers(field);
    const auto is_it = [&](const ForeignLoop& loop) { return loop.phase == time->values.front(); };
    return time && time->values.size() == 1 && std::any_of(loops.begin(), loops.end(), is_it)
               ? static_cast<int>(time->values.front())
               : 0;
  };
  const int ed = marked("EDT");
  const int es = marked("EST");
  drawn.end_diastole = ed;
  std::vector<std::string> moments;
  if (ed > 0)
    moments.push_back(fmt::format("time {} as end-diastole", ed));
  if (es > 0 && es != ed)
    moments.push_back(fmt::format("{}{} as end-systole", ed > 0 ? "" : "time ", es));
  if (!moments.empty())
    drawn.notes.push_back(fmt::format("{} marks {}", drawn.file, fmt::join(moments, " and ")));
}

/// A stack's loops; none of one without contours.
std::vector<ForeignLoop> loops_of(const fs::path& file, const Stack& stack) {
  std::vector<ForeignLoop> loops;
  const Lattice nowhere{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (const char* structure : segment_structures)
    add_loops(file, stack, nowhere, structure, structure, loops);
  if (loops.empty())
    return loops;
  if (const auto rotated = stack.numbers("Rotated");
      rotated && rotated->values.size() == 1 && rotated->values.front() != 0.0)
    fail_segment(file, "has contours on a stack that was rotated (Rotated), whose place is lost");
  loops.clear();
  const Lattice lattice = lattice_of(file, stack);
  for (const char* structure : segment_structures)
    add_loops(file, stack, lattice, structure, structure, loops);
  return loops;
}

ForeignContours read_stacks(const fs::path& file) {
  const MatVariable setstruct = read_setstruct(file);
  std::size_t count = 1;
  for (int d = 0; d < setstruct->rank; ++d)
    count *= setstruct->dims[d];
  ForeignContours drawn{file.string(), "contours of Segment", false, {}, "Endo", "Epi", {}};
  std::map<std::size_t, std::vector<ForeignLoop>> stacks;
  for (std::size_t s = 0; s < count; ++s) {
    const Stack stack(file, *setstruct, s);
    if (auto loops = loops_of(file, stack); !loops.empty()) {
      note_moments(stack, loops, drawn);
      stacks[s] = std::move(loops);
    }
  }
  for (auto& [s, loops] : stacks)
    for (ForeignLoop& loop : loops) {
      if (stacks.size() > 1)
        loop.name = fmt::format("stack {}: {}", s + 1, loop.name);
      drawn.loops.push_back(std::move(loop));
    }
  if (stacks.size() > 1)
    drawn.endo = drawn.epi = "";
  if (stacks.empty())
    fail_segment(file, "holds no contours");
  return drawn;
}

}  // namespace

bool holds_segment_mat(const fs::path& file) {
  return first_bytes(file, 8).starts_with("MATLAB ");
}

ForeignContours read_segment_mat(const fs::path& file) {
  check_survives(file.string(), [&] { static_cast<void>(read_stacks(file)); });
  return read_stacks(file);
}

}  // namespace lv::image

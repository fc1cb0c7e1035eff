#pragma once

#include "lv/anatomy/anatomy.hpp"
#include "lv/anatomy/mesh_result.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/case.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lv::scar {

/// The infarct on the wall's mesh.
struct InfarctExtent {
  std::vector<double> M;     ///< M(X) per node
  std::vector<double> part;  ///< per element: of its volume that is infarcted
  /// How the slices of a late-enhancement image were moved, if the case asks for it.
  std::optional<Table> slice_moves;
};

/// Throws InputError for all that the case does not name of its infarct and must.
void require_infarct(const case_file::Case& c);

/// The infarct as the case asks for it. Throws InputError where a file cannot be used or the
/// infarct holds the centre of no element of the wall.
[[nodiscard]] InfarctExtent infarct_extent(const case_file::Case& c, const anatomy::Shape& shape,
                                           const mesh::Mesh& mesh);

/// The part of the wall's volume that a map does not show; `shows` says it of an element.
[[nodiscard]] double unseen_part(const mesh::Mesh& mesh, const std::function<bool(int)>& shows);

/// infarct.csv: per AHA segment the infarct's volume, mass (with the density of the case), part of
/// the segment and transmurality (see mesh::infarct_by_segment).
[[nodiscard]] Table infarct_table(const case_file::Case& c, const anatomy::MeshResult& wall);

/// "infarct: 68.54 ml (60.0% of the wall), 68.5 g; border zone: ..."; empty without an infarct.
[[nodiscard]] std::string describe_infarct(const case_file::Case& c,
                                           const anatomy::MeshResult& wall);

}  // namespace lv::scar

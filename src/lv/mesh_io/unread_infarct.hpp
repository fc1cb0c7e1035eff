#pragma once

#include <string>

namespace lv::mesh_io {

/// Something of a mesh's file that is called as an infarct is, and was not read.
struct UnreadInfarct {
  std::string name;
  bool at_points = false;  ///< of numbers at points, as anatomy.mesh.infarct_array names them; else
                           ///< a set of elements, as infarct.elements.set names it
};

/// Whether a name says that an infarct is meant, in capitals or not: "scar_core", "Infarct".
[[nodiscard]] bool is_infarct_name(const std::string& name);

}  // namespace lv::mesh_io

#pragma once

#include "lv/mesh/mesh.hpp"

#include <string>
#include <vector>

namespace lv::activation {

/// A file of activation times: a .vtu or .vtk file with an array of one number for each of its
/// points or cells, or a text with a number a line, as openCARP writes them.
struct TimesFile {
  std::string file;
  std::string array;  ///< of a VTK file; empty: the only one of single numbers
  double unit = 1.0;  ///< of its numbers [s]
};

/// The times at the nodes of a mesh [s], from those of its nodes, of its cells (of which a node
/// takes the mean of those around it, weighted by volume), and of quadratic elements their corners'
/// or their own. Throws InputError for another count, which it names, and for a time that is
/// missing or negative, as of muscle that is never activated.
[[nodiscard]] std::vector<double> read_times(const TimesFile& source, const mesh::Mesh& mesh);

}  // namespace lv::activation

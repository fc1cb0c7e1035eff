#pragma once

#include "lv/fluid/grid.hpp"

namespace lv::bench {

/// Time of the six bare FFTW transforms that one step's velocity needs: per component a real
/// transform of the whole box, cosine (REDFT00) along its own axis and sine (RODFT10, back RODFT01)
/// along the others, planned like the program's own (FFTW_ESTIMATE); on several ranks by FFTW-MPI
/// with transposed output, one exchange per transform [s].
[[nodiscard]] double bare_transforms(const fluid::Grid& grid);

}  // namespace lv::bench

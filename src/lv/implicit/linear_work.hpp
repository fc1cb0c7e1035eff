#pragma once

namespace lv::implicit {

/// What this process has done for equilibria so far, in tangents: each that was assembled counts,
/// with its factorisation, and at their usual shares of that each system solved with one, with its
/// residual, and each matrix that was made anew. Of the same steps it is the same on a busy
/// machine.
[[nodiscard]] double linear_work();

}  // namespace lv::implicit

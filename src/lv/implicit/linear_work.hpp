#pragma once

namespace lv::implicit {

/// What this process has done for equilibria so far, in tangents: each that was assembled counts,
/// with its factorisation, and so does each system solved with one, with its residual, as the usual
/// share of that. Of the same steps it is the same on a busy machine.
[[nodiscard]] double linear_work();

}  // namespace lv::implicit

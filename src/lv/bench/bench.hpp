#pragma once

#include "lv/immersed/model.hpp"

#include <string>
#include <vector>

namespace lv::bench {

/// One kernel of a time step, measured.
struct Row {
  std::string kernel;
  double seconds;   ///< per step: median over repetitions of the slowest rank's time
  double bytes;     ///< that must at least be moved to and from memory, all ranks [B]
  double flops;     ///< counted by hand, all ranks
  double roofline;  ///< least time at this machine's bandwidth and peak [s]; 0: not counted
};

/// What this machine's ranks reach together, measured in the same run.
struct Machine {
  double bandwidth;  ///< of a copy-and-scale of arrays larger than the caches [B/s]
  double peak;       ///< of fused multiply-adds on packs [1/s]
};

struct Bench {
  std::array<int, 3> cells;
  int ranks;
  int elements, nodes;
  Machine machine;
  std::vector<Row> rows;
  double peak_memory;  ///< of all ranks together [B]
};

/// Measures the kernels of a step of the model on a contracting wall:
///
///   transforms   six bare FFTW transforms of the velocity (three forward, three inverse, real to
///                real, on more ranks FFTW-MPI's transposed layout), the yardstick
///   stokes       the whole Stokes solve, with our own transforms
///   advect spread interpolate elastic active
///   step         a whole step of immersed::Model
[[nodiscard]] Bench measure(const mesh::Mesh& mesh, const immersed::ModelParameters& parameters,
                            const material::Myocardium& material);

/// A table for people, and one JSON object for programs.
[[nodiscard]] std::string text(const Bench& bench);
[[nodiscard]] std::string json(const Bench& bench);

}  // namespace lv::bench

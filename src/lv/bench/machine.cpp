#include "lv/bench/machine.hpp"

#include "lv/base/parallel.hpp"
#include "lv/base/tensor.hpp"
#include "lv/bench/stopwatch.hpp"

#include <sys/resource.h>

#include <array>
#include <vector>

namespace lv::bench {
namespace {

double bandwidth() {
  constexpr std::size_t n = 8U << 20U;  // 64 MiB per array: larger than caches
  std::vector<double> from(n, 1.0);
  std::vector<double> to(n, 2.0);
  const double seconds = median_seconds([&] {
    for (std::size_t i = 0; i < n; ++i)
      to[i] = 0.5 * from[i];
  });
  // the array written is read into the cache first
  return parallel::sum(3.0 * sizeof(double) * static_cast<double>(n) / seconds);
}

double peak() {
  constexpr int chains = 12;  // enough to hide the latency of two units
  constexpr int rounds = 1 << 20;
  std::array<Pack, chains> x;
  x.fill(Pack(1.0));
  const Pack a(0.999999);
  const Pack b(1e-6);
  const double seconds = median_seconds([&] {
    for (int i = 0; i < rounds; ++i)
      for (Pack& chain : x)
        chain = xsimd::fma(chain, a, b);
  });
  double kept = 0.0;  // so that nothing is optimised away
  for (const Pack& chain : x)
    kept += chain.get(0);
  const double flops = 2.0 * pack_size * chains * rounds;
  return parallel::sum(kept > 0.0 ? flops / seconds : 0.0);
}

}  // namespace

Machine measure_machine() {
  return {bandwidth(), peak()};
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return parallel::sum(1024.0 * static_cast<double>(usage.ru_maxrss));
}

}  // namespace lv::bench

# What almost every source includes, parsed once for the library and once for the tests. Only headers of others: a change of ours rebuilds no more than without.
# No JSON: its inline functions would be instantiated again in every file.
function(lv_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers>
    <numeric> <optional> <set> <span> <sstream> <string> <string_view> <utility> <variant> <vector>
    <Eigen/Dense> <fmt/format.h> <xsimd/xsimd.hpp> ${ARGN})
  # compiler caches look through a precompiled header only with it
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# The same headers as another target with the same options, not parsed again. With another level of optimisation GCC 12 takes them too, but
# compiles what includes them a third more slowly than without any precompiled header.
function(lv_precompile_as target other)
  target_precompile_headers(${target} REUSE_FROM ${other})
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

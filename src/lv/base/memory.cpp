#include "lv/base/memory.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

namespace lv {
namespace {

constexpr auto boundless = std::numeric_limits<std::uintmax_t>::max();

/// The number that a file of the kernel begins with; none if it holds a word ("max").
std::optional<std::uintmax_t> number_in(const std::string& file) {
  std::uintmax_t number = 0;
  return std::ifstream(file) >> number ? std::optional(number) : std::nullopt;
}

std::uintmax_t left(std::uintmax_t limit, std::uintmax_t used) {
  return limit > used ? limit - used : 0;
}

std::uintmax_t free_in_machine() {
  std::ifstream stream("/proc/meminfo");
  std::string word;
  while (stream >> word)
    if (std::uintmax_t kilobytes = 0; word == "MemAvailable:" && stream >> kilobytes)
      return 1024 * kilobytes;
  return boundless;
}

/// What the control group leaves, by version 2 or 1 of its files. Pages of files that it counts can
/// be given back, so they are no loss.
std::uintmax_t free_in_group(const std::string& folder, const std::string& limit,
                             const std::string& used) {
  const auto most = number_in(folder + limit);
  const auto now = number_in(folder + used);
  if (!most || !now)
    return boundless;
  std::ifstream stream(folder + "memory.stat");
  std::uintmax_t cached = 0;
  std::string word;
  while (stream >> word)
    if (word == "inactive_file" || word == "total_inactive_file")
      stream >> cached;
  return left(*most, left(*now, cached));
}

std::uintmax_t free_in_process() {
  rlimit bound{};
  if (getrlimit(RLIMIT_AS, &bound) != 0 || bound.rlim_cur == RLIM_INFINITY)
    return boundless;
  const auto pages = number_in("/proc/self/statm").value_or(0);
  return left(bound.rlim_cur, pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

std::uintmax_t free_memory() {
  return std::min(
      {free_in_machine(), free_in_process(),
       free_in_group("/sys/fs/cgroup/", "memory.max", "memory.current"),
       free_in_group("/sys/fs/cgroup/memory/", "memory.limit_in_bytes", "memory.usage_in_bytes")});
}

void require_memory(const std::string& file, double bytes) {
  constexpr double gigabyte = 1e9;
  const auto free = static_cast<double>(free_memory());
  if (bytes > free)
    throw RunError(fmt::format("{}: reading it takes {:.3g} GB of memory, and {:.3g} GB are free",
                               file, bytes / gigabyte, free / gigabyte),
                   "Crop the image or make it coarser, or use a machine with more memory");
}

}  // namespace lv

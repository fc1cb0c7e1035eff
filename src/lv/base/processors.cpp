#include "lv/base/processors.hpp"

#include "lv/base/interrupt.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <fstream>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace lv {
namespace {

constexpr double unlimited = 0.0;

/// Processors that one group allows.
double limit_of(const std::filesystem::path& group) {
  double time = 0.0;
  double period = 0.0;
  std::ifstream both(group / "cpu.max");  // "max 100000" where there is no limit
  if (!(both >> time >> period)) {
    std::ifstream(group / "cpu.cfs_quota_us") >> time;  // -1 where there is no limit
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  }
  return time > 0.0 && period > 0.0 ? time / period : unlimited;
}

int with_affinity() {
  cpu_set_t mine;
  if (sched_getaffinity(0, sizeof mine, &mine) == 0)
    return CPU_COUNT(&mine);
  return static_cast<int>(std::thread::hardware_concurrency());
}

/// The smallest limit of the control groups that this process is in.
int own_quota() {
  int least = 0;
  std::ifstream groups("/proc/self/cgroup");  // lines "number:controllers:/path"
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':');
    const auto second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos)
      continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const int here = quota(std::filesystem::path("/sys/fs/cgroup") / controllers,
                           std::filesystem::path(line.substr(second + 1)).relative_path());
    if (here > 0)
      least = least > 0 ? std::min(least, here) : here;
  }
  return least;
}

}  // namespace

int quota(const std::filesystem::path& root, const std::filesystem::path& group) {
  double least = limit_of(root);
  std::filesystem::path here = root;
  for (const auto& part : group) {
    here /= part;
    const double limit = limit_of(here);
    if (limit != unlimited)
      least = least == unlimited ? limit : std::min(least, limit);
  }
  return static_cast<int>(std::ceil(least));
}

int processors() {
  const int allowed = std::max(with_affinity(), 1);
  const int limit = own_quota();
  return limit > 0 ? std::min(allowed, limit) : allowed;
}

void in_threads(std::size_t n, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      try {
        interrupt::check();
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
        next = n;
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t most = std::min(static_cast<std::size_t>(processors()), n);
    try {
      while (helpers.size() + 1 < most)
        helpers.emplace_back(take_turns);
    } catch (const std::system_error&) {  // no more are to be had: those that there are do it
    }
    take_turns();
  }
  if (failure)
    std::rethrow_exception(failure);
}

}  // namespace lv

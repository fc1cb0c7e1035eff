#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

/// MPI in a few functions, all on the world communicator. One rank per core is the model.
namespace lv::parallel {

/// Starts MPI on construction and ends it on destruction. One per process, in main.
class Session {
 public:
  Session(int* argc, char*** argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

[[nodiscard]] int rank();
[[nodiscard]] int size();
[[nodiscard]] inline bool is_root() {
  return rank() == 0;
}

void barrier();

/// Runs something on the root alone; when it throws, all ranks throw: Interrupted if that is what
/// the root was, else FailedElsewhere.
void on_root(const std::function<void()>& work);

/// What the root's value is.
[[nodiscard]] bool root_says(bool value);

[[nodiscard]] double sum(double value);
[[nodiscard]] double max(double value);
[[nodiscard]] double min(double value);
[[nodiscard]] bool any(bool value);

/// Sums element by element over all ranks, in place.
void sum(std::span<double> values);

/// Copies the root's values to all ranks.
void broadcast(std::span<double> values);
void broadcast(std::string& text);

/// Joins the ranks' pieces in rank order on the root; empty elsewhere.
[[nodiscard]] std::vector<double> gather(std::span<const double> piece);

/// Gives every rank its piece of the root's values; `count` values for this rank.
[[nodiscard]] std::vector<double> scatter(std::span<const double> all, std::size_t count);

/// The half-open part [begin, end) of 0..n that belongs to a rank when n is cut into equal runs.
struct Range {
  int begin = 0;
  int end = 0;
  [[nodiscard]] int size() const { return end - begin; }
};
[[nodiscard]] Range share(int n, int rank, int ranks);

}  // namespace lv::parallel

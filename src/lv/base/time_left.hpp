#pragma once

#include <deque>
#include <mutex>
#include <string>

namespace lv {

/// ", about 3 min 20 s left"; nothing if the time [s] is negative, that is not known.
[[nodiscard]] std::string time_left(double seconds);

/// How long a piece of work will still take, from how fast its last part went.
class TimeLeft {
 public:
  /// Reports are due after so many seconds at the earliest.
  explicit TimeLeft(double interval = 5.0);

  /// How much has been done since the start, in any unit.
  void record(double done) { record(done, now()); }
  void record(double done, double at);

  /// Seconds that so much more will take, at the speed of the last third of the time since the
  /// start (or of the last ten seconds, if that is more); negative if nothing can be said yet.
  [[nodiscard]] double seconds(double left) const;

  /// The same in words.
  [[nodiscard]] std::string words(double left) const { return time_left(seconds(left)); }

  /// Whether a report is due; then the next is due after another interval.
  [[nodiscard]] bool due();

 private:
  [[nodiscard]] static double now();

  struct Sample {
    double at, done;
  };
  double interval_;
  double begun_ = now();
  double reported_ = begun_;
  std::deque<Sample> samples_{{begun_, 0.0}};
};

/// Logs how far equal pieces of work are, every few seconds; may be told from several threads.
class Progress {
 public:
  Progress(std::string what, std::size_t pieces) : what_(std::move(what)), pieces_(pieces) {}

  /// One more piece is done.
  void add();

 private:
  std::string what_;
  std::size_t pieces_;
  std::size_t done_ = 0;
  TimeLeft left_;
  std::mutex mutex_;
};

}  // namespace lv

#pragma once

#include "lv/base/tensor.hpp"

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lv::heartbeat {

/// What numbers of an archive may be; by default any that are finite.
struct Range {
  double low = std::numeric_limits<double>::lowest();
  double high = std::numeric_limits<double>::max();
  bool missing = false;  ///< NaN too, for what is not known
};

/// At least 0.
inline constexpr Range not_negative{0.0};

/// Points as the numbers of an archive, and back.
[[nodiscard]] std::vector<double> flat(std::span<const Vec3> vectors);
[[nodiscard]] std::vector<Vec3> vectors(std::span<const double> numbers);

/// Named arrays of numbers in one file. Written whole under a temporary name, flushed to the disk
/// and renamed; a checksum tells a damaged file from a good one.
class Archive {
 public:
  void set(const std::string& name, std::vector<double> values);

  /// Adds all arrays of another archive under "part.name", and takes them out again.
  void add(const std::string& part, Archive other);
  [[nodiscard]] Archive take(const std::string& part);

  /// Words or sentences, as the numbers of their bytes.
  void set_words(const std::string& name, const std::vector<std::string>& words);
  [[nodiscard]] std::vector<std::string> get_words(const std::string& name) const;

  /// Whatever the array holds. Throws RunError naming the array when it is absent.
  [[nodiscard]] const std::vector<double>& get(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;
  /// An array that has rows of `width` numbers in the range, and `rows` of them if that is said.
  /// Throws RunError naming it when it is absent, or is not as it should be.
  [[nodiscard]] const std::vector<double>& get_rows(const std::string& name, std::size_t width,
                                                    std::optional<std::size_t> rows = {},
                                                    Range range = {}) const;
  /// The same of an array of whole numbers.
  [[nodiscard]] std::vector<int> get_whole(const std::string& name,
                                           std::optional<std::size_t> count = {},
                                           Range range = {}) const;
  /// A number that was stored as one of an array. Throws RunError when it is no whole number, or
  /// not in the range.
  [[nodiscard]] int whole_number(double stored, Range range = {}) const;
  /// Throws RunError: why the file's contents cannot be used, and what to do.
  [[noreturn]] void refuse(const std::string& why) const;
  [[nodiscard]] bool has(const std::string& name) const { return arrays_.count(name) > 0; }

  /// Throws RunError when the file cannot be written (the previous one stays).
  void write(const std::filesystem::path& file) const;

  /// Throws RunError when the file cannot be read, is cut short or damaged.
  [[nodiscard]] static Archive read(const std::filesystem::path& file);

 private:
  std::map<std::string, std::vector<double>> arrays_;
  std::string source_ = "the archive";  ///< the file it was read from
};

}  // namespace lv::heartbeat

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::heartbeat {

/// A number that was stored as one of an array. Throws RunError when it is no whole number.
[[nodiscard]] int whole_number(double stored);

/// Named arrays of numbers in one file. Written whole under a temporary name, flushed to the disk
/// and renamed; a checksum tells a damaged file from a good one.
class Archive {
 public:
  void set(const std::string& name, std::vector<double> values);

  /// Throws RunError naming the array when it is absent, or is not as it should be.
  [[nodiscard]] const std::vector<double>& get(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;
  /// The same of an array that has rows of `width` numbers, and `rows` of them if that is said.
  [[nodiscard]] const std::vector<double>& get_rows(const std::string& name, std::size_t width,
                                                    std::optional<std::size_t> rows = {}) const;
  /// The same of an array of whole numbers.
  [[nodiscard]] std::vector<int> get_whole(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const { return arrays_.count(name) > 0; }

  /// Throws RunError when the file cannot be written (the previous one stays).
  void write(const std::filesystem::path& file) const;

  /// Throws RunError when the file cannot be read, is cut short or damaged.
  [[nodiscard]] static Archive read(const std::filesystem::path& file);

 private:
  std::map<std::string, std::vector<double>> arrays_;
};

}  // namespace lv::heartbeat

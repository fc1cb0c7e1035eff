#include "lv/heartbeat/archive.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/table.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

namespace lv::heartbeat {
namespace {

constexpr char magic[] = "ventricle archive 1\n";

std::uint32_t checksum(const std::string& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw RunError(
      fmt::format("{} {}", file.string(), why),
      fmt::format("Delete the folder {} to make it again, or restore the file from a copy",
                  file.parent_path().string()));
}

/// Takes values from the front of a run of bytes; fails when they run out.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const std::string& bytes, std::size_t position)
      : file_(file), bytes_(bytes), position_(position) {}

  /// The next `count` values, for which there is room only if they are there.
  template <class Values>
  Values take(std::uint64_t count) {
    constexpr std::size_t size = sizeof(typename Values::value_type);
    if (count > (bytes_.size() - position_) / size)
      fail(file_, "is damaged (an array is longer than the file)");
    Values values(count, {});
    std::copy_n(bytes_.data() + position_, count * size, reinterpret_cast<char*>(values.data()));
    position_ += count * size;
    return values;
  }
  [[nodiscard]] bool at_end() const { return position_ == bytes_.size(); }

 private:
  const std::filesystem::path& file_;
  const std::string& bytes_;
  std::size_t position_;
};

[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error) {
  throw RunError(fmt::format("{} cannot be written: {}", file.string(), std::strerror(error)),
                 "Check the folder's permissions and the space left on the disk");
}

/// Writes all bytes and waits until they are on the disk.
void write_durably(const std::filesystem::path& file, const std::string& bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  bool good = descriptor >= 0;
  for (std::size_t done = 0; good && done < bytes.size();) {
    const ssize_t written = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    good = written > 0;
    done += good ? static_cast<std::size_t>(written) : 0;
  }
  good = good && ::fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0)
    ::close(descriptor);
  if (!good)
    fail_to_write(file, error);
}

}  // namespace

std::vector<double> flat(std::span<const Vec3> vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors)
    numbers.insert(numbers.end(), v.data(), v.data() + 3);
  return numbers;
}

std::vector<Vec3> vectors(std::span<const double> numbers) {
  std::vector<Vec3> result;
  result.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return result;
}

void Archive::refuse(const std::string& why) const {
  throw RunError(fmt::format("{} cannot be used: {}", source_, why),
                 "It was written by another version of the program, or is damaged; delete it to "
                 "start this stage again");
}

int Archive::whole_number(double stored, Range range) const {
  constexpr int largest = std::numeric_limits<int>::max();
  const double low = std::max<double>(range.low, -largest);
  const double high = std::min<double>(range.high, largest);
  if (!(stored >= low && stored <= high) || stored != std::trunc(stored))
    refuse(fmt::format("it has {} where a whole number from {:.0f} to {:.0f} belongs", stored, low,
                       high));
  return static_cast<int>(stored);
}

void Archive::set(const std::string& name, std::vector<double> values) {
  arrays_[name] = std::move(values);
}

/// Each word is ended by a zero.
void Archive::set_words(const std::string& name, const std::vector<std::string>& words) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    for (const char letter : word)
      numbers.push_back(static_cast<unsigned char>(letter));
    numbers.push_back(0.0);
  }
  set(name, std::move(numbers));
}

std::vector<std::string> Archive::get_words(const std::string& name) const {
  std::vector<std::string> words;
  std::string word;
  for (const int letter : get_whole(name, {}, {0.0, 255.0})) {
    if (letter != 0)
      word += static_cast<char>(letter);
    else
      words.push_back(std::exchange(word, {}));
  }
  return words;
}

void Archive::add(const std::string& part, Archive other) {
  for (auto& array : other.arrays_)
    arrays_[fmt::format("{}.{}", part, array.first)] = std::move(array.second);
}

Archive Archive::take(const std::string& part) {
  const std::string prefix = part + ".";
  Archive taken;
  taken.source_ = source_;
  for (auto i = arrays_.lower_bound(prefix); i != arrays_.end() && i->first.starts_with(prefix);) {
    taken.arrays_[i->first.substr(prefix.size())] = std::move(i->second);
    i = arrays_.erase(i);
  }
  return taken;
}

const std::vector<double>& Archive::get(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end())
    refuse(fmt::format("it has no '{}'", name));
  return found->second;
}

double Archive::number(const std::string& name) const {
  return get_rows(name, 1, 1).front();
}

const std::vector<double>& Archive::get_rows(const std::string& name, std::size_t width,
                                             std::optional<std::size_t> rows, Range range) const {
  const std::vector<double>& numbers = get(name);
  if (numbers.size() % width != 0 || (rows && numbers.size() != width * *rows))
    refuse(fmt::format("it has {} numbers of '{}', which does not fit the rest", numbers.size(),
                       name));
  for (const double number : numbers)
    if (!(number >= range.low && number <= range.high) && !(range.missing && std::isnan(number)))
      refuse(fmt::format("it has {} among the numbers of '{}', which lie between {:g} and {:g}",
                         number, name, range.low, range.high));
  return numbers;
}

std::vector<int> Archive::get_whole(const std::string& name, std::optional<std::size_t> count,
                                    Range range) const {
  std::vector<int> whole;
  for (const double number : get_rows(name, 1, count))
    whole.push_back(whole_number(number, range));
  return whole;
}

void Archive::write(const std::filesystem::path& file) const {
  std::string bytes;
  for (const auto& [name, values] : arrays_) {
    const std::uint64_t sizes[2] = {name.size(), values.size()};
    append(bytes, sizes, sizeof sizes);
    append(bytes, name.data(), name.size());
    append(bytes, values.data(), values.size() * sizeof(double));
  }
  const std::uint32_t crc = checksum(bytes);
  std::string whole = magic;
  append(whole, &crc, sizeof crc);
  whole += bytes;
  const std::filesystem::path unfinished = file.string() + ".part";
  write_durably(unfinished, whole);
  std::error_code error;
  std::filesystem::rename(unfinished, file, error);
  if (error)
    fail_to_write(file, error.value());
}

Archive Archive::read(const std::filesystem::path& file) {
  if (const std::string why = unreadable(file); !why.empty())
    fail(file, why);
  const std::string whole = read_file(file);
  const std::size_t header = std::strlen(magic) + sizeof(std::uint32_t);
  if (whole.size() < header || whole.compare(0, std::strlen(magic), magic) != 0)
    fail(file, "is not a checkpoint of this program");
  std::uint32_t crc = 0;
  std::memcpy(&crc, whole.data() + std::strlen(magic), sizeof crc);
  if (crc != checksum(whole.substr(header)))
    fail(file, "is damaged (its checksum is wrong)");

  Archive archive;
  archive.source_ = file.string();
  for (Reader reader(file, whole, header); !reader.at_end();) {
    const auto sizes = reader.take<std::vector<std::uint64_t>>(2);
    const auto name = reader.take<std::string>(sizes[0]);
    archive.arrays_[name] = reader.take<std::vector<double>>(sizes[1]);
  }
  return archive;
}

}  // namespace lv::heartbeat

#include "lv/heartbeat/archive.hpp"

#include "lv/base/check.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

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

/// Takes values from the front of a run of bytes; throws when they run out.
class Reader {
 public:
  Reader(const std::string& bytes, std::size_t position) : bytes_(bytes), position_(position) {}

  void take(void* data, std::size_t size) {
    if (size > bytes_.size() - position_)
      throw RunError("the archive is cut short", "");
    std::memcpy(data, bytes_.data() + position_, size);
    position_ += size;
  }
  [[nodiscard]] bool at_end() const { return position_ == bytes_.size(); }

 private:
  const std::string& bytes_;
  std::size_t position_;
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw RunError(
      fmt::format("{} {}", file.string(), why),
      fmt::format("Delete the folder {} to make it again, or restore the file from a copy",
                  file.parent_path().string()));
}

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

void Archive::set(const std::string& name, std::vector<double> values) {
  arrays_[name] = std::move(values);
}

const std::vector<double>& Archive::get(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end())
    throw RunError(
        fmt::format("the archive has no '{}'", name),
        "It was written by another version of the program; delete it to start this stage again");
  return found->second;
}

double Archive::number(const std::string& name) const {
  return get(name).at(0);
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
  std::ifstream in(file, std::ios::binary);
  if (!in)
    fail(file, "cannot be read");
  std::ostringstream contents;
  contents << in.rdbuf();
  const std::string whole = contents.str();
  const std::size_t header = std::strlen(magic) + sizeof(std::uint32_t);
  if (whole.size() < header || whole.compare(0, std::strlen(magic), magic) != 0)
    fail(file, "is not a checkpoint of this program");
  std::uint32_t crc = 0;
  std::memcpy(&crc, whole.data() + std::strlen(magic), sizeof crc);
  if (crc != checksum(whole.substr(header)))
    fail(file, "is damaged (its checksum is wrong)");

  Archive archive;
  for (Reader reader(whole, header); !reader.at_end();) {
    std::uint64_t sizes[2] = {0, 0};
    reader.take(sizes, sizeof sizes);
    std::string name(sizes[0], '\0');
    reader.take(name.data(), name.size());
    std::vector<double> values(sizes[1]);
    reader.take(values.data(), values.size() * sizeof(double));
    archive.arrays_[name] = std::move(values);
  }
  return archive;
}

}  // namespace lv::heartbeat

#include "lv/job/workspace.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace lv::job {
namespace {

constexpr const char* record_name = "stage.json";

std::string checksum(const std::string& text) {
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, ~0ULL, ~0ULL, true, true> crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:016x}", crc.checksum());
}

/// The recorded ingredients of a folder; empty when there is no readable record.
Ingredients recorded(const std::filesystem::path& folder) {
  std::ifstream in(folder / record_name);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded() || !json.is_object())
    return {};
  Ingredients ingredients;
  for (const auto& [name, value] : json.items())
    if (value.is_string())
      ingredients[name] = value;
  return ingredients;
}

void record(const std::filesystem::path& folder, const Ingredients& ingredients) {
  write_file(folder / record_name, nlohmann::json(ingredients).dump(1) + "\n");
}

}  // namespace

std::string fingerprint(const Ingredients& ingredients) {
  return checksum(nlohmann::json(ingredients).dump());
}

std::string fingerprint_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return "absent";
  std::ostringstream contents;
  contents << in.rdbuf();
  return checksum(contents.str());
}

StageFolder::StageFolder(const std::filesystem::path& work, const std::string& name,
                         Ingredients ingredients)
    : folder_(work / name), ingredients_(std::move(ingredients)) {}

std::filesystem::path StageFolder::unfinished() const {
  return folder_.string() + ".part";
}

bool StageFolder::up_to_date() const {
  return recorded(folder_) == ingredients_;
}

std::string StageFolder::reason() const {
  const Ingredients before = recorded(folder_);
  if (before.empty())
    return recorded(unfinished()) == ingredients_ ? "it was interrupted" : "it has not run yet";
  for (const auto& [name, value] : ingredients_) {
    const auto old = before.find(name);
    if (old == before.end())
      return fmt::format("{} is new", name);
    if (old->second != value)
      return fmt::format("{} has changed from {} to {}", name, old->second, value);
  }
  for (const auto& [name, value] : before)
    if (ingredients_.count(name) == 0)
      return fmt::format("{} is gone", name);
  return "nothing has changed";
}

std::filesystem::path StageFolder::begin() const {
  const std::filesystem::path part = unfinished();
  if (recorded(part) != ingredients_)
    std::filesystem::remove_all(part);
  std::error_code error;
  std::filesystem::create_directories(part, error);
  if (error)
    throw RunError(fmt::format("{} cannot be made: {}", part.string(), error.message()),
                   "Check the folder's permissions, or name another one with --work");
  record(part, ingredients_);
  return part;
}

void StageFolder::finish() const {
  std::filesystem::remove_all(folder_);
  std::filesystem::rename(unfinished(), folder_);
}

WorkLock::WorkLock(const std::filesystem::path& work) {
  std::error_code error;
  std::filesystem::create_directories(work, error);
  const std::filesystem::path file = work / ".lock";
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT, 0644);
  if (descriptor_ < 0)
    throw RunError(fmt::format("{} cannot be written", work.string()),
                   "Check the folder's permissions, or name another one with --work");
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor_);
    throw RunError(fmt::format("another run is at work in {}", work.string()),
                   "Wait for it to end, or name another folder with --work");
  }
}

WorkLock::~WorkLock() {
  ::close(descriptor_);
}

}  // namespace lv::job

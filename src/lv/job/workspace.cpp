#include "lv/job/workspace.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/log.hpp"
#include "lv/base/table.hpp"
#include "lv/job/parameters.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <optional>

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
  if (!unreadable(folder / record_name).empty())
    return {};
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

void move(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error)
    throw RunError(
        fmt::format("{} cannot be renamed to {}: {}", from.string(), to.string(), error.message()),
        "Check the folder's permissions, or name another one with --work");
}

/// The earlier stage that a stage's record names as other than it is now, if any.
std::optional<std::size_t> outdated_source(const std::filesystem::path& work, std::size_t stage) {
  const Ingredients record = recorded(work / stage_folder(stage));
  for (std::size_t s = 0; s < stage; ++s) {
    const auto entry = record.find("result of " + stage_names[s]);
    if (entry != record.end() && entry->second != fingerprint(recorded(work / stage_folder(s))))
      return s;
  }
  return {};
}

/// Of a text file; empty when there is none.
std::string last_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    last = line;
  return last;
}

}  // namespace

std::string stage_folder(std::size_t stage) {
  static const std::array<std::string, stage_names.size()> numbers{"00",  "01", "02", "02b",
                                                                   "02c", "03", "04", "05"};
  return numbers.at(stage) + "_" + stage_names.at(stage);
}

std::string fingerprint(const Ingredients& ingredients) {
  return checksum(nlohmann::json(ingredients).dump());
}

std::string fingerprint_of_file(const std::filesystem::path& file) {
  return unreadable(file).empty() ? checksum(read_file(file)) : "absent";
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
  if (std::filesystem::exists(part) && recorded(part) != ingredients_) {
    const std::filesystem::path other = folder_.string() + ".other";
    log::warn("{} holds an unfinished run with other parameters; it is now {}", part.string(),
              other.string());
    std::filesystem::remove_all(other);
    move(part, other);
  }
  std::error_code error;
  std::filesystem::create_directories(part, error);
  if (error)
    throw RunError(fmt::format("{} cannot be made: {}", part.string(), error.message()),
                   "Check the folder's permissions, or name another one with --work");
  record(part, ingredients_);
  return part;
}

/// The old folder goes last: a kill at any moment leaves a whole one, old or new.
void StageFolder::finish() const {
  const std::filesystem::path old = folder_.string() + ".old";
  std::filesystem::remove_all(old);
  if (std::filesystem::exists(folder_))
    move(folder_, old);
  move(unfinished(), folder_);
  std::filesystem::remove_all(old);
}

std::vector<std::string> state_of(const std::filesystem::path& work) {
  constexpr auto results = static_cast<std::size_t>(Stage::results);
  if (std::filesystem::is_directory(work))
    check_contents(work);
  std::vector<std::string> state;
  std::size_t found = 0;
  for (std::size_t s = 0; s <= results; ++s) {
    const std::filesystem::path folder = work / stage_folder(s);
    const bool whole = std::filesystem::exists(folder);
    const bool begun = std::filesystem::exists(folder.string() + ".part");
    found += whole || begun ? 1 : 0;
    if (whole && begun)
      state.push_back(fmt::format(
          "A newer run has begun {} and has not finished it; what is shown is the one before.",
          stage_folder(s)));
    else if (begun)
      state.push_back(fmt::format("{} is unfinished.", stage_folder(s)));
    else if (!whole && static_cast<Stage>(s) != Stage::calibrate &&
             static_cast<Stage>(s) != Stage::unload &&
             static_cast<Stage>(s) != Stage::strain)  // which few cases ask for
      state.push_back(fmt::format("{} has not been made.", stage_folder(s)));
    else if (const auto source = outdated_source(work, s))
      state.push_back(fmt::format("{} was made from another {} than the one that is there.",
                                  stage_folder(s), stage_folder(*source)));
  }
  if (found == 0)
    throw InputError(work.string(), "holds no results of a run",
                     "Name a work folder of ventricle run");
  if (const std::string line = last_line(work / "log.txt"); !state.empty() && !line.empty())
    state.push_back("The log ends: " + line);
  return state;
}

void check_contents(const std::filesystem::path& work) {
  std::error_code failed;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(work)) {
    const std::filesystem::file_status status = std::filesystem::status(entry, failed);
    if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status))
      throw RunError(fmt::format("{} is neither a file nor a folder{}", entry.path().string(),
                                 failed ? ": " + failed.message() : ""),
                     "Remove it, or name another work folder with --work");
  }
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
    const bool taken = errno == EWOULDBLOCK;
    ::close(descriptor_);
    if (!taken)
      throw RunError(fmt::format("{} cannot be locked", file.string()),
                     "Name a folder on a local disk with --work");
    throw RunError(fmt::format("another run is at work in {}", work.string()),
                   "Wait for it to end, or name another folder with --work");
  }
  check_contents(work);
}

WorkLock::~WorkLock() {
  ::close(descriptor_);
}

}  // namespace lv::job

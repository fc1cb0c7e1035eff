#include "lv/work/workspace.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/log.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/parameters.hpp"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

namespace lv::work {
namespace {

using case_file::Stage;
namespace fs = std::filesystem;

constexpr const char* record_name = "stage.json";

using Checksum = boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, ~0ULL, ~0ULL, true, true>;

std::string text_of(const Checksum& crc) {
  return fmt::format("{:016x}", crc.checksum());
}

/// Names of files need not be UTF-8.
std::string text_of(const nlohmann::json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// What a stage's folder says of itself.
struct Record {
  Ingredients ingredients;
  std::optional<std::map<std::string, std::uintmax_t>> sizes;  ///< of the files of a finished stage
};

/// Empty when there is no readable record.
Record recorded(const fs::path& folder) {
  if (!unreadable(folder / record_name).empty())
    return {};
  std::ifstream in(folder / record_name);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("ingredients") || !json.at("ingredients").is_object())
    return {};
  Record record;
  for (const auto& [name, value] : json.at("ingredients").items())
    if (value.is_string())
      record.ingredients[name] = value;
  if (!json.contains("bytes") || !json.at("bytes").is_object())
    return record;
  record.sizes.emplace();
  for (const auto& [name, value] : json.at("bytes").items())
    if (value.is_number_unsigned())
      (*record.sizes)[name] = value;
  return record;
}

void write_record(const fs::path& folder, const Record& record) {
  nlohmann::json json{{"ingredients", record.ingredients}};
  if (record.sizes)
    json["bytes"] = *record.sizes;
  write_file(folder / record_name, text_of(json, 1) + "\n");
}

/// Sizes of all files below a folder but its record.
std::map<std::string, std::uintmax_t> sizes_below(const fs::path& folder) {
  std::map<std::string, std::uintmax_t> sizes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path() != folder / record_name)
      sizes[entry.path().lexically_relative(folder).string()] = entry.file_size();
  return sizes;
}

/// Whether a folder is there without a record that can be read.
bool has_damaged_record(const fs::path& folder) {
  return fs::exists(folder) && recorded(folder).ingredients.empty();
}

std::string damaged_record() {
  return fmt::format("its record ({}) is gone or damaged", record_name);
}

/// What a folder lacks of a finished stage's files, in words; empty if nothing.
std::string lack_of(const fs::path& folder, const Record& record) {
  if (record.ingredients.empty())
    return damaged_record();
  if (!record.sizes)
    return "it has no list of its files";
  for (const auto& [name, bytes] : *record.sizes) {
    std::error_code error;
    const std::uintmax_t now = fs::file_size(folder / name, error);
    if (error)
      return fmt::format("its file {} is gone", name);
    if (now != bytes)
      return fmt::format("its file {} has {} bytes and had {}", name, now, bytes);
  }
  return "";
}

/// Waits until a file or folder is on the disk.
void sync(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool failed = descriptor < 0 || (::fsync(descriptor) != 0 && errno != EINVAL);
  const std::string why = std::strerror(errno);
  if (descriptor >= 0)
    ::close(descriptor);
  if (failed)
    throw RunError(fmt::format("{} cannot be brought to the disk: {}", path.string(), why),
                   "Check the space left on the disk and its health");
}

void sync_below(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() || entry.is_directory())
      sync(entry.path());
  sync(folder);
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw RunError(
        fmt::format("{} cannot be renamed to {}: {}", from.string(), to.string(), error.message()),
        "Check the folder's permissions, or name another one with --work");
}

/// The earlier stage that a stage's record names as other than it is now, if any.
std::optional<std::size_t> outdated_source(const fs::path& work, std::size_t stage) {
  const Ingredients record = recorded(work / stage_folder(stage)).ingredients;
  for (std::size_t s = 0; s < stage; ++s) {
    const auto entry = record.find("result of " + stage_names[s]);
    if (entry != record.end() &&
        entry->second != fingerprint_of_result(recorded(work / stage_folder(s)).ingredients))
      return s;
  }
  return {};
}

/// Refuses folders that bear the names of stages and were not made by this program: what the
/// remedies for damaged stages delete must be its own.
void require_own(const fs::path& work) {
  bool any = false;
  for (std::size_t s = 0; s < case_file::all_stages.size(); ++s)
    for (const fs::path& folder :
         {work / stage_folder(s), fs::path((work / stage_folder(s)).string() + ".part")}) {
      if (!recorded(folder).ingredients.empty())
        return;
      any = any || fs::exists(folder);
    }
  if (any)
    throw InputError(work.string(),
                     fmt::format("is no work folder of this program: none of its folders has a "
                                 "stage's record ({})",
                                 record_name),
                     "Name a work folder of ventricle run");
}

/// Whether few cases ask for a stage.
bool is_of_few(Stage stage) {
  return stage == Stage::circulation || stage == Stage::strain || stage == Stage::calibrate ||
         stage == Stage::unload;
}

/// Of a text file; empty when there is none.
std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    last = line;
  return last;
}

}  // namespace

std::string fingerprint(const Ingredients& ingredients) {
  const std::string text = text_of(nlohmann::json(ingredients), -1);
  Checksum crc;
  crc.process_bytes(text.data(), text.size());
  return text_of(crc);
}

std::string fingerprint_of_result(Ingredients ingredients) {
  std::erase_if(ingredients, [](const auto& i) { return i.first.starts_with(remark_start); });
  return fingerprint(ingredients);
}

std::string fingerprint_of_file(const fs::path& file) {
  if (!unreadable(file).empty())
    return "absent";
  std::ifstream in(file, std::ios::binary);
  Checksum crc;
  std::vector<char> piece(1U << 20U);
  do {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    crc.process_bytes(piece.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  return text_of(crc);
}

StageFolder::StageFolder(const fs::path& work, const std::string& name, Ingredients ingredients)
    : folder_(work / name), ingredients_(std::move(ingredients)) {}

fs::path StageFolder::unfinished() const {
  return folder_.string() + ".part";
}

bool StageFolder::up_to_date() const {
  const Record record = recorded(folder_);
  return record.ingredients == ingredients_ && lack_of(folder_, record).empty();
}

std::string StageFolder::reason() const {
  const Record record = recorded(folder_);
  const Ingredients& before = record.ingredients;
  if (has_damaged_record(folder_))
    return damaged_record();
  if (before.empty() && has_damaged_record(unfinished()))
    return "it was interrupted, and " + damaged_record();
  if (before.empty())
    return recorded(unfinished()).ingredients == ingredients_ ? "it was interrupted"
                                                              : "it has not run yet";
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
  const std::string lack = lack_of(folder_, record);
  return lack.empty() ? "nothing has changed" : lack;
}

/// Unfinished runs with other ingredients: NAME.other, NAME.other2, ...
std::vector<fs::path> StageFolder::kept() const {
  std::vector<fs::path> folders;
  const std::string name = folder_.filename().string() + ".other";
  for (const auto& entry : fs::directory_iterator(folder_.parent_path()))
    if (entry.path().filename().string().starts_with(name))
      folders.push_back(entry.path());
  return folders;
}

fs::path StageFolder::free_name() const {
  fs::path folder = folder_.string() + ".other";
  for (int n = 2; fs::exists(folder); ++n)
    folder = fmt::format("{}.other{}", folder_.string(), n);
  return folder;
}

void StageFolder::set_aside(const fs::path& part) const {
  if (!fs::exists(part) || recorded(part).ingredients == ingredients_)
    return;
  if (sizes_below(part).empty()) {  // nothing but its record: no work is lost
    fs::remove_all(part);
    return;
  }
  const fs::path other = free_name();
  move(part, other);
  const bool damaged = has_damaged_record(other);
  log::warn(
      "{} held an unfinished run {}, which is kept as {}: {}it may be deleted (rm -r) when it "
      "is not wanted",
      part.filename().string(), damaged ? "whose record is damaged" : "with other parameters",
      other.filename().string(),
      damaged ? "" : "a run with its parameters goes on from there, and ");
}

void StageFolder::take_up(const fs::path& part) const {
  if (fs::exists(part) || !fs::exists(folder_.parent_path()))
    return;
  for (const fs::path& other : kept())
    if (recorded(other).ingredients == ingredients_) {
      move(other, part);
      log::info("{} goes on from {}", part.filename().string(), other.filename().string());
      return;
    }
}

fs::path StageFolder::begin() const {
  const fs::path part = unfinished();
  set_aside(part);
  take_up(part);
  std::error_code error;
  fs::create_directories(part, error);
  if (error)
    throw RunError(fmt::format("{} cannot be made: {}", part.string(), error.message()),
                   "Check the folder's permissions, or name another one with --work");
  write_record(part, {ingredients_, {}});
  return part;
}

/// What the record lists is on the disk before it says so. The old folder goes last: a kill at any
/// moment leaves a whole one, old or new.
void StageFolder::finish() const {
  const fs::path part = unfinished();
  sync_below(part);
  write_record(part, {ingredients_, sizes_below(part)});
  sync(part / record_name);
  sync(part);
  const fs::path old = folder_.string() + ".old";
  fs::remove_all(old);
  if (fs::exists(folder_))
    move(folder_, old);
  move(part, folder_);
  sync(folder_.parent_path());
  fs::remove_all(old);
}

std::vector<std::string> state_of(const fs::path& work) {
  constexpr auto results = static_cast<std::size_t>(Stage::results);
  if (fs::is_directory(work)) {
    check_contents(work);
    require_own(work);
  }
  std::vector<std::string> state;
  std::size_t found = 0;
  for (std::size_t s = 0; s <= results; ++s) {
    const fs::path folder = work / stage_folder(s);
    const bool whole = fs::exists(folder);
    const bool begun = fs::exists(folder.string() + ".part");
    const std::string lack = whole ? lack_of(folder, recorded(folder)) : "";
    found += whole || begun ? 1 : 0;
    if (whole && begun)
      state.push_back(fmt::format(
          "A newer run has begun {} and has not finished it; what is shown is the one before.",
          stage_folder(s)));
    else if (begun)
      state.push_back(fmt::format("{} is unfinished.", stage_folder(s)));
    else if (!whole && !is_of_few(static_cast<Stage>(s)))
      state.push_back(fmt::format("{} has not been made.", stage_folder(s)));
    else if (!lack.empty())
      state.push_back(fmt::format("{} is not whole: {}.", stage_folder(s), lack));
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

void check_contents(const fs::path& work) {
  using fs::recursive_directory_iterator;
  const auto is_of_stage = [](const std::string& name) {
    for (std::size_t s = 0; s < case_file::all_stages.size(); ++s)
      if (name.starts_with(stage_folder(s)))
        return true;
    return false;
  };
  std::error_code ignored;  // what a run that is at work takes away meanwhile is not there
  recursive_directory_iterator entry(work);
  for (; entry != recursive_directory_iterator(); entry.increment(ignored)) {
    const fs::file_status status = fs::status(*entry, ignored);
    if (entry.depth() == 0 && !is_of_stage(entry->path().filename().string()))
      entry.disable_recursion_pending();
    const bool is_there = fs::exists(entry->symlink_status(ignored));
    if (is_there && !fs::is_regular_file(status) && !fs::is_directory(status))
      throw RunError(fmt::format("{} is neither a file nor a folder", entry->path().string()),
                     "Name another work folder with --work, or remove it if a run left it");
  }
}

WorkLock::WorkLock(const fs::path& work) {
  std::error_code error;
  fs::create_directories(work, error);
  const fs::path file = work / ".lock";
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
  try {
    check_contents(work);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

WorkLock::~WorkLock() {
  ::close(descriptor_);
}

}  // namespace lv::work

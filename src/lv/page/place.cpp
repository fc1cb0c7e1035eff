#include "lv/page/place.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"

#include <boost/crc.hpp>
#include <fmt/format.h>

#include <system_error>

namespace lv::page {
namespace {

namespace fs = std::filesystem;

/// Both pages have their title before all that grows; report.html has a licence before it.
bool begins_as_page(const std::string& text) {
  return text.starts_with("<!doctype html>") && text.find("<title>ventricle") != std::string::npos;
}

constexpr std::size_t head = 4096;  // bytes

}  // namespace

void require_place(const fs::path& file) {
  std::error_code none;
  const fs::path folder = file.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, none))
    throw InputError(file.string(), fmt::format("there is no folder {}", folder.string()),
                     "Make it, or name a file in another one");
  if (!fs::exists(file, none))
    return;
  if (fs::is_directory(file, none))
    throw InputError(file.string(), "is a folder", "Name a file, in it or elsewhere");
  if (!fs::is_regular_file(file, none))
    throw InputError(file.string(), "is neither a file nor a folder", "Name a file");
  const bool is_empty = fs::file_size(file, none) == 0;
  if (!is_empty && !begins_as_page(first_bytes(file, head)))
    throw InputError(file.string(), "exists already and is no page that this program wrote",
                     "Choose another name, or remove it");
}

std::string runs_element(const std::vector<fs::path>& works) {
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, ~0ULL, ~0ULL, true, true> checksum;  // ECMA-182
  for (const fs::path& work : works) {
    const std::string name = (fs::weakly_canonical(fs::absolute(work)) / "").lexically_normal();
    checksum.process_bytes(name.c_str(), name.size() + 1);  // with the end of each
  }
  return fmt::format("<meta name=\"ventricle-runs\" content=\"{:016x}\">", checksum.checksum());
}

void require_same_runs(const fs::path& file, const std::vector<fs::path>& works) {
  std::error_code none;
  if (!fs::exists(file, none) || fs::file_size(file, none) == 0)
    return;
  if (first_bytes(file, head).find(runs_element(works)) == std::string::npos)
    throw InputError(file.string(), "exists already and is the page of another run",
                     "Choose a name with --output, which may also be this one to replace it");
}

}  // namespace lv::page

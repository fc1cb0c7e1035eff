#include "lv/report/work_folder.hpp"

#include <algorithm>

namespace lv::report {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& work, const std::string& stage) {
  constexpr const char* digits = "0123456789";
  fs::path unfinished;
  for (const auto& entry : fs::directory_iterator(work)) {
    const std::string name = entry.path().filename();  // "03_beat", "02b_calibrate"
    const std::size_t number = name.find('_');
    if (number == std::string::npos || name.find_first_of(digits) != 0)
      continue;
    if (name.substr(number + 1) == stage)
      return entry.path();
    if (name.substr(number + 1) == stage + ".part")
      unfinished = entry.path();
  }
  return unfinished;
}

fs::path file_of(const fs::path& work, const std::string& stage, const std::string& file) {
  const fs::path folder = folder_of(work, stage);
  return !folder.empty() && fs::exists(folder / file) ? folder / file : fs::path();
}

std::optional<Table> table_of(const fs::path& work, const std::string& stage,
                              const std::string& file) {
  const fs::path path = file_of(work, stage, file);
  if (path.empty())
    return {};
  Table table = Table::read_csv(path);
  if (table.rows().empty())
    return {};
  return table;
}

std::optional<double> time_of(const fs::path& work, const std::string& moment) {
  const auto moments = table_of(work, "beat", "moments.csv");
  if (!moments)
    return {};
  const auto names = moments->words("moment");
  const auto found = std::find(names.begin(), names.end(), moment);
  if (found == names.end())
    return {};
  return moments->numbers("time_s").at(static_cast<std::size_t>(found - names.begin()));
}

}  // namespace lv::report

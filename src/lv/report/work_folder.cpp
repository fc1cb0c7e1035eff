#include "lv/report/work_folder.hpp"

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

std::vector<std::pair<std::string, double>> moments_of(const fs::path& work) {
  const auto table = table_of(work, "beat", "moments.csv");
  if (!table)
    return {};
  const auto names = table->words("moment");
  const auto times = table->numbers("time_s");
  std::vector<std::pair<std::string, double>> moments;
  for (std::size_t i = 0; i < names.size(); ++i)
    moments.emplace_back(names[i], times[i]);
  return moments;
}

std::optional<double> time_of(const fs::path& work, const std::string& moment) {
  for (const auto& [name, time] : moments_of(work))
    if (name == moment)
      return time;
  return {};
}

}  // namespace lv::report

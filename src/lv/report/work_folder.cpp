#include "lv/report/work_folder.hpp"

#include "lv/base/stage_folders.hpp"

namespace lv::report {

namespace fs = std::filesystem;

namespace {

constexpr const char* case_file_name = "case.txt";

}  // namespace

fs::path folder_of(const fs::path& work, const std::string& stage) {
  const fs::path finished = work / stage_folder(stage);
  const fs::path unfinished = finished.string() + ".part";
  return fs::exists(finished) ? finished : fs::exists(unfinished) ? unfinished : fs::path();
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

void write_case_name(const fs::path& work, const std::string& name) {
  write_file(work / case_file_name, name + "\n");
}

std::string case_name(const fs::path& work) {
  const fs::path file = work / case_file_name;
  if (!fs::is_regular_file(file))
    return "";
  const std::string text = read_file(file);
  return text.substr(0, text.find('\n'));
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

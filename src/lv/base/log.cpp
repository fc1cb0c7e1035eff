#include "lv/base/log.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/log_count.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/printable.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdlib>
#include <memory>

namespace lv::log {
namespace {

/// Levels in colours where a person reads, unless NO_COLOR asks for none (no-color.org).
std::shared_ptr<spdlog::sinks::sink> terminal() {
  const char* plain = std::getenv("NO_COLOR");
  return std::make_shared<spdlog::sinks::stdout_color_sink_mt>(plain != nullptr && *plain != '\0'
                                                                   ? spdlog::color_mode::never
                                                                   : spdlog::color_mode::automatic);
}

/// Made at the first line; ranks other than the root have no sinks.
spdlog::logger& logger() {
  static spdlog::logger instance = [] {
    spdlog::logger made("ventricle");
    if (parallel::is_root())
      made.sinks().push_back(terminal());
    made.set_pattern("[%H:%M:%S] %^%l%$ %v");
    made.flush_on(spdlog::level::info);
    return made;
  }();
  return instance;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw RunError(fmt::format("{} cannot be written: {}", file.string(), why),
                 "Move it away, or name another work folder with --work");
}

/// The file that lines go to besides, if any.
struct File {
  std::shared_ptr<spdlog::logger> logger;
  NamesAlone names;
};

File& kept() {
  static File file;
  return file;
}

int& count_of_warnings() {
  static int count = 0;
  return count;
}

void write(spdlog::level::level_enum level, const std::string& text) {
  const std::string line = printable_lines(text);
  logger().log(level, line);
  if (kept().logger)
    kept().logger->log(level, kept().names(line));
}

}  // namespace

void to_file(const std::filesystem::path& file, const NamesAlone& names) {
  if (!parallel::is_root())
    return;
  const std::filesystem::file_type type = std::filesystem::symlink_status(file).type();
  const bool is_new = type == std::filesystem::file_type::not_found;
  if (const std::string why = is_new ? "" : unreadable(file); !why.empty())
    refuse(file, why);
  std::shared_ptr<spdlog::sinks::basic_file_sink_mt> sink;
  try {
    sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
  } catch (const spdlog::spdlog_ex& error) {
    refuse(file, error.what());
  }
  kept() = {std::make_shared<spdlog::logger>("file", std::move(sink)), names};
  kept().logger->set_pattern("[%Y-%m-%d %H:%M:%S] %l %v");
  kept().logger->flush_on(spdlog::level::info);
}

void silence() {
  if (!logger().sinks().empty())
    logger().sinks().front()->set_level(spdlog::level::off);
}

void info(const std::string& line) {
  write(spdlog::level::info, line);
}
void warn(const std::string& line) {
  ++count_of_warnings();
  write(spdlog::level::warn, line);
}

int warnings() {
  return count_of_warnings();
}

void keep(const std::string& line) {
  if (kept().logger)
    kept().logger->warn(kept().names(printable_lines(line)));
}

std::string duration(double seconds) {
  const auto s = static_cast<int>(std::lround(seconds));
  if (s < 60)
    return fmt::format("{} s", s);
  if (s < 600)
    return fmt::format("{} min {} s", s / 60, s % 60);
  if (s < 3600)
    return fmt::format("{} min", std::lround(seconds / 60.0));
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

}  // namespace lv::log

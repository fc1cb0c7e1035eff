#include "lv/draw/browser.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

namespace lv::draw {
namespace {

namespace fs = std::filesystem;

/// A file for this user alone; an empty name where none can be made.
fs::path private_file(const std::string& text) {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "ventricle-draw-XXXXXX.html").string();
  const int file = mkstemps(name.data(), 5);
  if (file < 0)
    return {};
  const bool whole = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  if (whole)
    return name;
  fs::remove(name, error);
  return {};
}

/// Starts a program by itself, its words unseen.
void start(std::array<const char*, 3> arguments) {
  posix_spawn_file_actions_t quiet{};
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_RDWR, 0);
  posix_spawnattr_t own{};
  posix_spawnattr_init(&own);
  sigset_t usual{};
  sigemptyset(&usual);
  sigaddset(&usual, SIGCHLD);
  posix_spawnattr_setsigdefault(&own, &usual);
  // Ctrl-C here is not for the browser
  posix_spawnattr_setflags(&own, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  posix_spawnp(&child, arguments[0], &quiet, &own, const_cast<char* const*>(arguments.data()),
               environ);
  posix_spawnattr_destroy(&own);
  posix_spawn_file_actions_destroy(&quiet);
}

}  // namespace

OpenPage::OpenPage(const std::string& address) {
  const bool display =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (address.empty() || !display)
    return;
  file_ = private_file(fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>ventricle draw</title>"
      "<meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">the page</a>\n",
      address));
  if (file_.empty())
    return;
  std::signal(SIGCHLD, SIG_IGN);  // nobody waits for it
  start({"xdg-open", file_.c_str(), nullptr});
}

OpenPage::~OpenPage() {
  std::error_code ignored;
  if (!file_.empty())
    fs::remove(file_, ignored);
}

}  // namespace lv::draw

#pragma once

#include <filesystem>
#include <string>

namespace lv::draw {

/// Opens an address in the user's browser, by xdg-open, where there is a display; does nothing with
/// an empty address. The address holds a secret, and the arguments of a process are for all users
/// to see: what is opened is a file that only this user can read, which sends the browser on. It is
/// removed with this object.
class OpenPage {
 public:
  explicit OpenPage(const std::string& address);
  ~OpenPage();
  OpenPage(const OpenPage&) = delete;
  OpenPage& operator=(const OpenPage&) = delete;

 private:
  std::filesystem::path file_;
};

}  // namespace lv::draw

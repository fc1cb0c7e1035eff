#include "lv/base/names_alone.hpp"

#include <algorithm>
#include <cctype>
#include <set>

namespace lv {
namespace {

namespace fs = std::filesystem;

/// Whether a character may belong to a name, so that the name does not end before it.
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '/' ||
         c == '.' || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

/// A full stop that ends a sentence, not one within a name.
bool ends_name(const std::string& text, std::size_t at) {
  if (at >= text.size() || !continues_name(text[at]))
    return true;
  return text[at] == '.' && (at + 1 == text.size() || text[at + 1] == ' ');
}

/// Whether a folder is named here by itself. A name without a slash may be a word like any other:
/// it is a folder's where a message begins with it.
bool stands_alone(const std::string& text, const std::string& folder, std::size_t at) {
  const std::size_t after = at + folder.size();
  if (folder.find('/') != std::string::npos)
    return ends_name(text, after) || text[after] == '/';
  const bool first = at == 0 || (at > 1 && text.compare(at - 2, 2, ": ") == 0);
  return first && after < text.size() && text[after] == ':';
}

std::string without(std::string text, const std::string& folder) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) {
    const std::size_t after = at + folder.size();
    const bool begins_name = at == 0 || !continues_name(text[at - 1]);
    if (begins_name && after < text.size() && text[after] == '/' && !ends_name(text, after + 1))
      text.erase(at, folder.size() + 1);
    else if (begins_name && stands_alone(text, folder, at))
      text.replace(at, folder.size(), "(folder)");
    else
      ++at;
  }
  return text;
}

}  // namespace

NamesAlone::NamesAlone(const std::vector<fs::path>& folders) {
  std::set<std::string> all;
  for (const fs::path& folder : folders) {
    if (folder.empty())
      continue;
    std::error_code failed;
    for (const fs::path& written :
         {folder, folder.lexically_normal(), fs::absolute(folder, failed).lexically_normal(),
          fs::weakly_canonical(folder, failed)}) {
      std::string text = written.string();
      while (text.size() > 1 && text.back() == '/')
        text.pop_back();
      if (text.size() > 1 && text != "..")
        all.insert(text);
    }
  }
  folders_.assign(all.begin(), all.end());
  std::stable_sort(folders_.begin(), folders_.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
}

std::string NamesAlone::operator()(std::string text) const {
  for (const std::string& folder : folders_)
    text = without(std::move(text), folder);
  return text;
}

}  // namespace lv

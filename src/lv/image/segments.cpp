#include "lv/image/segments.hpp"

#include <fmt/format.h>

namespace lv::image {

int SegmentLabels::operator()(const std::vector<int>& segments) {
  if (segments.size() < 2)
    return segments.empty() ? 0 : segments.front() + 1;
  const int next = static_cast<int>(names_.size() + together_.size()) + 1;
  return together_.emplace(segments, next).first->second;
}

std::map<int, std::string> SegmentLabels::names() const {
  std::map<int, std::string> all;
  for (std::size_t s = 0; s < names_.size(); ++s)
    all[static_cast<int>(s) + 1] = names_[s];
  for (const auto& [segments, label] : together_) {
    std::string& name = all[label];
    for (const int s : segments)
      name += (name.empty() ? "" : " + ") + names_[static_cast<std::size_t>(s)];
  }
  return all;
}

std::string SegmentLabels::note(const std::string& file) const {
  return together_.empty() ? ""
                           : fmt::format(
                                 "{}: its segments overlap; what belongs to several has a label of "
                                 "its own, {} to {}: list it where it belongs",
                                 file, names_.size() + 1, names_.size() + together_.size());
}

}  // namespace lv::image

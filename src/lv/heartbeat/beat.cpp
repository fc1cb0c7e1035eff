#include "lv/heartbeat/beat.hpp"

#include "lv/base/check.hpp"

#include <algorithm>

namespace lv::heartbeat {

std::string title(const std::string& moment) {
  std::string words = moment;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words.starts_with("end ") ? words.replace(3, 1, "-") : words;
}

const NamedMoment* Beat::find(const std::string& name) const {
  const auto found = std::find_if(moments.begin(), moments.end(),
                                  [&](const NamedMoment& m) { return m.name == name; });
  return found == moments.end() ? nullptr : &*found;
}

const Snapshot& Beat::at(const std::string& name) const {
  const NamedMoment* moment = find(name);
  LV_CHECK(moment != nullptr);
  return moment->wall;
}

}  // namespace lv::heartbeat

#include "lv/heartbeat/beat.hpp"

#include "lv/base/check.hpp"

#include <algorithm>

namespace lv::heartbeat {

std::string title(const std::string& moment) {
  const auto* found = std::find_if(moment_words.begin(), moment_words.end(),
                                   [&](const MomentWords& w) { return w.moment == moment; });
  return found == moment_words.end() ? moment : found->title;
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

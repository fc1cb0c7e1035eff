#pragma once

#include "lv/case_file/read_case.hpp"

#include <string>

namespace lv::test {

/// A case of heartbeats of the quasi-static engine with Land's muscle, which says its circulation
/// on line 7; `lines` follow.
inline case_file::Case heartbeat_case(const std::string& kind, const std::string& lines) {
  return case_file::parse_case(
      "engine = \"quasi_static\"\nprotocol.kind = \"cycle\"\nactive.law = \"land2017\"\n"
      "calcium.shape = \"double_exponential\"\ncalcium.t_1 = \"0.04 s\"\n"
      "calcium.t_2 = \"0.22 s\"\ncirculation.kind = \"" +
          kind + "\"\n" + lines,
      "case.toml");
}

}  // namespace lv::test

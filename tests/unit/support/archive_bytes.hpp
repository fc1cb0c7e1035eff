#pragma once

#include <boost/crc.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace lv::test {

/// Gives a damaged archive the beginning of a whole one, and the checksum of what follows.
inline void repair_checksum(std::string& bytes) {
  const std::string magic = "ventricle archive 1\n";
  const std::size_t header = magic.size() + sizeof(std::uint32_t);
  const std::string content = bytes.substr(std::min(header, bytes.size()));
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  const std::uint32_t sum = crc.checksum();
  bytes = magic + std::string(reinterpret_cast<const char*>(&sum), sizeof(sum)) + content;
}

}  // namespace lv::test

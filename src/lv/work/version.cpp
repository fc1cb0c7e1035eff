#include "lv/work/version.hpp"

#include "source_hash.hpp"  // written by every build, see cmake/source_hash.cmake

namespace lv::work {

std::string source_hash() {
  return LV_SOURCE_HASH;
}

std::string version() {
  constexpr std::size_t shown = 8;
  return LV_VERSION "+" + source_hash().substr(0, shown);
}

}  // namespace lv::work

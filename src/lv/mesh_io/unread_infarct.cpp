#include "lv/mesh_io/unread_infarct.hpp"

#include "lv/base/ending.hpp"

namespace lv::mesh_io {

bool is_infarct_name(const std::string& name) {
  const std::string small = lower_case(name);
  return small.find("infarct") != std::string::npos || small.find("scar") != std::string::npos;
}

}  // namespace lv::mesh_io

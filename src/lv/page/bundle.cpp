#include "lv/page/bundle.hpp"

#include "lv/base/embedded_file.hpp"

LV_EMBED_FILE(lv_page_bundle, LV_PAGE_BUNDLE);

namespace lv::page {

std::string_view page_bundle() {
  return embedded(lv_page_bundle, lv_page_bundle_end);
}

}  // namespace lv::page

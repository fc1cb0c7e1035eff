#include "lv/draw/bundle.hpp"

#include "lv/base/embedded_file.hpp"

LV_EMBED_FILE(lv_draw_bundle, LV_DRAW_BUNDLE);

namespace lv::draw {

std::string_view page_bundle() {
  return embedded(lv_draw_bundle, lv_draw_bundle_end);
}

}  // namespace lv::draw

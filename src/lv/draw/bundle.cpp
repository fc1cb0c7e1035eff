#include "lv/draw/bundle.hpp"

// The file is put into the program as it is; LV_DRAW_BUNDLE is its path.
__asm__(
    ".section .rodata\n"
    "lv_draw_bundle: .incbin \"" LV_DRAW_BUNDLE
    "\"\n"
    "lv_draw_bundle_end: .byte 0\n"
    ".global lv_draw_bundle, lv_draw_bundle_end\n"
    ".previous\n");

// NOLINTNEXTLINE(readability-identifier-naming): the assembler's labels
extern "C" const char lv_draw_bundle[], lv_draw_bundle_end[];

namespace lv::draw {

std::string_view page_bundle() {
  return {lv_draw_bundle, static_cast<std::size_t>(lv_draw_bundle_end - lv_draw_bundle)};
}

}  // namespace lv::draw

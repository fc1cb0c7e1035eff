#include "lv/page/bundle.hpp"

// The file is put into the program as it is; LV_PAGE_BUNDLE is its path.
__asm__(
    ".section .rodata\n"
    "lv_page_bundle: .incbin \"" LV_PAGE_BUNDLE
    "\"\n"
    "lv_page_bundle_end: .byte 0\n"
    ".global lv_page_bundle, lv_page_bundle_end\n"
    ".previous\n");

// NOLINTNEXTLINE(readability-identifier-naming): the assembler's labels
extern "C" const char lv_page_bundle[], lv_page_bundle_end[];

namespace lv::page {

std::string_view page_bundle() {
  return {lv_page_bundle, static_cast<std::size_t>(lv_page_bundle_end - lv_page_bundle)};
}

}  // namespace lv::page

#pragma once

#include <string_view>

namespace lv::draw {

/// web/dist/draw.html: the page on which borders are drawn, without a study. A study inside takes
/// the place of `<!-- study -->`.
[[nodiscard]] std::string_view page_bundle();

}  // namespace lv::draw

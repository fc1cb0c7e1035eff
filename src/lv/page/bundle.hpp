#pragma once

#include <string_view>

namespace lv::page {

/// web/dist/page.html: the page without data. At `<!-- data -->`, before its script, goes what the
/// summary needs, at `<!-- wall data -->` what the first picture of the wall needs, at
/// `<!-- more data -->` the rest.
[[nodiscard]] std::string_view page_bundle();

}  // namespace lv::page

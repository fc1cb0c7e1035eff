#pragma once

#include <string_view>

namespace lv::report {

/// web/dist/page.html: the page without data. At `<!-- data -->` goes the
/// data that the first view needs, at `<!-- more data -->` the rest.
[[nodiscard]] std::string_view page_bundle();

}  // namespace lv::report

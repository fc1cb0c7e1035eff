#pragma once

#include <string_view>

namespace lv::report {

/// web/dist/page.html: the page without data. The line `<!-- data -->` is where data goes.
[[nodiscard]] std::string_view page_bundle();

}  // namespace lv::report

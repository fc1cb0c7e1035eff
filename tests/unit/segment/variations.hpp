#pragma once

#include "segment/agreement.hpp"

#include <functional>
#include <string>
#include <vector>

/// The same heart as another scanner, coil, protocol or export would show it.
namespace lv::test {

/// A change of a study's images; what is true of them is changed along.
struct Variation {
  std::string name;
  std::function<void(KnownCine&)> apply;
};

/// Changes of how the same pixels are stored: the borders must be the same.
[[nodiscard]] std::vector<Variation> other_storage();

/// Changes of what is seen: coils, contrast, resolution, noise, field of view, phases.
[[nodiscard]] std::vector<Variation> other_images();

/// Convolves every picture with a Gaussian of this deviation [mm].
void blur(image::Cine& cine, double deviation);

}  // namespace lv::test

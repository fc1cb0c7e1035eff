#pragma once

#include "lv/image/volume.hpp"

#include <string>
#include <vector>

namespace lv::image {

/// Gives each set of segments that voxels belong to a label: one segment, counted from 0, its
/// number and one; several together the next numbers, in order of appearance, with the names of all
/// ("A + B"). 0 is no segment.
class SegmentLabels {
 public:
  explicit SegmentLabels(std::vector<std::string> names) : names_(std::move(names)) {}

  /// The label of a set of segments, in ascending order.
  int operator()(const std::vector<int>& segments);

  /// The names of all labels.
  [[nodiscard]] std::map<int, std::string> names() const;

  /// What to know of labels that stand for several segments; empty if there are none.
  [[nodiscard]] std::string note(const std::string& file) const;

 private:
  std::vector<std::string> names_;
  std::map<std::vector<int>, int> together_;
};

}  // namespace lv::image

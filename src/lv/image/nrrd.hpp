#pragma once

#include "lv/image/volume.hpp"

#include <filesystem>

namespace lv::image {

/// Reads an NRRD image (.nrrd, .nhdr with its voxels beside; https://teem.sourceforge.net/nrrd) of
/// grey values or labels, in space and perhaps over time.
///
/// - Place: space directions and origin, in the space (RAS, LAS or LPS) that the file states.
/// - A fourth axis of the kind time, or a list, holds frames; times are known if it states a
/// spacing
///   and its unit.
/// - Segmentations of 3D Slicer (.seg.nrrd): labels bear the names of their segments. Where
/// segments
///   lie in several layers or share a label, segment n (from 1, in order of the file) has the label
///   n, and every set of segments that a voxel belongs to together a label of its own behind them.
///
/// Throws InputError where the file is damaged, states no space or another one, holds vectors or
/// colours, or does not say which label a segment has; RunError if it is larger than memory.
[[nodiscard]] Volume read_nrrd(const std::filesystem::path& file);

}  // namespace lv::image

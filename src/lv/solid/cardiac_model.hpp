#pragma once

#include "lv/material/myocardium.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/solid/boundary.hpp"
#include "lv/solid/support.hpp"

namespace lv::solid {

/// A ventricle but for its mesh, which says where its fibres run: what it is made of and what holds
/// it, the same under both engines.
struct CardiacModel {
  material::Myocardium myocardium{};
  BasalSupport base{};
  Surroundings surroundings{};
  mesh::SegmentFactors contractility = mesh::even_segments();  ///< of the active tension
  /// Of the right ventricle on the septum's epicardium, as a part of the cavity's; under the
  /// implicit engine alone.
  double septal_pressure = 0.0;
};

}  // namespace lv::solid

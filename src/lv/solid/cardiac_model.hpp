#pragma once

#include "lv/material/myocardium.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/solid/boundary.hpp"
#include "lv/solid/support.hpp"

namespace lv::solid {

/// A ventricle but for its geometry, the same under both engines: where its fibres run, what it is
/// made of and what holds it.
struct CardiacModel {
  mesh::FibreRule fibres{};
  material::Myocardium myocardium{};
  BasalSupport base{};
  Surroundings surroundings{};
};

}  // namespace lv::solid

#include "lv/material/niederer_hunter_smith.hpp"

#include <boost/math/tools/toms748_solve.hpp>

namespace lv::material {

/// Steady binding at given z follows from T by (A.2)-(A.3), a quadratic; the steady z is then the
/// root of (A.4), which is positive at z = 0 and negative at z = 1.
Sarcomere<double> NiedererHunterSmith::steady_state(double Ca, double stretch) const {
  Sarcomere<double> state;
  state.stretch = stretch;
  const auto bind = [&](double z) {
    state.z = z;
    state.tension = tension(state);
    state.Ca_trpn = k_on * Ca * Ca_trpn_max / (k_on * Ca + unbinding_rate(state.tension));
  };
  const auto rate_of_z = [&](double z) {
    bind(z);
    return rates(state, Ca).z;
  };
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      rate_of_z, 0.0, 1.0, boost::math::tools::eps_tolerance<double>(50), iterations);
  bind(0.5 * (bracket.first + bracket.second));
  return state;
}

}  // namespace lv::material

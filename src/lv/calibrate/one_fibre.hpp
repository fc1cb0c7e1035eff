#pragma once

namespace lv::calibrate {

/// The cavity of a wall whose muscle is stretched to `stretch` of its length without load, in the
/// mean (T. Arts, P. H. Bovendeerd, F. W. Prinzen & R. S. Reneman, Biophys. J. 59:93, 1991: the
/// fibres of a ventricle whose wall keeps its volume share their strain nearly evenly):
///
///   lambda^3 = (1 + 3 V/V_w)/(1 + 3 V_0/V_w)
///
/// with the volume V_w of the wall and V_0 of the cavity without load [mm^3]. Zero where a wall so
/// thick closes its cavity before.
[[nodiscard]] double one_fibre_volume(double V_0, double V_w, double stretch);

}  // namespace lv::calibrate

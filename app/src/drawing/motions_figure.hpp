#pragma once
#include "wavebalance/app/analysis/motions.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// All coexisting motions of one contact, the first motion's leading one, over time and as velocity over
/// displacement; dashed where they are unstable. Without panels where there is no motion.
Figure motions_figure(const Scene& scene, const Motions& all);

}  // namespace wavebalance::app

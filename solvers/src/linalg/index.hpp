#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

using Index = Eigen::Index;

}  // namespace wavebalance::solvers

#pragma once

#include <Eigen/Core>

namespace sightline::targets {

/// Marginal probabilities of association.
struct Association {
  Eigen::MatrixXd assigned;    ///< of target i with measurement m; the rest of a row: it was missed
  Eigen::VectorXd unassigned;  ///< of measurement m with no target that is known
};

/// Loopy belief propagation for one-to-one association (Williams and Lau 2014, eqs 32 and 33).
/// `ratio(i, m)` is the weight of target i with measurement m over that of i being missed times
/// that of m coming from nowhere known; converges always.
Association associate(const Eigen::MatrixXd& ratio);

}  // namespace sightline::targets

#pragma once

#include <vector>

#include "sightline/targets/likelihood_fit.h"

namespace sightline::targets {

/// What errors of bearings have in common, in shares of their variance.
struct SharedErrorFit {
  double common_share = 0.0;     ///< of the bearings of one look [0, 1)
  double lasting_share = 0.0;    ///< of those of looks shortly after each other [0, 1)
  double lasting_duration = 10;  ///< time constant with which that falls [s]
};

/// By the correlation of errors of one robot: of different targets in one look, and of any in two
/// looks, an exponential of the time between them; looks of fast turns, in which stamps that jitter
/// prevail, are left out. Errors are those of labels that know bias, lag and distortion, their σ,
/// tails and jitter by `errors`.
SharedErrorFit fitSharedErrors(const std::vector<KnownLook>& looks,
                               const std::vector<Opportunity>& labelled, const ErrorFit& errors);

}  // namespace sightline::targets

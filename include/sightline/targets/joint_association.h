#pragma once

#include <vector>

#include "sightline/targets/belief_propagation.h"
#include "sightline/targets/candidate.h"

namespace sightline::targets {

/// Marginal probabilities of which target is which measurement of a look, known things below the
/// targets; `unknown` [1/rad]: density of measurements of nothing known, one each.
///
/// Where bearings of a look err alike, twice: what each says of the offset, by the first
/// association, is told to all others (a Gaussian message without one's own), and they are
/// associated anew. Neighbours that are nearer to each other than a bearing errs are told apart so,
/// while places are still updated by each bearing with all of its error: what one target tells of
/// the offset must not come back to it in the next look.
Association associateTogether(const std::vector<Candidate>& candidates, const Look& look,
                              const std::vector<double>& unknown);

}  // namespace sightline::targets

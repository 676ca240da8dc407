#pragma once

#include <map>
#include <optional>

#include "sightline/targets/bernoulli.h"
#include "sightline/targets/look.h"

namespace sightline::targets {

/// A bound for filters: it is told which target each bearing is of, and reports the targets that
/// have been seen, each estimated by the same Gaussians along its first bearing.
class Oracle {
 public:
  /// `origins`: of each bearing the number of its target; none for clutter.
  void update(const BearingSet& set, const SensorModel& model,
              const std::vector<std::optional<std::size_t>>& origins);
  std::vector<Eigen::Vector2d> estimate() const;

 private:
  void start(const Look& look, std::size_t measurement, std::size_t target);
  void refine(Mixture& mixture, const Look& look, std::size_t measurement) const;

  Undetected even_{{}};  // the same density everywhere
  std::map<std::size_t, Mixture> targets_;
};

}  // namespace sightline::targets

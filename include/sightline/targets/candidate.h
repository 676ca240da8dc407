#pragma once

#include <cstddef>
#include <vector>

#include "sightline/targets/look.h"

namespace sightline::targets {

/// What a bearing says of the offset that all of its look have in common.
struct Pull {
  double information = 0.0;  ///< [1/rad²]
  double moment = 0.0;       ///< that times the offset [1/rad]

  void add(double share, const Pull& other) {
    information += share * other.information;
    moment += share * other.moment;
  }
};
/// By the innovation of one place, its variance with that of the offset.
Pull pullOf(const Look::Innovation& innovation, const Look& look);

/// A target that a look may see, with its weights for every measurement of the look.
class Candidate {
 public:
  Candidate(std::size_t index, const Bernoulli& bernoulli, const Look& look);

  std::size_t index() const { return index_; }     ///< of the Bernoulli
  double detection() const { return detection_; }  ///< probability where it exists
  /// Weight of being seen as measurement m over that of not being seen, r ∫ p_d g / (1 − r p_d).
  double ratio(std::size_t measurement) const;
  /// The same where the others have told what the look's bearings have in common.
  double ratio(std::size_t measurement, const Look::Offset& offset) const;
  /// What measurement m says of that, if it is this target.
  Pull pull(std::size_t measurement) const;
  /// The target afterwards, by the marginal probabilities of being each measurement.
  void apply(const Eigen::RowVectorXd& assigned, Bernoulli& bernoulli) const;

 private:
  double weight(std::size_t measurement, std::size_t component) const {
    return weights_[measurement * predictions_.size() + component];
  }
  void addMissed(const Bernoulli& bernoulli, double probability, Mixture& mixture) const;
  void addSeen(const Bernoulli& bernoulli, std::size_t measurement, double probability,
               Mixture& mixture) const;

  const Look& look_;
  std::size_t index_;
  double existence_;
  double visible_;  // probability that the robot can see it at present
  double detection_ = 0.0;
  std::vector<BearingPrediction> predictions_;  // by component
  std::vector<double> detections_;              // by component, where it exists
  std::vector<double> heights_;                 // of them by the component's weight: w p_d
  std::vector<double> weights_;                 // of measurement and component: w p_d g
  std::vector<double> sums_;                    // by measurement, over components
};

/// Whether any of a target's Gaussians reaches into the look's range.
bool mayBeSeen(const Bernoulli& bernoulli, const Look& look);
/// Notes that the look's robot can see the target now.
void noteVisible(Bernoulli& bernoulli, const Look& look);
/// Shares of modes in what a bearing starts; the rest is a target that stands.
struct ModeShares {
  double moving = 0.0;
  double glint = 0.0;
  double faint = 0.0;
};
/// The mixture in all its modes; glints face where the look was taken from.
Mixture withModes(const Mixture& mixture, const ModeShares& shares, const Look& look);
/// Adds a target's density to the cells of a grid [1/m²].
void addDensity(const Bernoulli& bernoulli, IntensityGrid& grid);

}  // namespace sightline::targets

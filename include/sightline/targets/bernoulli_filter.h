#pragma once

#include <memory>
#include <vector>

#include "sightline/targets/bernoulli.h"
#include "sightline/targets/candidate.h"
#include "sightline/targets/undetected.h"

namespace sightline::targets {

/// Settings of BernoulliFilter.
struct BernoulliFilterConfig {
  UndetectedConfig undetected;
  int ranges = 12;                ///< Gaussians that a bearing starts, log-spaced in range
  int components = 8;             ///< Gaussians kept of a target
  double nearest = 0.3;           ///< range at which the Gaussians of a bearing begin [m]
  double static_noise = 1e-6;     ///< of a target that stands still [m²/s]
  double moving_share = 0.0;      ///< of targets that move
  double moving_noise = 5e-3;     ///< of one that moves, as a random walk [m²/s]
  double lifetime = 1e6;          ///< mean time that a target stays [s]
  double pose_duration = 20.0;    ///< after which a robot's pose has other errors [s]
  double cutoff = 5.0;            ///< a false report costs as much as an error of this length [m]
  double least_existence = 1e-3;  ///< below which a target is given up

  void visit(config::FieldVisitor& visitor);
};

/// The default filter: a Poisson multi-Bernoulli filter with marginal association (Williams 2015,
/// track-oriented marginal MeMBer/Poisson), by belief propagation. Each bearing starts a target
/// that is a mixture of Gaussians along it (range-parametrised EKF, Peach 1995); misses of one
/// robot in a row count less, as the sensor model's VisibilityConfig says; the error of a look's
/// pose is part of every innovation. What a bearing starts may be a glint or a faint thing as well,
/// if the model has them: looks from one side cannot make a target of the one, nor few detections
/// among many misses of the other.
class BernoulliFilter : public TargetFilter {
 public:
  explicit BernoulliFilter(const BernoulliFilterConfig& config = {});

  void update(const BearingSet& set, const SensorModel& model) override;
  TargetEstimate estimate() override;
  IntensityGrid intensity() const override;

  const std::vector<Bernoulli>& bernoullis() const { return bernoullis_; }
  const Undetected& undetected() const { return undetected_; }

 private:
  void follow(const std::vector<LostMate>& lost);
  void predict(Bernoulli& bernoulli) const;
  std::vector<Candidate> candidatesOf(const Look& look);
  void add(const Birth& birth, double scale, double clutter, const Look& look);
  void prune();
  bool isReported(const Bernoulli& bernoulli) const;
  void label();
  UncertainPoint placeOf(const Bernoulli& bernoulli) const;

  BernoulliFilterConfig config_;
  Undetected undetected_;
  std::vector<Bernoulli> bernoullis_;
  double place_sigma_ = 0.0;  // largest of the models so far [m]
  std::int64_t stamp_ = 0;
  std::uint32_t labels_ = 0;
};

}  // namespace sightline::targets

#pragma once

#include <random>
#include <vector>

#include "sightline/targets/look.h"
#include "sightline/targets/mass_average.h"
#include "sightline/targets/target_filter.h"
#include "sightline/targets/undetected.h"

namespace sightline::targets {

/// Settings of PhdFilter.
struct PhdFilterConfig {
  UndetectedConfig undetected;
  int particles_per_target = 500;
  int birth_particles = 400;  ///< of a bearing
  int ranges = 6;             ///< spans of range that the particles of a bearing are drawn from
  double nearest = 0.3;       ///< range at which they begin [m]
  double survival = 1.0;      ///< probability that a target stays for a second
  double noise = 1e-5;        ///< of a target's place, as a random walk [m²/s]
  double roughening = 0.02;   ///< standard deviation added to particles that are drawn anew [m]
  int seed = 1;
  MassAverageConfig extraction;

  void visit(config::FieldVisitor& visitor);
};

/// The paper's filter: the probability hypothesis density (Mahler 2003) as particles. A look of a
/// robot at q changes the weights by `(1 − p_d) + Σ_z p_d g(z) / (c(z) + ∫ p_d g(z) D)`; a bearing
/// adds particles along it, as heavy as the undetected targets that it may be of; drawing anew
/// keeps the mass. The mass jumps with every miss, so places are taken from its average over the
/// looks that had them in view.
class PhdFilter : public TargetFilter {
 public:
  explicit PhdFilter(const PhdFilterConfig& config = {});

  void update(const BearingSet& set, const SensorModel& model) override;
  TargetEstimate estimate() override;
  IntensityGrid intensity() const override;

  std::size_t size() const { return particles_.size(); }
  double mass() const;
  /// Weights that have been updated so far.
  std::size_t updates() const { return updates_; }

 private:
  struct Seen;
  void predict(std::int64_t stamp);
  std::vector<Seen> seenBy(const Look& look) const;
  std::vector<double> weigh(const Look& look, const std::vector<Birth>& births);
  void add(const Birth& birth, double mass);
  void resample();

  PhdFilterConfig config_;
  Undetected undetected_;
  MassAverage average_;
  std::vector<Particle> particles_;
  std::mt19937_64 random_;
  std::int64_t stamp_ = 0;
  std::size_t updates_ = 0;
};

}  // namespace sightline::targets

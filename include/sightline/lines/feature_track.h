#pragma once

#include <array>
#include <cstdint>

#include "sightline/geometry/feature.h"
#include "sightline/lines/feature_hypothesis.h"

namespace sightline::lines {

/// One feature over scans: where it is if it is fixed, if it slides and if it moves, and how
/// probable each of these is by what the scans showed.
class FeatureTrack {
 public:
  FeatureTrack(std::uint32_t id, const Sighting& sighting, const FeatureTrackerConfig& config);

  void predict(const ViewChange& change);
  /// Whether a sighting is more likely of this feature than of one never seen before.
  bool mayBe(const Sighting& sighting) const;
  /// Density of the sightings that are expected, at this one [1/m²].
  double density(const Sighting& sighting) const;
  void see(const Sighting& sighting);
  /// Whether another track is, as far as can be told, of the same place.
  bool isAt(const FeatureTrack& other) const;
  /// Takes in another track of the same feature; the older id stays.
  void absorb(const FeatureTrack& other);
  /// The scan looked at the place, and it was not there.
  void miss(double elapsed) { missed_ += elapsed; }

  std::uint32_t id() const { return id_; }
  /// By the most probable hypothesis, in the frame of the base at the last scan.
  Eigen::Vector2d position() const { return likeliest().position(); }
  Eigen::Matrix2d covariance() const { return likeliest().covariance(); }
  double missed() const { return missed_; }  ///< in view since it was last seen [s]
  double unseen() const { return unseen_; }  ///< since it was last seen [s]
  std::uint32_t sightings() const { return sightings_; }
  bool isFinite() const;
  /// The feature, in a frame that the base is at `T_target_base` in.
  geometry::Feature in(const geometry::Pose2& T_target_base) const;

 private:
  using Probabilities = std::array<double, 3>;  // fixed, sliding, moving

  const FeatureHypothesis& likeliest() const;
  std::size_t likeliestIndex() const;
  void take(geometry::FeatureKind kind);
  void change(double elapsed);
  void weigh(const Sighting& sighting);
  geometry::FeatureBehaviour behaviour() const;

  std::uint32_t id_;
  const FeatureTrackerConfig* config_;
  geometry::FeatureKind kind_;
  std::array<FeatureHypothesis, 3> hypotheses_;
  Probabilities probabilities_;
  double age_ = 0.0;
  double unseen_ = 0.0;
  double missed_ = 0.0;
  std::uint32_t sightings_ = 1;
};

}  // namespace sightline::lines

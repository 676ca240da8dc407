#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sightline/targets/likelihood_fit.h"
#include "sightline/targets/shared_error_fit.h"
#include "sightline/targets/target_tracker_config.h"
#include "sightline/targets/visibility_fit.h"

namespace sightline::targets {

/// Settings of the characterisation of bearing-only sensors.
struct CharacterizationConfig {
  FieldOfView field_of_view;
  double range_max = 5.0;                        ///< farther targets are left out [m]
  double beam_spacing = geometry::radians(1.0);  ///< θ_sep of dames eq. 1 [rad]
  double sigma = geometry::radians(2.25);        ///< of the first labels [rad]
  int range_bins = 12;                           ///< of the table
  int bearing_bins = 10;
  double pseudo_looks = 30.0;  ///< by which a bin is drawn to what its row and column say
  LookSpacingConfig spacing;   ///< of looks that a filter will use

  void visit(config::FieldVisitor& visitor);
};

/// Sensor of one robot.
struct RobotCharacter {
  std::size_t looks = 0;
  std::size_t opportunities = 0;
  std::size_t detected = 0;
  std::size_t at_mates = 0;  ///< bearings at which another robot stands
  ErrorFit errors;
  FieldOfView view;           ///< in which detections really came
  double nearest = 0.0;       ///< range below which one of a thousand detections came [m]
  double clutter_mean = 0.0;  ///< a look, bearings at other robots left out
  DetectionTable table;
  std::vector<LagCorrelation> correlations;
  double independent_after = 0.0;  ///< time after which looks are nearly independent [s]
  double inflation = 1.0;          ///< variance of counts over that of independent looks
  VisibilityConfig visibility;
  double error_inflation = 1.0;  ///< of bearings' errors, as inflationOf
  SharedErrorFit shared;
  double place_sigma = 0.0;  ///< of all robots together, as PlaceFit [m]

  /// The model for filters and simulations.
  SensorModelConfig model() const;
};

/// What a robot of that team is like of which there are too few looks: the mean of the others, by
/// their opportunities, with biases as different. One robot at least is needed.
RobotCharacter teamCharacter(const std::map<std::string, RobotCharacter>& robots);

/// All that was found.
struct Characterization {
  std::size_t looks = 0;
  Labels paper_labels;  ///< by the paper's procedure, all robots together
  std::vector<RangeBin> bins;
  DetectionFit paper_detection;
  std::vector<ClutterBin> clutter_bins;
  ClutterFit paper_clutter;
  std::vector<SigmaPoint> sweep;    ///< figure 6
  std::vector<int> clutter_counts;  ///< looks with so much clutter
  DetectionLikelihood detection;
  ClutterLikelihood clutter;
  std::map<std::string, RobotCharacter> robots;

  SensorModelsConfig models() const;
  /// Everything as lines of text, each parameter with its interval or with why it has none.
  std::vector<std::string> report() const;
};

/// Characterises sensors by looks at known targets; `names` are those of the robots by number.
/// Targets that `sight` hides are not missed; none: nothing hides a target. Throws config::Error
/// where there are no targets, or too few looks for anything.
Characterization characterize(const std::vector<KnownLook>& looks,
                              const std::vector<std::string>& names,
                              const std::vector<Eigen::Vector2d>& targets_map,
                              const CharacterizationConfig& config,
                              std::shared_ptr<const LineOfSight> sight = nullptr);

/// Draws the table's probability of each prediction by a robot's character.
std::vector<Prediction> predictionsOf(const std::vector<KnownLook>& looks,
                                      const std::vector<Opportunity>& opportunities,
                                      const DetectionTable& table);

}  // namespace sightline::targets

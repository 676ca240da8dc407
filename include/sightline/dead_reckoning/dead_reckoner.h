#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/error_state.h"
#include "sightline/dead_reckoning/match_state.h"
#include "sightline/dead_reckoning/matcher.h"
#include "sightline/dead_reckoning/motion_habit.h"
#include "sightline/dead_reckoning/motion_model.h"
#include "sightline/dead_reckoning/scanner_tracks.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"
#include "sightline/geometry/twist2.h"
#include "sightline/scan/elapsed_time.h"
#include "sightline/scan/scan.h"

namespace sightline::dead_reckoning {

/// Motion of the base since the scan before, as told by another sensor: wheels, a gyroscope.
struct MotionPrior {
  geometry::Pose2 T_before_now;
  /// Covariance of its coordinates (x, y, θ) [m², m rad, rad²]. Large entries leave to the scans
  /// what it does not know: a gyroscope says nothing of x and y.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// Effect of one scan on the pose.
struct DeadReckoningUpdate {
  std::int64_t stamp = 0;           ///< of the scan, ns
  geometry::UncertainPose2 pose;    ///< T_odom_base at the stamp; grows from zero at the first scan
  geometry::UncertainPose2 step;    ///< T_before_now, from the scan before, of whichever scanner
  geometry::UncertainTwist2 twist;  ///< in the base, at the stamp
  MatchState state = MatchState::kInitial;
  std::size_t beams = 0;  ///< that had a valid return
  double inliers = 0.0;   ///< share of those that found their counterpart in the reference, [0, 1]

  bool isFlagged() const { return state != MatchState::kMatched && state != MatchState::kInitial; }
};

/// Effect that a scan would have on the pose: a value, to be committed or thrown away.
struct Match {
  std::int64_t stamp = 0;           ///< of the scan, ns
  std::size_t scanner = 0;          ///< that took it
  double elapsed = 0.0;             ///< since the scan before [s]; 0 where there is none
  std::optional<double> since_own;  ///< since the same scanner's scan before [s]
  double elapsed_sigma = 0.0;       ///< standard deviation of it [s]
  bool is_first = true;             ///< no scan before it
  StepPrediction prediction;        ///< of the step from the scan before
  SurfaceScan surfaces;             ///< corrected by the motion that was found
  MatchOutcome outcome;             ///< a default one where there is no reference
  /// Shares of translation and heading that are known by more than the velocity before, [0, 1].
  Eigen::Vector2d measured = Eigen::Vector2d::Ones();
  geometry::Pose2 step;         ///< T_before_now; the prediction's where the match failed
  geometry::Pose2 T_odom_base;  ///< at the stamp, once committed
  /// Covariance of what the noise of the sensor's motion makes of the pose, or of the surfaces
  /// where the match failed.
  Eigen::Matrix3d motion_covariance = Eigen::Matrix3d::Zero();
  std::uint64_t revision = 0;  ///< state of the reckoner that it was made with
};

/// Follows a carrier by its scans alone, or with a prior (saarinen section 4.3.4).
///
/// The frame odom is the base's at the first scan. The prediction is the prior, or constant
/// velocity as uncertain as the carrier has shown; where that finds nothing, as uncertain as the
/// carrier is capable of. A sweep whose beams have time
/// offsets and no sensor_motion is corrected by the motion that is found. The noise of a
/// sensor_motion is in the covariances. Whatever comes in, estimates stay finite; not thread-safe.
///
/// Several scanners: each scan is matched in the order of the stamps with what all of them have
/// seen (Method::kSubmap), and corrects the one pose. Velocities are found from scan to scan of one
/// scanner, as between those of two hardly any time may pass.
class DeadReckoner {
 public:
  /// Throws config::Error if the configuration is out of range.
  explicit DeadReckoner(const DeadReckonerConfig& config);

  /// Takes one scan: match and commit in a row.
  std::optional<DeadReckoningUpdate> update(const scan::Scan& scan,
                                            const geometry::Pose2& T_base_sensor,
                                            const std::optional<MotionPrior>& prior = {},
                                            const std::optional<scan::ElapsedTime>& elapsed = {},
                                            std::size_t scanner = 0);

  /// Matches a scan without changing anything. Returns nothing for a scan that is not newer than
  /// the same scanner's before, or older than another's. The mounting has to be level: the scan of
  /// a sensor upside down is mirrored first, which makes its angles fall.
  /// @param elapsed  time since the same scanner's scan before, where the stamps do not tell it; a
  ///                 match that fails is tried once more with the longest that may have passed
  std::optional<Match> match(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                             const std::optional<MotionPrior>& prior = {},
                             const std::optional<scan::ElapsedTime>& elapsed = {},
                             std::size_t scanner = 0) const;
  /// Takes a match made since the last commit, reset or restart of the clock. Throws
  /// std::invalid_argument for an older one.
  DeadReckoningUpdate commit(const Match& match);

  /// Motion that is expected of the carrier, by how it has moved.
  CarrierConfig expectedMotion() const { return habit_.expected(); }
  /// Step that is expected in so many seconds, without a prior.
  geometry::Pose2 expectedStep(double elapsed) const {
    return predictStep(habit_.expected(), twist_, elapsed).step;
  }

  /// Forgets reference and motion. The next scan is at `T_odom_base`, of which it is certain.
  void reset(const geometry::Pose2& T_odom_base = {});
  /// Forgets the stamp of the last scan but keeps the pose: the clock was set back.
  void restartClock();

 private:
  Match begin(const scan::Scan& scan, const std::optional<scan::ElapsedTime>& elapsed,
              std::size_t scanner) const;
  bool isNewView(const Match& match) const;
  bool isCertain(const Match& match) const;
  void matchWithin(double elapsed, const CarrierConfig& carrier, const scan::Scan& scan,
                   const geometry::Pose2& T_base_sensor, const std::optional<MotionPrior>& prior,
                   Match& match) const;
  StepPrediction predict(const CarrierConfig& carrier, const std::optional<MotionPrior>& prior,
                         double elapsed) const;
  void locate(const scan::Scan& scan, const geometry::Pose2& T_base_sensor, Match& match) const;
  void correctSweep(const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                    const geometry::UncertainPose2& predicted, const SearchWindow& window,
                    Match& match) const;
  bool isPossible(const geometry::Pose2& T_odom_base, double elapsed) const;
  geometry::UncertainPose2 advance(const Match& match);
  void follow(const Match& match);
  void learn(const Match& match);

  DeadReckonerConfig config_;
  MotionHabit habit_;
  std::unique_ptr<Matcher> matcher_;
  std::optional<std::int64_t> stamp_;
  geometry::Pose2 T_odom_base_;
  ErrorState errors_;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();
  bool moving_ = false;  // whether the twist is known
  ScannerTracks tracks_;
  double time_ = 0.0;           // since the beginning [s]
  double bridged_ = 0.0;        // time since the last match [s]
  std::uint64_t revision_ = 0;  // another after each change
};

}  // namespace sightline::dead_reckoning

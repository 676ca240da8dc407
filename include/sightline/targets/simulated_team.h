#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "sightline/targets/bearing_set.h"
#include "sightline/targets/sensor_model.h"

namespace sightline::targets {

/// A team that drives between random places of an empty square and reports bearings by a sensor
/// model: what filters and fits are measured on.
struct TeamConfig {
  double size = 20.0;  ///< edge of the square, from (0, 0) [m]
  int targets = 15;
  double spacing = 1.5;  ///< least distance of two targets [m]
  int robots = 3;
  double speed = 0.5;              ///< [m/s]
  double period = 1.0;             ///< of the looks [s]
  double position_sigma = 0.0;     ///< error of the reported pose, in x and in y [m]
  double heading_sigma = 0.0;      ///< [rad]
  double pose_correlation = 20.0;  ///< time constant of these errors (Ornstein-Uhlenbeck) [s]
  int blind_looks = 20;  ///< looks in a row for which the model's visibility stays as it is
  SensorModelConfig model;

  void visit(config::FieldVisitor& visitor);
};

/// A set and what it came from.
struct SimulatedSet {
  BearingSet set;
  geometry::Pose2 T_map_sensor;                     ///< true
  std::vector<std::optional<std::size_t>> origins;  ///< target of each bearing; none: clutter
};

/// Draws bearings by a sensor model.
class BearingSampler {
 public:
  BearingSampler(const SensorModel& model, std::uint64_t seed);

  /// `visible` says of each target whether it can be seen at all in this look; `lasting` [rad]: the
  /// error that its robot's looks have in common for a while.
  void sample(const std::vector<Eigen::Vector2d>& targets_map, const std::vector<bool>& visible,
              double lasting, SimulatedSet& set);
  /// A clutter bearing, dames eq. 3.
  double clutterBearing();
  /// A number of clutter bearings, Poisson(μ).
  int clutterCount();

 private:
  double uniform(double from, double to);
  void add(double bearing, std::optional<std::size_t> origin, SimulatedSet& set);

  SensorModel model_;
  std::mt19937_64 random_;
};

class SimulatedTeam {
 public:
  /// `sight` may be empty: then nothing hides a target.
  SimulatedTeam(const TeamConfig& config, std::uint64_t seed,
                std::shared_ptr<const LineOfSight> sight = nullptr);

  const std::vector<Eigen::Vector2d>& targets() const { return targets_map_; }
  const SensorModel& model() const { return model_; }
  std::int64_t time() const { return time_; }  ///< of the next step [ns]
  /// One set of each robot, then the robots drive on for a period.
  std::vector<SimulatedSet> step();

  /// Makes a robot drive straight to a place and wait there, from now on.
  void send(std::size_t robot, const Eigen::Vector2d& place_map);
  bool hasArrived(std::size_t robot) const;  ///< whether a robot that was sent waits
  const geometry::Pose2& T_map_sensor(std::size_t robot) const {  ///< true, at the next step
    return members_[robot].T_map_sensor;
  }

 private:
  struct Member {
    geometry::Pose2 T_map_sensor;
    Eigen::Vector2d goal;
    bool is_sent = false;                             // to the goal, by somebody
    Eigen::Vector3d error = Eigen::Vector3d::Zero();  // of the reported pose
    double lasting = 0.0;                             // error of the sensor that lasts [rad]
    std::vector<bool> visible;                        // by target
    int looks = 0;
  };
  Eigen::Vector2d place(double margin);
  void placeTargets();
  void drive(Member& member);
  void drift(Member& member);
  void redrawVisibility(Member& member);
  SimulatedSet look(std::size_t robot);

  TeamConfig config_;
  SensorModel model_;
  std::mt19937_64 random_;
  BearingSampler sampler_;
  std::vector<Eigen::Vector2d> targets_map_;
  std::vector<Member> members_;
  std::int64_t time_ = 0;
};

}  // namespace sightline::targets

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Geometry>

namespace sightline::pipeline {

/// Poses of frames in each other over time: tf on a robot, the transforms of a bag, a pose history
/// in tests. They may grow between two questions, as another thread fills them.
class Transforms {
 public:
  /// A transform and how far it is known.
  struct Newest {
    /// [ns]; nothing for one that never changes.
    std::optional<std::int64_t> stamp;
    Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  };

  virtual ~Transforms() = default;
  /// T_target_source at a time [ns]; nothing where it is not known, or not yet.
  virtual std::optional<Eigen::Isometry3d> at(const std::string& target, const std::string& source,
                                              std::int64_t stamp) const = 0;
  /// The newest that is known; nothing where the frames are not connected.
  virtual std::optional<Newest> newest(const std::string& target,
                                       const std::string& source) const = 0;
};

}  // namespace sightline::pipeline

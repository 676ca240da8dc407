#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sightline/geometry/pose2.h"
#include "sightline/tracking/tracker_update.h"

namespace sightline::bridge {

/// The last pose of a robot in a file, for its next start.
class LastPose {
 public:
  /// @param path  of the file; empty: nothing is kept
  explicit LastPose(std::string path) : path_(std::move(path)) {}

  /// The pose that was kept; nothing where there is no file. Throws config::Error where it cannot
  /// be read as one.
  std::optional<geometry::Pose2> read() const;
  /// Keeps a pose that is certain, once a second of the stamps. False where the file cannot be
  /// written.
  bool keep(const tracking::TrackerUpdate& update);

 private:
  bool write(const geometry::Pose2& T_map_base) const;

  std::string path_;
  std::optional<std::int64_t> kept_at_;  // stamp [ns]
};

}  // namespace sightline::bridge

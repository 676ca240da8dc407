#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/pose_graph.h"
#include "sightline/mapping/scan_relations.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// The path of a recording, its loops closed. The map frame is the frame odom of the dead reckoning
/// at the first scan.
struct AdjustedPath {
  std::vector<geometry::Pose2> keys;  ///< T_map_base of the key scans
  std::vector<Relation> relations;    ///< that were used
  double wheel_scale = 1.0;           ///< true length over that which the wheels tell
  double wheel_turn = 0.0;            ///< what the wheels do not tell of the heading [rad/m]
  std::size_t loops = 0;              ///< relations between two visits of a place
  std::size_t refused = 0;            ///< such relations that contradict the others, left out
  bool is_exact = false;              ///< whether the poses are known, as of places in a grid
};

/// Closes the loops of a path (Lu and Milios 1997; matching as in dead reckoning): forward through
/// the recording first, as the drift since the last loop says how far to look, then in rounds over
/// all key scans.
class PathAdjuster {
 public:
  PathAdjuster(const std::vector<KeyScan>& keys, Progress progress);
  AdjustedPath adjust();

 private:
  // A loop that is far from where it was expected waits until others say the same.
  struct Claim {
    Relation relation;
    geometry::Pose2 correction;
  };

  void goForward();
  void predict(std::size_t key);
  void closeLoops(std::size_t key);
  void judge(const Relation& relation);
  void accept(const Relation& relation);
  void takeClaim(const Relation& relation, const geometry::Pose2& correction);
  bool agree(const Claim& a, const Claim& b) const;
  void solve();
  void relateAnew();
  void prune();
  void report(double share) const {
    if (progress_) progress_(share);
  }

  const std::vector<KeyScan>& keys_;
  Progress progress_;
  std::vector<geometry::Pose2> poses_;
  ScanRelations scans_;
  AdjustedPath result_;
  std::vector<double> cost_;
  std::vector<Claim> claims_;
  double last_loop_ = 0.0;  // way up to the last loop [m]
  std::size_t unsolved_ = 0;
};

/// The pose of each scan of a path, between key scans by dead reckoning.
std::vector<geometry::StampedPose2> posesOf(const std::vector<PathPoint>& path,
                                            const std::vector<KeyScan>& keys,
                                            const std::vector<geometry::Pose2>& key_poses);

}  // namespace sightline::mapping

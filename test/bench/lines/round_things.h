#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "score.h"
#include "sightline/geometry/arc.h"

namespace sightline::bench {

/// Legs among walls: which were found, and how well.
class RoundScore {
 public:
  void add(const View& view, const PlaneWorld& world, const geometry::Pose2& pose,
           const std::vector<geometry::Arc>& arcs) {
    std::vector<bool> used(arcs.size(), false);
    for (std::size_t i = 0; i < world.discs.size(); ++i) {
      const int match = nearest(pose.inverse() * world.discs[i].centre, arcs);
      if (match >= 0) used[static_cast<std::size_t>(match)] = true;
      if (view.beams_on_disc[i] < kFewestBeams) continue;
      ++wanted_;
      if (match < 0) continue;
      ++found_;
      addErrors(world.discs[i], pose, arcs[static_cast<std::size_t>(match)]);
    }
    excess_ += static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  }

  bool isSeen() const { return wanted_ > 0; }
  void printFigures(const std::string& scenario) const {
    const std::string name = "lines." + scenario + ".";
    print(name + "circles_found",
          100.0 * static_cast<double>(found_) / static_cast<double>(wanted_), "%");
    print(name + "circles_false", static_cast<double>(excess_), "arcs");
    print(name + "circle_radius_median_mm", median(radius_mm_), "mm");
    print(name + "circle_centre_median_mm", median(centre_mm_), "mm");
    print(name + "circle_nees", nees_ / static_cast<double>(found_), "1");
    print(name + "circle_in_gate",
          100.0 * static_cast<double>(in_gate_) / static_cast<double>(found_), "%");
  }

 private:
  static constexpr std::size_t kFewestBeams = 8;
  static constexpr double kNear = 0.1;                // m, between the centres
  static constexpr double kGate = 7.814727903251179;  // 95 % of χ² with three degrees of freedom

  static int nearest(const Eigen::Vector2d& centre, const std::vector<geometry::Arc>& arcs) {
    int best = -1;
    double least = kNear;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const double distance = (arcs[i].centre - centre).norm();
      if (distance > least) continue;
      least = distance;
      best = static_cast<int>(i);
    }
    return best;
  }

  void addErrors(const Disc& disc, const geometry::Pose2& pose, const geometry::Arc& arc) {
    const Eigen::Vector2d offset = arc.centre - pose.inverse() * disc.centre;
    const Eigen::Vector3d error(offset.x(), offset.y(), arc.radius - disc.radius);
    const double squared = error.dot(arc.covariance.inverse() * error);
    radius_mm_.push_back(1e3 * std::abs(error.z()));
    centre_mm_.push_back(1e3 * offset.norm());
    nees_ += squared;
    if (squared <= kGate) ++in_gate_;
  }

  std::size_t wanted_ = 0, found_ = 0, excess_ = 0, in_gate_ = 0;
  double nees_ = 0.0;
  std::vector<double> radius_mm_, centre_mm_;
};

}  // namespace sightline::bench

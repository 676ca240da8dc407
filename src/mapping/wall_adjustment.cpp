#include "sightline/mapping/wall_adjustment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <ceres/ceres.h>

#include "free_network.h"
#include "path_problem.h"
#include "pose_factors.h"
#include "side_sightings.h"
#include "sightline/mapping/side_aim.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double gates[3] = {0.15, 0.1, 0.06};  // distance from the side, round by round [m]
  double square_sigma = 0.006;          // of the angle between neighbours [rad]
  // Sigmas of a side about where it was found [m], and about the turn of its rectangle [rad]: a
  // curved wall makes no rectangle oblique.
  double prior_sigma = 0.1;
  double turn_sigma = 0.01;
  // The same of a polygon, whose sides have turns of their own; neighbours this near to a right
  // angle are meant to have one [rad].
  double free_turn_sigma = 0.05;
  double near_right = 0.05;
  double loss = 2.0;
  // Ratio of the variances to those that the residuals tell, as errors of neighbouring scans go
  // together: by NEES on floors 101 to 108 of the benchmark, which prints others.
  double calibration = 1.8;
} kWalls{};

/// Distance of two points of a key scan from a side.
class SideFactor {
 public:
  SideFactor(const SideSighting& sighting, double bend, const Eigen::Vector2d& anchor)
      : sighting_(sighting), sigma_(std::hypot(sighting.sigma, bend)), anchor_(anchor) {}
  template <class T>
  bool operator()(const T* pose, const T* side, T* residual) const {
    using std::cos;
    using std::sin;
    const T c = cos(pose[2]);
    const T s = sin(pose[2]);
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d& p = sighting_.ends_base[i];
      const T x = pose[0] + c * p.x() - s * p.y() - anchor_.x();
      const T y = pose[1] + s * p.x() + c * p.y() - anchor_.y();
      residual[i] = (cos(side[1]) * x + sin(side[1]) * y - side[0]) / sigma_;
    }
    return true;
  }

 private:
  SideSighting sighting_;
  double sigma_;
  Eigen::Vector2d anchor_;
};

/// Angle between neighbouring sides, expected to be what it is nearest to of the right ones.
class SquareFactor {
 public:
  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    residual[0] = wrapped(b[1] - a[1] - T(0.5 * geometry::kPi)) / kWalls.square_sigma;
    return true;
  }
};

class WallProblem {
 public:
  /// @param found  the rooms as they were found
  WallProblem(const std::vector<KeyScan>& keys, const AdjustedPath& path,
              const std::vector<RoomOutline>& rooms, const std::vector<RoomOutline>& found)
      : path_(keys, path.keys), is_exact_(path.is_exact), rooms_(rooms) {
    if (path.is_exact) {
      path_.hold();
    } else {
      path_.addSteps();
    }
    for (const Relation& relation : path.relations) path_.add(relation);
    for (std::size_t r = 0; r < rooms.size(); ++r) addRoom(rooms[r], found[r]);
  }

  void add(const SideSighting& sighting) {
    seen_[sighting.room][sighting.side] = true;
    const auto block = path_.problem().AddResidualBlock(
        new ceres::AutoDiffCostFunction<SideFactor, 2, 3, 2>(
            new SideFactor(sighting, rooms_[sighting.room].sides[sighting.side].bend,
                           rooms_[sighting.room].anchor)),
        new ceres::CauchyLoss(kWalls.loss), path_.pose(sighting.key),
        values_[sighting.room][sighting.side].data());
    sightings_.push_back(block);
  }

  void solve() { path_.solve(); }

  void store(AdjustedPath& path, std::vector<RoomOutline>& rooms) const {
    path.keys = path_.poses();
    path.wheel_scale = path_.wheelScale();
    path.wheel_turn = path_.wheelTurn();
    for (std::size_t r = 0; r < rooms.size(); ++r) {
      for (std::size_t i = 0; i < rooms[r].sides.size(); ++i) {
        SideLine& side = rooms[r].sides[i];
        side.distance = values_[r][i][0];
        side.angle = geometry::wrapAngle(values_[r][i][1]);
        side.is_seen = seen_[r][i];
      }
    }
  }

  // Ratio of the variances to those that were assumed: surfaces may be smoother, and errors of
  // neighbouring scans go together. All that is seen of a grid errs together.
  double varianceFactor() {
    if (is_exact_) return 1.0;
    double sum = 0.0;
    for (const auto& block : sightings_) {
      double cost = 0.0;
      path_.problem().EvaluateResidualBlock(block, /*apply_loss_function=*/true, &cost, nullptr,
                                            nullptr);
      sum += 2.0 * cost;
    }
    for (const double cost : path_.relationCosts()) {
      sum += kWalls.loss * kWalls.loss * std::log1p(cost / (kWalls.loss * kWalls.loss));
    }
    const std::size_t residuals = 2 * sightings_.size() + 3 * path_.relations();
    std::size_t unknowns = 3 * path_.poses().size();
    for (const RoomOutline& room : rooms_) unknowns += 2 * room.sides.size();
    return kWalls.calibration * sum /
           static_cast<double>(residuals - std::min(unknowns, residuals / 2));
  }

  // Covariance of where each side is among all sides, the relations between their errors taken into
  // account.
  void storeCovariances(std::vector<RoomOutline>& rooms) {
    std::vector<const double*> blocks;
    for (const auto& room : values_) {
      for (const auto& side : room) blocks.push_back(side.data());
    }
    const auto joint = jointCovariance(blocks);
    if (!joint) return;
    const FreeNetwork network(rooms);
    const Eigen::MatrixXd covariance = varianceFactor() * network.covariance(*joint);
    Eigen::Index at = 0;
    for (RoomOutline& room : rooms) {
      for (SideLine& side : room.sides) {
        side.covariance = covariance.block<2, 2>(at, at);
        at += 2;
      }
    }
  }

 private:
  // The lines' places; those of sides that nobody saw stay about where they are.
  void addRoom(const RoomOutline& room, const RoomOutline& found) {
    std::vector<std::array<double, 2>> values;
    for (const SideLine& side : room.sides) values.push_back({side.distance, side.angle});
    values_.push_back(std::move(values));
    seen_.emplace_back(room.sides.size(), false);
    auto& kept = values_.back();
    const double turn_sigma = isSquare(found) ? kWalls.turn_sigma : kWalls.free_turn_sigma;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Eigen::Vector2d before(kept[i][0], found.sides[i].angle);
      path_.problem().AddResidualBlock(
          new ceres::AutoDiffCostFunction<SidePrior, 2, 2>(new SidePrior(before, turn_sigma)),
          nullptr, kept[i].data());
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const std::size_t next = (i + 1) % kept.size();
      const double turn = found.sides[next].angle - found.sides[i].angle;
      if (std::abs(geometry::wrapAngle(turn - 0.5 * geometry::kPi)) > kWalls.near_right) continue;
      path_.problem().AddResidualBlock(
          new ceres::AutoDiffCostFunction<SquareFactor, 1, 2, 2>(new SquareFactor()),
          new ceres::CauchyLoss(kWalls.loss), kept[i].data(), kept[next].data());
    }
  }

  struct SidePrior {
    SidePrior(const Eigen::Vector2d& mean_, double turn_sigma_)
        : mean(mean_), turn_sigma(turn_sigma_) {}
    template <class T>
    bool operator()(const T* side, T* residual) const {
      residual[0] = (side[0] - mean[0]) / kWalls.prior_sigma;
      residual[1] = wrapped(side[1] - mean[1]) / turn_sigma;
      return true;
    }
    Eigen::Vector2d mean;
    double turn_sigma;
  };

  // Covariance of all sides' values, in their order; nothing where it cannot be told.
  std::optional<Eigen::MatrixXd> jointCovariance(const std::vector<const double*>& blocks) {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::SPARSE_QR;
    ceres::Covariance covariance(options);
    std::vector<std::pair<const double*, const double*>> pairs;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      for (std::size_t j = i; j < blocks.size(); ++j) pairs.emplace_back(blocks[i], blocks[j]);
    }
    if (!covariance.Compute(pairs, &path_.problem())) return std::nullopt;
    const auto size = static_cast<Eigen::Index>(2 * blocks.size());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> joint(size, size);
    if (!covariance.GetCovarianceMatrix(blocks, joint.data())) return std::nullopt;
    return Eigen::MatrixXd(joint);
  }

  PathProblem path_;
  bool is_exact_;
  const std::vector<RoomOutline>& rooms_;
  std::vector<std::vector<std::array<double, 2>>> values_;  // distance and angle, by room and side
  std::vector<std::vector<bool>> seen_;
  std::vector<ceres::ResidualBlockId> sightings_;
};

// Sides that have come to cross go back to where they were found, none of them known any better.
void putBack(const RoomOutline& found, RoomOutline& room) {
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const Eigen::Matrix2d prior =
        Eigen::Vector2d(kWalls.prior_sigma, kWalls.free_turn_sigma).cwiseAbs2().asDiagonal();
    room.sides[i] = found.sides[i];
    room.sides[i].covariance = prior;
  }
}

}  // namespace

void adjustWalls(const std::vector<KeyScan>& keys, AdjustedPath& path,
                 std::vector<RoomOutline>& rooms) {
  if (rooms.empty()) return;
  const std::vector<RoomOutline> found = rooms;
  for (const double gate : kWalls.gates) {
    std::vector<SideSighting> sightings;
    const SightingFinder finder(rooms, gate);
    for (std::size_t k = 0; k < keys.size(); ++k) finder.find(k, keys[k], path.keys[k], sightings);
    const std::vector<RoomOutline> before = rooms;
    WallProblem problem(keys, path, before, found);
    for (const SideSighting& sighting : sightings) problem.add(sighting);
    problem.solve();
    problem.store(path, rooms);
    if (gate != *std::rbegin(kWalls.gates)) aimSides(keys, path.keys, found, rooms);
    if (gate == *std::rbegin(kWalls.gates)) problem.storeCovariances(rooms);
  }
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    if (!isRoom(rooms[r])) putBack(found[r], rooms[r]);
  }
}

}  // namespace sightline::mapping

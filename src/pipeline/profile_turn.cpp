#include "sightline/pipeline/profile_turn.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/geometry/angle.h"

namespace sightline::pipeline {

namespace {

constexpr struct {
  std::size_t every = 3;  // beam is looked at
  double widest = 0.26;   // turn beyond the predicted one [rad]
  double step = 0.02;     // of the turns that are tried first [rad]
  int refinements = 4;    // of the best of them
  double scale = 0.04;    // of differences that still count in full [m]
  // Beams to either side that tell the slope: the next ones alone would tell their noise. No jump
  // of this much may be between two of them [m].
  std::size_t beside = 3;
  double edge = 0.15;
  double ambiguous = 0.5;        // difference of places in a sweep
  double fewest = 25.0;          // returns that have to meet others
  double undetermined = 0.0087;  // standard deviation of a turn that tells nothing [rad]
} kProfile;

// A range that is predicted, in the polar coordinates of the sensor now.
struct Prediction {
  double angle;
  double range;
  double place;
};

std::vector<Prediction> predictionsOf(const std::vector<OrderedReturn>& before,
                                      const geometry::Pose2& T_now_before) {
  std::vector<Prediction> predictions;
  predictions.reserve(before.size());
  for (const OrderedReturn& seen : before) {
    const Eigen::Vector2d place = T_now_before * seen.point;
    predictions.push_back({std::atan2(place.y(), place.x()), place.norm(), seen.place});
  }
  return predictions;
}

// The ranges of a scan at any angle.
class Profile {
 public:
  Profile(const scan::Scan& scan, double sweep_turn)
      : scan_(scan),
        sweep_turn_(sweep_turn),
        first_(scan.geometry()->angles().front()),
        increment_(scan.geometry()->angleIncrement()),
        circle_(2.0 * geometry::kPi / std::abs(increment_)) {}

  // Difference from a prediction after a further turn; nothing where no surface is met.
  std::optional<TurnResidual> residual(const Prediction& prediction, double turn) const {
    const double roughly = placeAt(prediction.angle - turn) - prediction.place;
    const double at = beamAt(prediction.angle - turn - sweep_turn_ * roughly);
    const double places = at / static_cast<double>(scan_.beams() - 1) - prediction.place;
    // It comes at one end of the sweep or at the other, nobody knows at which.
    if (std::abs(places - roughly) > kProfile.ambiguous) return std::nullopt;
    const double nearest = std::round(at);
    if (nearest >= static_cast<double>(scan_.beams())) return std::nullopt;
    const auto beam = static_cast<std::size_t>(nearest);
    const std::size_t from = beam < kProfile.beside ? 0 : beam - kProfile.beside;
    const std::size_t to = std::min(scan_.beams() - 1, beam + kProfile.beside);
    if (to <= from || !isSmooth(from, to)) return std::nullopt;
    const double across = scan_.ranges()[to] - scan_.ranges()[from];
    const double a_beam = across / static_cast<double>(to - from);
    const double seen = scan_.ranges()[beam] + a_beam * (at - nearest);
    return TurnResidual{seen - prediction.range, a_beam / increment_, prediction.place + places,
                        places};
  }

 private:
  double beamAt(double angle) const {
    const double at = (angle - first_) / increment_;
    return at - circle_ * std::floor(at / circle_);
  }
  double placeAt(double angle) const {
    return beamAt(angle) / static_cast<double>(scan_.beams() - 1);
  }
  bool isSmooth(std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i <= to; ++i) {
      if (!scan_.isValid(i)) return false;
      if (i > from && std::abs(scan_.ranges()[i] - scan_.ranges()[i - 1]) > kProfile.edge) {
        return false;
      }
    }
    return true;
  }

  const scan::Scan& scan_;
  double sweep_turn_;
  double first_;
  double increment_;
  double circle_;  // in beams
};

double weightOf(double difference) {
  const double ratio = difference / kProfile.scale;
  return 1.0 / (1.0 + ratio * ratio);
}

// Mean of the differences, each up to a limit, of every second prediction [m].
double roughCost(const Profile& profile, const std::vector<Prediction>& predictions, double turn) {
  constexpr double kMost = 0.3;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < predictions.size(); i += 2) {
    const auto residual = profile.residual(predictions[i], turn);
    if (!residual) continue;
    sum += std::min(kMost, std::abs(residual->difference));
    count += 1.0;
  }
  return 2.0 * count < kProfile.fewest ? std::numeric_limits<double>::infinity() : sum / count;
}

double roughTurn(const Profile& profile, const std::vector<Prediction>& predictions) {
  double best = 0.0;
  double least = roughCost(profile, predictions, 0.0);
  for (double turn = kProfile.step; turn < kProfile.widest; turn += kProfile.step) {
    for (const double signed_turn : {turn, -turn}) {
      const double cost = roughCost(profile, predictions, signed_turn);
      if (cost < least) {
        least = cost;
        best = signed_turn;
      }
    }
  }
  return best;
}

std::vector<TurnResidual> residualsAt(const Profile& profile,
                                      const std::vector<Prediction>& predictions, double turn) {
  std::vector<TurnResidual> residuals;
  residuals.reserve(predictions.size());
  for (const Prediction& prediction : predictions) {
    if (const auto residual = profile.residual(prediction, turn)) residuals.push_back(*residual);
  }
  return residuals;
}

// Least squares of the differences over the turn.
struct TurnFit {
  double information = 0.0;
  double pull = 0.0;
  double squares = 0.0;
  double weights = 0.0;

  explicit TurnFit(const std::vector<TurnResidual>& residuals) {
    for (const TurnResidual& residual : residuals) {
      const double weight = weightOf(residual.difference);
      information += weight * residual.slope * residual.slope;
      pull += weight * residual.slope * residual.difference;
      squares += weight * residual.difference * residual.difference;
      weights += weight;
    }
  }
  double sigma() const {
    if (information <= 0.0 || weights <= 0.0) return std::numeric_limits<double>::infinity();
    return std::sqrt(squares / (weights * information));
  }
};

}  // namespace

std::vector<OrderedReturn> orderedReturns(const scan::Scan& scan) {
  std::vector<OrderedReturn> returns;
  const scan::ScanGeometry& geometry = *scan.geometry();
  const double last = static_cast<double>(scan.beams()) - 1.0;
  for (std::size_t i = 0; i < scan.beams(); i += kProfile.every) {
    if (!scan.isValid(i)) continue;
    const Eigen::Vector2d along(geometry.cosines()[i], geometry.sines()[i]);
    returns.push_back({scan.ranges()[i] * along, static_cast<double>(i) / last});
  }
  return returns;
}

// A turn beyond the predicted one shifts the ranges against the order of the beams: where the range
// grows with the angle, more is seen than predicted.
std::optional<ProfileTurn> turnBetween(const std::vector<OrderedReturn>& before,
                                       const scan::Scan& now, const geometry::Pose2& T_before_now,
                                       double sweep_turn) {
  const Profile profile(now, sweep_turn);
  const auto predictions = predictionsOf(before, T_before_now.inverse());
  ProfileTurn turn;
  turn.beyond = roughTurn(profile, predictions);
  for (int i = 0; i < kProfile.refinements; ++i) {
    const TurnFit fit(residualsAt(profile, predictions, turn.beyond));
    if (fit.sigma() > kProfile.undetermined || fit.weights < kProfile.fewest) return std::nullopt;
    turn.beyond += fit.pull / fit.information;
  }
  if (std::abs(turn.beyond) > kProfile.widest) return std::nullopt;
  turn.residuals = residualsAt(profile, predictions, turn.beyond);
  return turn;
}

}  // namespace sightline::pipeline

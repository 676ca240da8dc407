#include "sightline/targets/candidate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/LU>

namespace sightline::targets {

namespace {

// The belief that a robot can see a target, as it is now; nothing has been seen: the model's share.
double visibilityOf(const Bernoulli& bernoulli, const Look& look) {
  const VisibilityConfig& model = look.model().config().visibility;
  const std::size_t robot = look.set().robot;
  if (robot >= bernoulli.visibility.size()) return model.share;
  const Visibility& last = bernoulli.visibility[robot];
  const double passed = 1e-9 * static_cast<double>(look.set().stamp - last.stamp);
  const double kept = std::exp(-std::max(passed, 0.0) / model.duration);
  return model.share + (last.probability - model.share) * kept;
}

void setVisibility(Bernoulli& bernoulli, const Look& look, double probability) {
  if (look.model().config().visibility.share == 1.0) return;
  const std::size_t robot = look.set().robot;
  if (robot >= bernoulli.visibility.size()) {
    bernoulli.visibility.resize(robot + 1, {look.model().config().visibility.share, 0});
  }
  bernoulli.visibility[robot] = {probability, look.set().stamp};
}

// Direction from a place to the look's sensor, in the map [rad].
double directionTo(const Look& look, const Eigen::Vector2d& place_map) {
  const Eigen::Vector2d way = look.pose().mean.translation() - place_map;
  return std::atan2(way.y(), way.x());
}

// Probability of being seen over that of a target there. That of a glint is a Gaussian lobe about
// where it faces: mean over where it may be, which turns the direction to the sensor as it does the
// bearing.
double brightness(const Look& look, const Component& component,
                  const BearingPrediction& prediction) {
  const ClutterConfig& clutter = look.model().config().clutter;
  if (component.mode == Mode::kFaint) return clutter.faint_detection;
  if (component.mode != Mode::kGlint) return 1.0;
  const double lobe = std::pow(clutter.glint_width, 2);
  const double spread = std::max(prediction.variance - std::pow(look.sigma(), 2), 0.0);
  const double off = geometry::wrapAngle(directionTo(look, component.mean) - component.facing);
  const double width = lobe + spread;
  return std::sqrt(lobe / width) * std::exp(-0.5 * off * off / width);
}

}  // namespace

Candidate::Candidate(std::size_t index, const Bernoulli& bernoulli, const Look& look)
    : look_(look),
      index_(index),
      existence_(bernoulli.existence),
      visible_(visibilityOf(bernoulli, look)) {
  const double scale = 1.0 / look.model().config().visibility.share;
  for (const Component& component : bernoulli.mixture) {
    predictions_.push_back(look.predict(component));
    const double visible_detection =
        std::min(0.999, scale * look.detection(component, predictions_.back().polar));
    detections_.push_back(visible_ * visible_detection *
                          brightness(look, component, predictions_.back()));
    heights_.push_back(component.weight * detections_.back());
    detection_ += heights_.back();
  }
  if (detection_ == 0.0) return;
  for (std::size_t m = 0; m < look.size(); ++m) {
    sums_.push_back(0.0);
    for (std::size_t j = 0; j < predictions_.size(); ++j) {
      weights_.push_back(heights_[j] * look.likelihood(m, predictions_[j]));
      sums_.back() += weights_.back();
    }
  }
}

double Candidate::ratio(std::size_t measurement) const {
  return existence_ * sums_[measurement] / (1.0 - existence_ * detection_ + 1e-12);
}

double Candidate::ratio(std::size_t measurement, const Look::Offset& offset) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < predictions_.size(); ++j) {
    sum += heights_[j] * look_.likelihood(measurement, predictions_[j], offset);
  }
  return existence_ * sum / (1.0 - existence_ * detection_ + 1e-12);
}

Pull pullOf(const Look::Innovation& innovation, const Look& look) {
  const double information =
      1.0 / std::max(innovation.variance - look.commonVariance(), look.ownVariance());
  return {information, information * innovation.error};
}

Pull Candidate::pull(std::size_t measurement) const {
  Pull sum;
  if (!(sums_[measurement] > 0.0)) return sum;
  for (std::size_t j = 0; j < predictions_.size(); ++j) {
    const double share = weight(measurement, j) / sums_[measurement];
    if (share < 1e-6) continue;
    sum.add(share, pullOf(look_.innovation(measurement, predictions_[j]), look_));
  }
  return sum;
}

void Candidate::addMissed(const Bernoulli& bernoulli, double probability, Mixture& mixture) const {
  for (std::size_t j = 0; j < predictions_.size(); ++j) {
    mixture.push_back(bernoulli.mixture[j]);
    mixture.back().weight *= probability * (1.0 - detections_[j]) / (1.0 - detection_ + 1e-12);
  }
}

void Candidate::addSeen(const Bernoulli& bernoulli, std::size_t measurement, double probability,
                        Mixture& mixture) const {
  for (std::size_t j = 0; j < predictions_.size(); ++j) {
    const double share = probability * weight(measurement, j) / sums_[measurement];
    if (share < 1e-6) continue;
    const Look::Innovation innovation = look_.innovation(measurement, predictions_[j]);
    BearingPrediction prediction = predictions_[j];
    prediction.variance = innovation.variance;
    mixture.push_back(updated(bernoulli.mixture[j], prediction, innovation.error));
    mixture.back().weight = share * look_.inSight(mixture.back());
  }
}

namespace {

double sumOf(const Mixture& mixture) {
  return std::accumulate(mixture.begin(), mixture.end(), 0.0,
                         [](double sum, const Component& c) { return sum + c.weight; });
}

}  // namespace

void Candidate::apply(const Eigen::RowVectorXd& assigned, Bernoulli& bernoulli) const {
  const double exists_unseen = (1.0 - std::min(assigned.sum(), 1.0)) * existence_ *
                               (1.0 - detection_) / (1.0 - existence_ * detection_ + 1e-12);
  Mixture mixture;
  addMissed(bernoulli, exists_unseen, mixture);
  for (std::size_t m = 0; m < sums_.size(); ++m) {
    const double probability = assigned[static_cast<Eigen::Index>(m)];
    if (probability > 1e-5) addSeen(bernoulli, m, probability, mixture);
  }
  const double seen = std::min(sumOf(mixture) - exists_unseen, 1.0);
  bernoulli.mixture = std::move(mixture);
  bernoulli.existence = std::min(exists_unseen + seen, 1.0);
  const double visible_unseen = (visible_ - detection_) / (1.0 - detection_ + 1e-12);
  setVisibility(bernoulli, look_,
                (exists_unseen * visible_unseen + seen) / (exists_unseen + seen + 1e-12));
}

bool mayBeSeen(const Bernoulli& bernoulli, const Look& look) {
  const Eigen::Vector2d sensor = look.pose().mean.translation();
  const double reach = std::min(look.model().config().detection.range_max, look.set().range_max);
  return std::any_of(bernoulli.mixture.begin(), bernoulli.mixture.end(), [&](const Component& c) {
    const double limit = reach + std::sqrt(2.0 * c.covariance.trace());
    return (c.mean - sensor).squaredNorm() < limit * limit;
  });
}

void noteVisible(Bernoulli& bernoulli, const Look& look) {
  setVisibility(bernoulli, look, 1.0);
}

Mixture withModes(const Mixture& mixture, const ModeShares& shares, const Look& look) {
  const double standing = 1.0 - shares.moving - shares.glint - shares.faint;
  const std::pair<Mode, double> modes[] = {{Mode::kStanding, standing},
                                           {Mode::kMoving, shares.moving},
                                           {Mode::kGlint, shares.glint},
                                           {Mode::kFaint, shares.faint}};
  Mixture result;
  for (const auto& [mode, share] : modes) {
    if (share <= 0.0) continue;
    for (Component component : mixture) {
      component.mode = mode;
      component.weight *= share;
      component.facing = directionTo(look, component.mean);
      result.push_back(component);
    }
  }
  return result;
}

namespace {

double densityAt(const Component& component, const Eigen::Vector2d& point) {
  const Eigen::Vector2d apart = point - component.mean;
  const double square = apart.dot(component.covariance.inverse() * apart);
  return std::exp(-0.5 * square) /
         (2.0 * geometry::kPi * std::sqrt(component.covariance.determinant()));
}

}  // namespace

void addDensity(const Bernoulli& bernoulli, IntensityGrid& grid) {
  for (Component component : bernoulli.mixture) {
    if (!isTarget(component.mode)) continue;
    // A Gaussian narrower than a cell would fall between their centres.
    component.covariance.diagonal().array() += grid.resolution * grid.resolution / 12.0;
    const double reach = 3.0 * std::sqrt(component.covariance.trace());
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
      const Eigen::Vector2d cell(static_cast<double>(i % grid.width) + 0.5,
                                 static_cast<double>(i / grid.width) + 0.5);
      const Eigen::Vector2d point = grid.origin + grid.resolution * cell;
      if ((point - component.mean).squaredNorm() > reach * reach) continue;
      grid.cells[i] += bernoulli.existence * component.weight * densityAt(component, point);
    }
  }
}

}  // namespace sightline::targets

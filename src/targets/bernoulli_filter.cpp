#include "sightline/targets/bernoulli_filter.h"

#include <algorithm>
#include <cmath>

#include "sightline/targets/candidate.h"
#include "sightline/targets/joint_association.h"
#include "sightline/targets/look.h"

namespace sightline::targets {

namespace {

constexpr double kMergeDistance = 2.0;  // Mahalanobis, squared
constexpr double kLeastWeight = 1e-4;

double seconds(std::int64_t nanoseconds) {
  return 1e-9 * static_cast<double>(nanoseconds);
}

Bernoulli lostMate(const LostMate& mate) {
  Bernoulli bernoulli;
  bernoulli.existence = 1.0;
  bernoulli.stamp = mate.stamp;
  bernoulli.mate = mate.robot;
  bernoulli.mixture.push_back({1.0, mate.last.mean, mate.last.covariance, Mode::kMate});
  return bernoulli;
}

}  // namespace

void BernoulliFilterConfig::visit(config::FieldVisitor& visitor) {
  visitor.group("undetected", undetected);
  visitor.integer("ranges", ranges,
                  {"-", {1, 32}, "Gaussians that a bearing starts, log-spaced in range"});
  visitor.integer("components", components, {"-", {1, 64}, "most Gaussians kept of a target"});
  visitor.number("nearest", nearest,
                 {"m", {0.01, 100.0}, "range at which the Gaussians of a bearing begin"});
  visitor.number("static_noise", static_noise,
                 {"m^2/s", {0.0, 1e6}, "variance that a standing target gains"});
  visitor.number("moving_share", moving_share,
                 {"1", {0.0, 1.0}, "probability that a new target moves; 0: all stand"});
  visitor.number("moving_noise", moving_noise,
                 {"m^2/s", {0.0, 1e6}, "variance that a moving target gains"});
  visitor.number("lifetime", lifetime, {"s", {1.0, 1e12}, "mean time that a target stays"});
  visitor.number("pose_duration", pose_duration,
                 {"s",
                  {1e-3, 1e6},
                  "time constant after which the pose of a robot errs in another way; looks within "
                  "it do not average the error out"});
  visitor.number("cutoff", cutoff,
                 {"m",
                  {1e-6, 1e6},
                  "a target is reported where a miss would cost more than a false report, which "
                  "costs as much as an error of this length"});
  visitor.number("least_existence", least_existence,
                 {"1", {1e-9, 0.1}, "probability below which a target is given up"});
}

BernoulliFilter::BernoulliFilter(const BernoulliFilterConfig& config)
    : config_(config), undetected_(config.undetected) {
  config::validate(config_);
  config_.undetected.check("");
}

void BernoulliFilter::predict(Bernoulli& bernoulli) const {
  const double duration = seconds(stamp_ - bernoulli.stamp);
  if (duration <= 0.0) return;
  bernoulli.stamp = stamp_;
  bernoulli.existence *= std::exp(-duration / config_.lifetime);
  for (Component& component : bernoulli.mixture) {
    const bool is_moving = component.mode == Mode::kMoving || component.mode == Mode::kMate;
    const double noise = is_moving ? config_.moving_noise : config_.static_noise;
    component.covariance.diagonal().array() += noise * duration;
  }
}

// Robots that are lost go on as things that are seen, and are forgotten when their poses come.
void BernoulliFilter::follow(const std::vector<LostMate>& lost) {
  const auto is_back = [&](const Bernoulli& one) {
    return one.mate && std::none_of(lost.begin(), lost.end(),
                                    [&](const LostMate& mate) { return mate.robot == *one.mate; });
  };
  bernoullis_.erase(std::remove_if(bernoullis_.begin(), bernoullis_.end(), is_back),
                    bernoullis_.end());
  for (const LostMate& mate : lost) {
    const bool is_followed =
        std::any_of(bernoullis_.begin(), bernoullis_.end(),
                    [&](const Bernoulli& one) { return one.mate && *one.mate == mate.robot; });
    if (!is_followed) bernoullis_.push_back(lostMate(mate));
  }
}

std::vector<Candidate> BernoulliFilter::candidatesOf(const Look& look) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < bernoullis_.size(); ++i) {
    if (!mayBeSeen(bernoullis_[i], look)) continue;
    predict(bernoullis_[i]);
    look.age(bernoullis_[i]);
    Candidate candidate(i, bernoullis_[i], look);
    if (candidate.detection() > 0.0) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

void BernoulliFilter::update(const BearingSet& set, const SensorModel& model) {
  stamp_ = std::max(stamp_, set.stamp);
  place_sigma_ = std::max(place_sigma_, model.config().bearing.place_sigma);
  const Look look(set, model, config_.pose_duration);
  follow(set.lost);
  std::vector<Candidate> candidates = candidatesOf(look);
  std::vector<Birth> births;
  std::vector<double> unknown;
  for (std::size_t m = 0; m < look.size(); ++m) {
    births.push_back(birthAlong(look, m, undetected_, config_.ranges, config_.nearest));
    unknown.push_back(std::max(births.back().mass + look.clutter(m), 1e-12));
  }
  const Association association = associateTogether(candidates, look, unknown);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Bernoulli& bernoulli = bernoullis_[candidates[i].index()];
    candidates[i].apply(association.assigned.row(static_cast<Eigen::Index>(i)), bernoulli);
    reduce(bernoulli.mixture, kMergeDistance, kLeastWeight,
           static_cast<std::size_t>(config_.components));
  }
  for (std::size_t m = 0; m < look.size(); ++m) {
    const double is_new = association.unassigned[static_cast<Eigen::Index>(m)];
    add(births[m], is_new / unknown[m], look.clutter(m), look);
  }
  undetected_.look(set.T_map_sensor.mean, model, look.fieldOfView());
  prune();
  label();
}

// `scale`: probability by mass [rad]; `clutter`: its density [1/rad], part of which is of things
// that will be seen again.
void BernoulliFilter::add(const Birth& birth, double scale, double clutter, const Look& look) {
  if (scale * birth.mass < config_.least_existence) return;
  const ClutterConfig& lasting = look.model().config().clutter;
  const double mass = birth.mass + (lasting.glint_share + lasting.faint_share) * clutter;
  ModeShares shares;
  shares.moving = config_.moving_share * birth.mass / mass;
  shares.glint = lasting.glint_share * clutter / mass;
  shares.faint = lasting.faint_share * clutter / mass;
  Bernoulli bernoulli;
  bernoulli.existence = std::min(scale * mass, 1.0);
  bernoulli.stamp = stamp_;
  bernoulli.mixture = withModes(birth.mixture, shares, look);
  noteVisible(bernoulli, look);
  look.age(bernoulli);
  bernoullis_.push_back(std::move(bernoulli));
}

void BernoulliFilter::prune() {
  const auto is_unlikely = [&](const Bernoulli& bernoulli) {
    if (bernoulli.mate) return false;  // as long as its pose does not come
    const double existence = targetExistence(bernoulli);
    if (existence >= config_.least_existence) return false;
    undetected_.add(bernoulli.mixture.front().mean, existence);
    return true;
  };
  bernoullis_.erase(std::remove_if(bernoullis_.begin(), bernoullis_.end(), is_unlikely),
                    bernoullis_.end());
}

// A report of a target that is there, at a distance d from where it is, costs d and saves the
// cut-off c; of one that is not, it costs c: it pays where r (c − d) > (1 − r) c.
bool BernoulliFilter::isReported(const Bernoulli& bernoulli) const {
  const double existence = targetExistence(bernoulli);
  if (existence <= 0.5) return false;
  const double error = std::sqrt(momentsOf(ofTarget(bernoulli.mixture)).covariance.trace());
  const double gain = std::max(config_.cutoff - error, 0.0);
  return existence * gain > (1.0 - existence) * config_.cutoff;
}

void BernoulliFilter::label() {
  for (Bernoulli& bernoulli : bernoullis_) {
    if (bernoulli.label == 0 && isReported(bernoulli)) bernoulli.label = ++labels_;
  }
}

// The heaviest Gaussian's mean; the covariance of all, and of what no bearing tells.
UncertainPoint BernoulliFilter::placeOf(const Bernoulli& bernoulli) const {
  const Mixture mixture = ofTarget(bernoulli.mixture);
  UncertainPoint place{mixture.front().mean, momentsOf(mixture).covariance};
  place.covariance.diagonal().array() += place_sigma_ * place_sigma_;
  return place;
}

TargetEstimate BernoulliFilter::estimate() {
  TargetEstimate result;
  result.stamp = stamp_;
  result.expected_undetected = undetected_.mass();
  for (const Bernoulli& bernoulli : bernoullis_) {
    const double existence = targetExistence(bernoulli);
    result.expected_number += existence;
    result.number_variance += existence * (1.0 - existence);
    if (bernoulli.label == 0 || !isReported(bernoulli)) continue;
    const UncertainPoint place = placeOf(bernoulli);
    const double moving = shareOf(ofTarget(bernoulli.mixture), Mode::kMoving);
    result.targets.push_back({bernoulli.label, place.mean, place.covariance, existence, moving});
  }
  return result;
}

IntensityGrid BernoulliFilter::intensity() const {
  IntensityGrid grid = undetected_.grid();
  for (const Bernoulli& bernoulli : bernoullis_) addDensity(bernoulli, grid);
  return grid;
}

}  // namespace sightline::targets

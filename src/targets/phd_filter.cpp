#include "sightline/targets/phd_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

namespace sightline::targets {

namespace {

double gaussianDensity(double error, double inverse_sigma) {
  const double scaled = error * inverse_sigma;
  return 0.3989422804014327 * inverse_sigma * std::exp(-0.5 * scaled * scaled);
}

}  // namespace

void PhdFilterConfig::visit(config::FieldVisitor& visitor) {
  visitor.group("undetected", undetected);
  visitor.integer("particles_per_target", particles_per_target,
                  {"-", {10, 1000000}, "kept for each expected target"});
  visitor.integer("birth_particles", birth_particles,
                  {"-", {10, 1000000}, "drawn along a bearing"});
  visitor.integer("ranges", ranges,
                  {"-", {1, 32}, "spans of range that the particles of a bearing are drawn from"});
  visitor.number("nearest", nearest, {"m", {0.01, 100.0}, "range at which these begin"});
  visitor.number("survival", survival,
                 {"1", {0.0, 1.0}, "probability that a target stays for a second, p_S"});
  visitor.number("noise", noise, {"m^2/s", {0.0, 1e6}, "variance that a target's place gains"});
  visitor.number("roughening", roughening,
                 {"m", {0.0, 1e6}, "spread of particles that are drawn anew"});
  visitor.integer("seed", seed, {"-", {0, 2147483647}, "of the particles"});
  visitor.group("extraction", extraction);
}

// A particle that the look may see.
struct PhdFilter::Seen {
  std::size_t particle;
  double bearing;
  double detection;
};

PhdFilter::PhdFilter(const PhdFilterConfig& config)
    : config_(config),
      undetected_(config.undetected),
      average_(config.extraction),
      random_(static_cast<std::uint64_t>(config.seed)) {
  config::validate(config_);
  config_.undetected.check("");
}

double PhdFilter::mass() const {
  return std::accumulate(particles_.begin(), particles_.end(), 0.0,
                         [](double sum, const Particle& p) { return sum + p.weight; });
}

void PhdFilter::predict(std::int64_t stamp) {
  const double passed = 1e-9 * static_cast<double>(stamp - stamp_);
  if (passed <= 0.0) return;
  stamp_ = stamp;
  const double kept = std::pow(config_.survival, passed);
  std::normal_distribution<double> noise(0.0, std::sqrt(config_.noise * passed) + 1e-12);
  for (Particle& particle : particles_) {
    particle.weight *= kept;
    particle.place += Eigen::Vector2d(noise(random_), noise(random_));
  }
}

std::vector<PhdFilter::Seen> PhdFilter::seenBy(const Look& look) const {
  const geometry::Pose2 T_sensor_map = look.pose().mean.inverse();
  const Eigen::Vector2d sensor = look.pose().mean.translation();
  const double reach = look.model().config().detection.range_max;
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Eigen::Vector2d& place = particles_[i].place;
    if ((place - sensor).squaredNorm() > reach * reach) continue;
    const Polar polar = polarOf(T_sensor_map * place);
    const double detection = look.detection(polar);
    if (detection == 0.0 || !look.model().isInSight(place, look.pose().mean)) continue;
    seen.push_back({i, polar.bearing, detection});
  }
  return seen;
}

// Updates the weights, and returns the mass of new targets by measurement.
std::vector<double> PhdFilter::weigh(const Look& look, const std::vector<Birth>& births) {
  const std::vector<Seen> seen = seenBy(look);
  updates_ += seen.size();
  // The error of the heading is common to the look; as a part of each bearing's it is too cautious.
  const double heading = look.pose().covariance(2, 2);
  const double inverse_sigma = 1.0 / std::sqrt(look.sigma() * look.sigma() + heading);
  std::vector<double> factors(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) factors[i] = 1.0 - seen[i].detection;
  std::vector<double> likelihood(seen.size());
  std::vector<double> born;
  for (std::size_t m = 0; m < look.size(); ++m) {
    double sum = births[m].mass + look.clutter(m) + look.knownDensity(m) + 1e-12;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double error = geometry::wrapAngle(look.bearing(m) - seen[i].bearing);
      likelihood[i] = seen[i].detection * gaussianDensity(error, inverse_sigma);
      sum += likelihood[i] * particles_[seen[i].particle].weight;
    }
    for (std::size_t i = 0; i < seen.size(); ++i) factors[i] += likelihood[i] / sum;
    born.push_back(births[m].mass / sum);
  }
  for (std::size_t i = 0; i < seen.size(); ++i) particles_[seen[i].particle].weight *= factors[i];
  return born;
}

void PhdFilter::add(const Birth& birth, double mass) {
  std::normal_distribution<double> normal;
  for (const Component& component : birth.mixture) {
    const double share = mass * component.weight;
    const int count = 1 + static_cast<int>(component.weight * config_.birth_particles);
    const Eigen::Matrix2d root = component.covariance.llt().matrixL();
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d place =
          component.mean + root * Eigen::Vector2d(normal(random_), normal(random_));
      particles_.push_back({place, share / count});
    }
  }
}

// Systematic: particle i is drawn as often as its share of the mass says, to within one.
void PhdFilter::resample() {
  const double total = mass();
  const auto wanted =
      static_cast<std::size_t>(std::ceil(config_.particles_per_target * std::max(total, 1.0)));
  if (particles_.size() < 2 * wanted || total <= 0.0) return;
  const double step = total / static_cast<double>(wanted);
  std::normal_distribution<double> spread(0.0, config_.roughening + 1e-12);
  double next = step * std::uniform_real_distribution<double>(0.0, 1.0)(random_);
  double reached = 0.0;
  std::vector<Particle> drawn;
  for (const Particle& particle : particles_) {
    reached += particle.weight;
    for (; next < reached && drawn.size() < wanted; next += step) {
      const Eigen::Vector2d off(spread(random_), spread(random_));
      drawn.push_back({particle.place + off, step});
    }
  }
  particles_ = std::move(drawn);
}

void PhdFilter::update(const BearingSet& set, const SensorModel& model) {
  predict(set.stamp);
  const Look look(set, model);
  std::vector<Birth> births;
  for (std::size_t m = 0; m < look.size(); ++m) {
    births.push_back(birthAlong(look, m, undetected_, config_.ranges, config_.nearest));
  }
  const std::vector<double> born = weigh(look, births);
  for (std::size_t m = 0; m < look.size(); ++m) add(births[m], born[m]);
  undetected_.look(set.T_map_sensor.mean, model, look.fieldOfView());
  average_.add(look, particles_);
  resample();
}

TargetEstimate PhdFilter::estimate() {
  TargetEstimate result;
  result.stamp = stamp_;
  result.targets = average_.targets();
  result.expected_number = mass();
  // The PHD takes the number of targets for Poisson.
  result.number_variance = result.expected_number;
  result.expected_undetected = undetected_.mass();
  return result;
}

IntensityGrid PhdFilter::intensity() const {
  IntensityGrid grid = undetected_.grid();
  const double area = grid.resolution * grid.resolution;
  for (const Particle& particle : particles_) {
    const Eigen::Vector2d cell = (particle.place - grid.origin) / grid.resolution;
    if (!(cell.x() >= 0.0 && cell.y() >= 0.0)) continue;
    const auto column = static_cast<std::size_t>(cell.x());
    const auto row = static_cast<std::size_t>(cell.y());
    if (column < grid.width && row < grid.height) {
      grid.cells[row * grid.width + column] += particle.weight / area;
    }
  }
  return grid;
}

}  // namespace sightline::targets

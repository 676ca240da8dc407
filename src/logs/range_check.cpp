#include "sightline/logs/range_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace sightline::logs {

namespace {

constexpr std::size_t kSample = 20000;  // ranges looked at for their resolution
constexpr std::array<double, 4> kSteps{0.05, 0.02, 0.01, 0.001};  // usual ones [m]
constexpr double kOffStep = 0.02;        // of a step, float's rounding allowed
constexpr double kMissShare = 0.01;      // more readings at one range than a wall brings
constexpr double kMissPeak = 10.0;       // as many as in the whole decimetre before it
constexpr std::size_t kFewScans = 20;    // no beam is called constant on less
constexpr double kConstantSigma = 0.03;  // [m]
constexpr double kChangingSigma = 0.10;  // [m], of the median beam
constexpr double kLargestRobot = 1.0;    // [m], from its scanner
constexpr std::size_t kSectorGap = 5;    // beams
constexpr double kConstantShare = 0.8;   // of the scans in which the beam has a range

double shareOf(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Sectors that are but a few beams apart are one.
void addBeam(std::size_t beam, double range, std::vector<BeamSector>& sectors) {
  if (sectors.empty() || beam - sectors.back().last > kSectorGap) {
    sectors.push_back({beam, beam, range});
  }
  sectors.back().last = beam;
  sectors.back().farthest = std::max(sectors.back().farthest, range);
}

}  // namespace

void RangeCheck::Beam::add(double range) {
  ++count;
  const double off = range - mean;
  mean += off / static_cast<double>(count);
  squares += off * (range - mean);
}

double RangeCheck::Beam::sigma() const {
  return count < 2 ? 0.0 : std::sqrt(squares / static_cast<double>(count - 1));
}

void RangeCheck::add(const std::vector<float>& ranges, double range_min, double range_max) {
  ++scans_;
  if (beams_.empty()) beams_.resize(ranges.size());
  for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
    addReading(ranges[beam], range_min, range_max, beam);
  }
}

void RangeCheck::addReading(float range, double range_min, double range_max, std::size_t beam) {
  ++readings_;
  not_a_number_ += std::isnan(range);
  zero_ += range <= 0.0F && std::isfinite(range);
  too_near_ += (range > 0.0F && range < range_min) || (std::isinf(range) && range < 0.0F);
  nothing_ += range > range_max;
  if (!std::isfinite(range) || range <= 0.0F) return;
  ++histogram_[std::llround(1e3 * static_cast<double>(range))];
  if (range < range_min || range > range_max) return;
  ++valid_;
  if (beam < beams_.size()) beams_[beam].add(range);
  if (sample_.size() < kSample) sample_.push_back(range);
}

double RangeCheck::resolution() const {
  for (const double step : kSteps) {
    const auto is_multiple = [&](double range) {
      return std::abs(range / step - std::round(range / step)) < kOffStep;
    };
    const auto multiples = std::count_if(sample_.begin(), sample_.end(), is_multiple);
    if (shareOf(static_cast<std::size_t>(multiples), sample_.size()) > 0.99) return step;
  }
  return 0.0;
}

void RangeCheck::findMisses(RangeSummary& summary) const {
  if (histogram_.empty()) return;
  const auto largest = std::prev(histogram_.end());
  std::size_t before = 0;
  for (auto bin = histogram_.lower_bound(largest->first - 100); bin != largest; ++bin) {
    before += bin->second;
  }
  summary.largest = 1e-3 * static_cast<double>(largest->first);
  summary.at_largest = shareOf(largest->second, readings_);
  summary.misses_as_ranges =
      summary.at_largest > kMissShare &&
      static_cast<double>(largest->second) > kMissPeak * static_cast<double>(before);
}

void RangeCheck::findConstantBeams(RangeSummary& summary) const {
  std::vector<double> sigmas;
  for (const Beam& beam : beams_) {
    if (beam.count >= 2) sigmas.push_back(beam.sigma());
  }
  if (sigmas.empty()) return;
  std::nth_element(sigmas.begin(), sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2),
                   sigmas.end());
  summary.moving = sigmas[sigmas.size() / 2];
  if (scans_ < kFewScans || summary.moving < kChangingSigma) return;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    if (isConstant(beams_[i])) addBeam(i, beams_[i].mean, summary.constant);
  }
}

bool RangeCheck::isConstant(const Beam& beam) const {
  return shareOf(beam.count, scans_) > kConstantShare && beam.sigma() < kConstantSigma &&
         beam.mean < kLargestRobot;
}

RangeSummary RangeCheck::summary() const {
  RangeSummary summary;
  summary.scans = scans_;
  summary.beams = beams_.size();
  summary.valid = shareOf(valid_, readings_);
  summary.nothing = shareOf(nothing_, readings_);
  summary.too_near = shareOf(too_near_, readings_);
  summary.zero = shareOf(zero_, readings_);
  summary.not_a_number = shareOf(not_a_number_, readings_);
  summary.resolution = sample_.empty() ? 0.0 : resolution();
  findMisses(summary);
  findConstantBeams(summary);
  return summary;
}

}  // namespace sightline::logs

#include "sightline/logs/range_check.h"

#include <algorithm>
#include <cmath>

namespace sightline::logs {

namespace {

constexpr std::size_t kFewScans = 20;    // no beam is called constant on less
constexpr double kConstantSigma = 0.03;  // [m]
constexpr double kChangingSigma = 0.10;  // [m], of the median beam
constexpr double kLargestRobot = 1.0;    // [m], from its scanner
constexpr std::size_t kSectorGap = 5;    // beams
constexpr double kConstantShare = 0.8;   // of the scans in which the beam has a range

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

void RangeCheck::add(const scan::Scan& scan) {
  ++scans_;
  readings_ += scan.beams();
  step_.look(scan);
  beams_.resize(std::max(beams_.size(), scan.beams()));
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const double range = scan.ranges()[i];
    ++kinds_[static_cast<std::size_t>(scan.kinds()[i])];
    if (scan.isValid(i)) beams_[i].add(range);
    if (std::isfinite(range) && range > 0.0) ++histogram_[std::llround(1e3 * range)];
  }
}

double RangeCheck::shareOf(scan::ReturnKind kind) const {
  const auto count = static_cast<double>(kinds_[static_cast<std::size_t>(kind)]);
  return readings_ == 0 ? 0.0 : count / static_cast<double>(readings_);
}

void RangeCheck::findConstantBeams(RangeSummary& summary) const {
  std::vector<double> sigmas;
  for (const Beam& beam : beams_) {
    if (beam.count >= 2) sigmas.push_back(beam.sigma());
  }
  if (sigmas.empty()) return;
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end());
  summary.moving = *middle;
  if (scans_ < kFewScans || summary.moving < kChangingSigma) return;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    if (isConstant(beams_[i])) addBeam(i, beams_[i].mean, summary.constant);
  }
}

bool RangeCheck::isConstant(const Beam& beam) const {
  return static_cast<double>(beam.count) > kConstantShare * static_cast<double>(scans_) &&
         beam.sigma() < kConstantSigma && beam.mean < kLargestRobot;
}

RangeSummary RangeCheck::summary() const {
  RangeSummary summary;
  summary.scans = scans_;
  summary.beams = beams_.size();
  summary.valid = shareOf(scan::ReturnKind::kValid);
  summary.nothing = shareOf(scan::ReturnKind::kNothing);
  summary.too_near = shareOf(scan::ReturnKind::kTooNear);
  summary.invalid = shareOf(scan::ReturnKind::kInvalid);
  summary.step = step_.step();
  findConstantBeams(summary);
  return summary;
}

}  // namespace sightline::logs

#include "sightline/targets/bearing_detector.h"

#include <algorithm>
#include <cmath>

#include "sightline/config/error.h"

namespace sightline::targets {

namespace {

// Returns that may be of one target.
class ReturnCluster {
 public:
  explicit ReturnCluster(const Eigen::Vector2d& point) { add(point); }

  bool fits(const Eigen::Vector2d& point, double diameter) const {
    return std::all_of(points_.rbegin(), points_.rend(), [&](const Eigen::Vector2d& other) {
      return (other - point).norm() <= diameter;
    });
  }
  void add(const Eigen::Vector2d& point) {
    points_.push_back(point);
    directions_ += point.normalized();
  }
  double bearing() const { return std::atan2(directions_.y(), directions_.x()); }

 private:
  std::vector<Eigen::Vector2d> points_;
  Eigen::Vector2d directions_ = Eigen::Vector2d::Zero();
};

// Beams in their order, from the one after the widest gap on, so that no target is cut in two where
// a full turn begins.
void beginAfterWidestGap(std::vector<std::size_t>& beams, std::size_t count) {
  std::size_t widest = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const std::size_t before = i > 0 ? beams[i - 1] : beams.back();
    const std::size_t gap = (beams[i] + count - before) % count;
    if (gap <= widest) continue;
    widest = gap;
    first = i;
  }
  std::rotate(beams.begin(), beams.begin() + static_cast<std::ptrdiff_t>(first), beams.end());
}

void addToClusters(const Eigen::Vector2d& point, double diameter,
                   std::vector<ReturnCluster>& clusters) {
  // The newest first: returns of one target mostly follow each other.
  const auto own =
      std::find_if(clusters.rbegin(), clusters.rend(),
                   [&](const ReturnCluster& cluster) { return cluster.fits(point, diameter); });
  if (own == clusters.rend()) {
    clusters.emplace_back(point);
  } else {
    own->add(point);
  }
}

}  // namespace

void BearingDetectorConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("threshold", threshold,
                 {"sensor's own",
                  {0.0, 1e9},
                  "least intensity of a return that may be of a target (dames section 2)"});
  visitor.number("cluster_diameter", cluster_diameter,
                 {"m", {1e-3, 100.0}, "largest distance of two returns of one target"});
  visitor.number("range_min", range_min, {"m", {0.0, 1e4}, "nearer returns are left out"});
  visitor.number("range_max", range_max,
                 {"m", {1e-3, 1e4}, "farther returns are left out, r_max (dames eq. 1)"});
  visitor.group("field_of_view", field_of_view);
  visitor.number(
      "sigma", sigma,
      {"rad", {0.0, 1.0}, "standard deviation of a bearing; 0: that of a place between two beams"});
}

void BearingDetectorConfig::check(const std::string& source) const {
  config::validate(*this, source);
  if (range_min >= range_max) throw config::Error(source, 0, "range_min", "not below range_max");
  if (field_of_view.width() > 0.0) return;
  throw config::Error(source, 0, "field_of_view", "max has to be above min");
}

BearingDetector::BearingDetector(const BearingDetectorConfig& config) : config_(config) {
  config_.check();
}

FieldOfView BearingDetector::viewOf(const scan::ScanGeometry& geometry) const {
  if (geometry.isFullCircle()) return config_.field_of_view;
  const auto [low, high] = std::minmax(geometry.angles().front(), geometry.angles().back());
  const double middle = 0.5 * (low + high);
  const double shift = geometry::wrapAngle(middle) - middle;
  const FieldOfView seen{std::max(low + shift, -geometry::kPi),
                         std::min(high + shift, geometry::kPi)};
  return seen.within(config_.field_of_view);
}

std::vector<std::size_t> BearingDetector::brightBeams(const scan::Scan& scan) const {
  const auto& ranges = scan.ranges();
  std::vector<std::size_t> beams;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    // Comparisons with NaN do not hold.
    if (scan.isValid(i) && scan.intensities()[i] >= config_.threshold &&
        ranges[i] >= config_.range_min && ranges[i] <= config_.range_max) {
      beams.push_back(i);
    }
  }
  if (scan.geometry()->isFullCircle()) beginAfterWidestGap(beams, scan.beams());
  return beams;
}

BearingSet BearingDetector::detect(const scan::Scan& scan) const {
  if (!scan.geometry()) throw scan::InvalidScan("a scan without beams");
  if (scan.intensities().empty()) {
    throw scan::InvalidScan("no intensities: the scanner has to be told to send them");
  }
  BearingSet set;
  set.stamp = scan.stamp;
  set.field_of_view = viewOf(*scan.geometry());
  if (!(set.field_of_view.width() > 0.0)) {
    throw scan::InvalidScan("a scan that sees nothing of the field of view");
  }
  set.range_max = config_.range_max;
  const double spacing = std::abs(scan.geometry()->angleIncrement());
  set.sigma = config_.sigma > 0.0 ? config_.sigma : spacing / std::sqrt(12.0);
  std::vector<ReturnCluster> clusters;
  for (const std::size_t beam : brightBeams(scan)) {
    addToClusters(scan.point(beam), config_.cluster_diameter, clusters);
  }
  for (const ReturnCluster& cluster : clusters) {
    if (set.field_of_view.contains(cluster.bearing())) set.bearings.push_back(cluster.bearing());
  }
  return set;
}

}  // namespace sightline::targets

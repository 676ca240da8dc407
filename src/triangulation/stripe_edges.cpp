#include "sightline/triangulation/stripe_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "sightline/triangulation/flat_target.h"

namespace sightline::triangulation {

namespace {

// Beams first to last - 1 of a target, the edge somewhere between two of them.
struct EdgeWindow {
  std::size_t before;  // the beam before the edge, as an index
  std::size_t first;
  std::size_t last;
};

// Places along the scan are counted in beams from here on.
class EdgeFit {
 public:
  EdgeFit(const std::vector<BeamAverage>& beams, const EdgeWindow& window, double noise_current,
          double beams_per_metre, double beam_width)
      : beams_(beams),
        window_(window),
        noise_current_(noise_current),
        beams_per_metre_(beams_per_metre),
        beam_width_(beam_width) {}

  struct Place {
    double mean;
    double sigma;
  };
  // Mean and spread of the edge's place, equally likely everywhere around the window's middle
  // before its currents are known.
  Place locate() const;

 private:
  double place(std::size_t i) const { return static_cast<double>(beams_[i].beam); }
  double chiSquare(double edge) const;
  Place averageOver(double begin, double end) const;

  static constexpr int kSteps = 60;
  const std::vector<BeamAverage>& beams_;
  EdgeWindow window_;
  double noise_current_;
  double beams_per_metre_;
  double beam_width_;
};

// Chi-square of the window's currents with an edge there; the levels on either side and a common
// slope (light falls off towards the sides of the field) are what fits best.
double EdgeFit::chiSquare(double edge) const {
  const double left = beams_[window_.first].current;
  const double right = beams_[window_.last - 1].current;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d projection = Eigen::Vector3d::Zero();
  double power = 0.0;
  for (std::size_t i = window_.first; i < window_.last; ++i) {
    const double away = place(i) - edge;
    const double share = powerBeyond(away / beams_per_metre_, beam_width_);
    const double sigma = noise_current_ / std::sqrt(beams_[i].readings);
    const Eigen::Vector3d row(
        left * (1.0 - share), right * share,
        (left + (right - left) * share) * away / static_cast<double>(window_.last - window_.first));
    const double current = beams_[i].current / sigma;
    normal += row * row.transpose() / (sigma * sigma);
    projection += row * (current / sigma);
    power += current * current;
  }
  return power - projection.dot(normal.ldlt().solve(projection));
}

EdgeFit::Place EdgeFit::averageOver(double begin, double end) const {
  Eigen::Array<double, kSteps + 1, 1> chi_squares;
  const Eigen::Array<double, kSteps + 1, 1> places =
      Eigen::Array<double, kSteps + 1, 1>::LinSpaced(begin, end);
  for (int i = 0; i <= kSteps; ++i) chi_squares[i] = chiSquare(places[i]);
  Eigen::Array<double, kSteps + 1, 1> weights =
      (-0.5 * (chi_squares - chi_squares.minCoeff())).exp();
  weights /= weights.sum();
  const double mean = (weights * places).sum();
  return {mean, std::sqrt((weights * (places - mean).square()).sum())};
}

EdgeFit::Place EdgeFit::locate() const {
  double begin = place(window_.before) - 1.0;
  double end = place(window_.before) + 2.0;
  for (;;) {
    const Place found = averageOver(begin, end);
    const double step = (end - begin) / kSteps;
    // Fine enough to add up, or finer than any scan.
    if (found.sigma > 2.0 * step || !(step >= 1e-6))
      return {found.mean, std::max(found.sigma, step)};
    begin = found.mean - 5.0 * step;
    end = found.mean + 5.0 * step;
  }
}

// Indices of the beams after which the current crosses from dark to bright or back.
std::vector<std::size_t> crossingsOf(const std::vector<BeamAverage>& beams) {
  const auto dimmer = [](const BeamAverage& a, const BeamAverage& b) {
    return a.current < b.current;
  };
  const auto [dimmest, brightest] = std::minmax_element(beams.begin(), beams.end(), dimmer);
  const double threshold = std::sqrt(dimmest->current * brightest->current);
  std::vector<std::size_t> crossings;
  for (std::size_t i = 0; i + 1 < beams.size(); ++i) {
    if ((beams[i].current < threshold) != (beams[i + 1].current < threshold)) {
      crossings.push_back(i);
    }
  }
  return crossings;
}

// Beams around a crossing that no other edge blurs; nothing if too few are left on a side.
std::optional<EdgeWindow> windowAround(const std::vector<BeamAverage>& beams,
                                       const std::vector<std::size_t>& crossings, std::size_t which,
                                       std::size_t blur) {
  const std::size_t plateau = 4;
  const std::size_t before = crossings[which];
  const std::size_t lowest = which == 0 ? 0 : crossings[which - 1] + 1 + blur;
  const std::size_t highest =
      which + 1 == crossings.size() ? beams.size() : crossings[which + 1] + 1 - blur;
  if (before + 1 < lowest + blur + 2 || before + blur + 3 > highest) return std::nullopt;
  const std::size_t reach = blur + plateau;
  const EdgeWindow window{before, before + 1 > lowest + reach ? before + 1 - reach : lowest,
                          std::min(highest, before + 1 + reach)};
  // A beam that did not see the target leaves a gap.
  const bool has_gap =
      beams[window.last - 1].beam - beams[window.first].beam + 1 != window.last - window.first;
  return has_gap ? std::nullopt : std::optional(window);
}

// y of the edge nearest to where it seems to be, among those with bright on that side.
double nearestEdge(const Stripes& stripes, double y, bool is_bright_left) {
  const int odd = is_bright_left ? 0 : 1;
  const double pairs = ((y - stripes.edge) / stripes.width - odd) / 2.0;
  return stripes.edgeAt(2 * static_cast<int>(std::lround(pairs)) + odd);
}

// The edge at one of the crossings; nothing where too few beams show it.
std::optional<StripeEdge> edgeAt(const TargetPlacement& target,
                                 const std::vector<std::size_t>& crossings, std::size_t which,
                                 const SensorParameters& sensor, double beam_width) {
  const auto& beams = target.beams;
  const double turn = sensor.origin.projected_vergence;
  const double spacing = sensor.scan.scanAngle(1) - sensor.scan.scanAngle(0);
  const double depth = target.depth - sensor.origin.x;
  const auto nearby = static_cast<double>(beams[crossings[which]].beam);
  const double beams_per_metre = std::cos(sensor.scan.scanAngle(nearby) + turn) / (depth * spacing);
  const auto blur = static_cast<std::size_t>(std::ceil(0.5 * beam_width * beams_per_metre)) + 1;
  const auto window = windowAround(beams, crossings, which, blur);
  if (!window) return std::nullopt;
  const auto place =
      EdgeFit(beams, *window, sensor.noise_current, beams_per_metre, beam_width).locate();
  const double scan_angle = sensor.scan.scanAngle(place.mean);
  const double y = sensor.origin.y + depth * std::tan(scan_angle + turn);
  const bool is_bright_left = beams[window->last - 1].current > beams[window->first].current;
  return StripeEdge{target.depth, nearestEdge(*target.stripes, y, is_bright_left), scan_angle,
                    place.sigma * spacing};
}

}  // namespace

std::vector<StripeEdge> findStripeEdges(const TargetPlacement& target,
                                        const SensorParameters& sensor, double beam_width) {
  if (!target.stripes || target.beams.empty() || target.depth <= sensor.origin.x) return {};
  const auto crossings = crossingsOf(target.beams);
  std::vector<StripeEdge> edges;
  for (std::size_t which = 0; which < crossings.size(); ++which) {
    const auto edge = edgeAt(target, crossings, which, sensor, beam_width);
    if (edge) edges.push_back(*edge);
  }
  return edges;
}

}  // namespace sightline::triangulation

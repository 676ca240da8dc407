#include "sightline/lines/end_points.h"

#include <algorithm>
#include <cmath>

#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/neighbour_beam.h"

namespace sightline::lines {

namespace {

using geometry::EndKind;

// Chosen: when the crossing of two lines is where both walls end.
struct CornerConstants {
  // Lines closer to parallel than this make no corner [sine].
  double min_sine = 0.1;
  double tolerance = 3.0;  // standard deviations
  // A crossing this much less certain (variance) than where the beams say the wall ends proves
  // nothing: that goes for lines one of which is hardly known.
  double vaguer = 9.0;
  // Mean square of the returns that are lost with a stray one near the end, about.
  double lost_squared = 4.0;
  // Beams between two walls that meet: few, as all that are not lost hit one or the other; and
  // returns, which are from something in front of the corner if there are more.
  std::size_t most_between = 5;
  std::size_t most_astray = 2;
};
constexpr CornerConstants kCorner{};

// Variance of the distance of the line from a point at a position on it.
double varianceAt(const LineEstimate& line, double position) {
  const Information& info = line.information;
  return (info.phi_phi + position * (2.0 * info.rho_phi + position * info.rho_rho)) /
         info.determinant();
}

double directionVariance(const LineEstimate& line) {
  return line.information.rho_rho / line.information.determinant();
}

double across(const LineEstimate& a, const LineEstimate& b) {
  return a.normal_x * b.normal_y - a.normal_y * b.normal_x;
}

}  // namespace

EndPoint EndPoints::start(const Piece& piece, const Piece* neighbour) const {
  return find(piece, neighbour, Side::kStart);
}

EndPoint EndPoints::end(const Piece& piece, const Piece* neighbour) const {
  return find(piece, neighbour, Side::kEnd);
}

EndPoint EndPoints::find(const Piece& piece, const Piece* neighbour, Side side) const {
  const std::size_t last = side == Side::kStart ? piece.first : piece.end - 1;
  const EndPoint between = edge(piece, last, side);
  if (!neighbour) return between;
  const std::size_t next = side == Side::kStart ? neighbour->end - 1 : neighbour->first;
  EndPoint crossing;
  if (!corner(piece, *neighbour, last, next, crossing)) return between;
  // Where the lines are closer than the noise, the beams do not say where one ends.
  const double sine = across(piece.line, neighbour->line);
  const double noise = 1.0 / static_cast<double>(residualsOf(beams_, last, piece.line).weight[0]);
  const double by_beams = between.variance + noise / (sine * sine);
  return crossing.variance < kCorner.vaguer * by_beams ? crossing : between;
}

bool EndPoints::corner(const Piece& piece, const Piece& neighbour, std::size_t last,
                       std::size_t next, EndPoint& point) const {
  const LineEstimate& a = piece.line;
  const LineEstimate& b = neighbour.line;
  const double sine = across(a, b);
  if (std::abs(sine) < kCorner.min_sine || !areNeighbours(last, next)) return false;
  const double x = (a.rho * b.normal_y - b.rho * a.normal_y) / sine;
  const double y = (b.rho * a.normal_x - a.rho * b.normal_x) / sine;
  const double on_a = a.alongX() * x + a.alongY() * y;
  const double on_b = b.alongX() * x + b.alongY() * y;
  // Sliding one line along the other: the crossing moves on a as b moves, and the reverse.
  const double cosine = a.normal_x * b.normal_x + a.normal_y * b.normal_y;
  const double va = varianceAt(a, on_a);
  const double vb = varianceAt(b, on_b);
  point.position = on_a;
  // The sine itself is uncertain: the mean of 1/sine² to second order.
  const double turn = (directionVariance(a) + directionVariance(b)) / (sine * sine);
  point.variance = (vb + cosine * cosine * va) / (sine * sine) * (1.0 + 3.0 * turn);
  point.kind = EndKind::kCorner;

  const BeamResiduals of_last = residualsOf(beams_, last, a);
  const BeamResiduals of_next = residualsOf(beams_, next, b);
  const auto last_on_a = static_cast<double>(of_last.position[0]);
  const auto next_on_b = static_cast<double>(of_next.position[0]);
  const double noise = 1.0 / static_cast<double>(std::min(of_last.weight[0], of_next.weight[0]));
  const double slack = kCorner.tolerance * (std::sqrt(noise + va + vb)) / std::abs(sine);
  const double reach_a = std::abs(positionOn(beams_, next, a) - last_on_a);
  const double reach_b = std::abs(positionOn(beams_, last, b) - next_on_b);
  return std::abs(on_a - last_on_a) < slack + reach_a + spacingAt(piece, last) &&
         std::abs(on_b - next_on_b) < slack + reach_b + spacingAt(neighbour, next);
}

// Numbers of beams and of returns may be a revolution off on a full circle.
bool EndPoints::areNeighbours(std::size_t i, std::size_t k) const {
  const auto apart = [](std::size_t a, std::size_t b, std::size_t count) {
    const std::size_t ahead = (b + 2 * count - a) % count;
    return std::min(ahead, count - ahead);
  };
  return apart(beams_.beam[i], beams_.beam[k], scan_.beams()) <= kCorner.most_between + 1 &&
         apart(i, k, beams_.revolution) <= kCorner.most_astray + 1;
}

double EndPoints::spacingAt(const Piece& piece, std::size_t i) const {
  const std::size_t inner = i == piece.first ? i + 1 : i - 1;
  return std::hypot(beams_.x[inner] - beams_.x[i], beams_.y[inner] - beams_.y[i]);
}

EndPoint EndPoints::edge(const Piece& piece, std::size_t last, Side side) const {
  const std::size_t beam = beams_.beam[last] % scan_.beams();
  const Meeting on = meet(piece.line, beam);
  EndPoint point{on.position, on.variance + on.jitter, EndKind::kScanLimit};
  const std::size_t telling = nextTellingBeam(scan_, beam, side == Side::kEnd ? 1 : -1);
  if (telling == beam) return point;
  const Meeting past = meet(piece.line, telling);
  if (!past.exists || past.range > scan_.geometry()->rangeMax()) return point;
  const double step = past.position - on.position;
  point.position += 0.5 * step;
  // Halfway between two beams that err by themselves.
  point.variance += step * step / 12.0 - 0.5 * on.jitter;
  // Where returns go astray, so may the last one, or the last but one and the last with it.
  const double astray = 1.0 - piece.beams / static_cast<double>(piece.size());
  point.variance += kCorner.lost_squared * std::max(0.0, astray) * step * step;
  const bool behind = scan_.kinds()[telling] == scan::ReturnKind::kNothing ||
                      (scan_.isValid(telling) && scan_.ranges()[telling] > past.range);
  point.kind = behind ? EndKind::kOccludingEdge : EndKind::kOccluded;
  return point;
}

EndPoints::Meeting EndPoints::meet(const LineEstimate& line, std::size_t beam) const {
  const Eigen::Vector2d direction = scan_.direction(beam);
  const Eigen::Vector2d origin = scan_.sensorMotion().empty()
                                     ? Eigen::Vector2d::Zero()
                                     : scan_.sensorMotion()[beam].translation();
  const Eigen::Vector2d normal(line.normal_x, line.normal_y);
  const Eigen::Vector2d along(line.alongX(), line.alongY());
  const double facing = normal.dot(direction);
  if (facing < static_cast<double>(kMinIncidence)) return {0.0, 0.0, 0.0, 0.0, false};
  const double range = (line.rho - normal.dot(origin)) / facing;
  const double position = along.dot(origin + range * direction);
  const double slope = along.dot(direction) / facing;
  const double jitter = jitterAt(origin + range * direction, origin, along - slope * normal);
  return {position, range, slope * slope * varianceAt(line, position), jitter, range > 0.0};
}

// A beam that points elsewhere than it says, or is turned about the axis of the jitter, meets the
// line elsewhere: `slide` is what the position gains by a displacement of the beam.
double EndPoints::jitterAt(const Eigen::Vector2d& point, const Eigen::Vector2d& origin,
                           const Eigen::Vector2d& slide) const {
  const auto movedAbout = [&](const Eigen::Vector2d& axis) {
    const Eigen::Vector2d arm = point - axis;
    return slide.y() * arm.x() - slide.x() * arm.y();
  };
  const double by_beam = movedAbout(origin);
  const double by_sensor = movedAbout(scan_.motion_noise.jitter_axis);
  return scan_.angular_variance * by_beam * by_beam +
         scan_.motion_noise.jitter * by_sensor * by_sensor;
}

}  // namespace sightline::lines

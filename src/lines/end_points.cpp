#include "sightline/lines/end_points.h"

#include <cmath>

#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

using geometry::EndKind;

// Lines closer to parallel than this make no corner.
constexpr double kMinCornerSine = 0.1;
constexpr double kTolerance = 3.0;  // standard deviations
// A crossing this much less certain (variance) than where the beams say the wall ends proves
// nothing: that goes for lines one of which is hardly known.
constexpr double kVaguer = 9.0;

// Of the distance of the line from a point at a position on it.
double varianceAt(const LineEstimate& line, double position) {
  const Information& info = line.information;
  return (info.phi_phi + position * (2.0 * info.rho_phi + position * info.rho_rho)) /
         info.determinant();
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
  const bool meet = corner(piece, *neighbour, last, next, crossing);
  return meet && crossing.variance < kVaguer * between.variance ? crossing : between;
}

bool EndPoints::corner(const Piece& piece, const Piece& neighbour, std::size_t last,
                       std::size_t next, EndPoint& point) const {
  const LineEstimate& a = piece.line;
  const LineEstimate& b = neighbour.line;
  const double sine = across(a, b);
  if (std::abs(sine) < kMinCornerSine) return false;
  const double x = (a.rho * b.normal_y - b.rho * a.normal_y) / sine;
  const double y = (b.rho * a.normal_x - a.rho * b.normal_x) / sine;
  const double on_a = a.alongX() * x + a.alongY() * y;
  const double on_b = b.alongX() * x + b.alongY() * y;
  // Sliding one line along the other: the crossing moves on a as b moves, and the reverse.
  const double cosine = a.normal_x * b.normal_x + a.normal_y * b.normal_y;
  const double va = varianceAt(a, on_a);
  const double vb = varianceAt(b, on_b);
  point.position = on_a;
  point.variance = (vb + cosine * cosine * va) / (sine * sine);
  point.kind = EndKind::kCorner;

  const BeamResiduals of_last = residualsOf(beams_, last, a);
  const BeamResiduals of_next = residualsOf(beams_, next, b);
  const auto last_on_a = static_cast<double>(of_last.position[0]);
  const auto next_on_b = static_cast<double>(of_next.position[0]);
  const double noise = 1.0 / static_cast<double>(std::min(of_last.weight[0], of_next.weight[0]));
  const double slack = kTolerance * (std::sqrt(noise + va + vb)) / std::abs(sine);
  const double reach_a = std::abs(positionOn(beams_, next, a) - last_on_a);
  const double reach_b = std::abs(positionOn(beams_, last, b) - next_on_b);
  return std::abs(on_a - last_on_a) < slack + reach_a &&
         std::abs(on_b - next_on_b) < slack + reach_b;
}

EndPoint EndPoints::edge(const Piece& piece, std::size_t last, Side side) const {
  const std::size_t beam = beams_.beam[last] % scan_.beams();
  const Meeting on = meet(piece.line, beam);
  EndPoint point{on.position, on.variance, EndKind::kScanLimit};
  const std::size_t telling = firstTelling(beam, side);
  if (telling == beam) return point;
  const Meeting past = meet(piece.line, telling);
  if (!past.exists || past.range > scan_.geometry->rangeMax()) return point;
  const double step = past.position - on.position;
  point.position += 0.5 * step;
  point.variance += step * step / 12.0;
  const bool behind = scan_.kinds[telling] == scan::ReturnKind::kNothing ||
                      (scan_.isValid(telling) && scan_.ranges[telling] > past.range);
  point.kind = behind ? EndKind::kOccludingEdge : EndKind::kOccluded;
  return point;
}

EndPoints::Meeting EndPoints::meet(const LineEstimate& line, std::size_t beam) const {
  const Eigen::Vector2d direction = scan_.direction(beam);
  const Eigen::Vector2d origin = scan_.sensor_motion.empty()
                                     ? Eigen::Vector2d::Zero()
                                     : scan_.sensor_motion[beam].translation();
  const Eigen::Vector2d normal(line.normal_x, line.normal_y);
  const Eigen::Vector2d along(line.alongX(), line.alongY());
  const double facing = normal.dot(direction);
  if (facing < static_cast<double>(kMinIncidence)) return {0.0, 0.0, 0.0, false};
  const double range = (line.rho - normal.dot(origin)) / facing;
  const double position = along.dot(origin + range * direction);
  const double slope = along.dot(direction) / facing;
  return {position, range, slope * slope * varianceAt(line, position), range > 0.0};
}

std::size_t EndPoints::firstTelling(std::size_t beam, Side side) const {
  const std::size_t count = scan_.beams();
  const bool circle = scan_.geometry->isFullCircle();
  std::size_t i = beam;
  for (std::size_t step = 1; step < count; ++step) {
    if (side == Side::kEnd) {
      if (!circle && i + 1 == count) return beam;
      i = (i + 1) % count;
    } else {
      if (!circle && i == 0) return beam;
      i = (i + count - 1) % count;
    }
    if (scan_.kinds[i] != scan::ReturnKind::kInvalid) return i;
  }
  return beam;
}

}  // namespace sightline::lines

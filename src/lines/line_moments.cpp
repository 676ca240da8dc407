#include "sightline/lines/line_moments.h"

#include <algorithm>
#include <cmath>

#include "sightline/lines/packet.h"

namespace sightline::lines {

namespace {

// No return is taken for better known than this [m²].
constexpr float kLeastVariance = 1e-12F;

}  // namespace

LineEstimate LineMoments::line() const {
  const double ux = yy * x - xy * y;
  const double uy = xx * y - xy * x;
  const double length = std::sqrt(ux * ux + uy * uy);  // hypot costs more, for larger numbers
  LineEstimate line;
  if (!(length > 0.0)) return line;
  line.normal_x = ux / length;
  line.normal_y = uy / length;
  line.rho = (xx * yy - xy * xy) / length;
  return line;
}

// 1/r = u · d in a direction d, and the covariance of u is the inverse of the second moments.
double apartSquared(const LineMoments& a, const LineMoments& b, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to) {
  const double scale_a = 1.0 / (a.xx * a.yy - a.xy * a.xy);
  const double scale_b = 1.0 / (b.xx * b.yy - b.xy * b.xy);
  const Eigen::Vector2d apart(
      scale_a * (a.yy * a.x - a.xy * a.y) - scale_b * (b.yy * b.x - b.xy * b.y),
      scale_a * (a.xx * a.y - a.xy * a.x) - scale_b * (b.xx * b.y - b.xy * b.x));
  const double at_from = apart.dot(from);
  const double at_to = apart.dot(to);
  if (at_from * at_to <= 0.0) return 0.0;
  const Eigen::Vector2d& d = std::abs(at_from) < std::abs(at_to) ? from : to;
  const double least = std::min(std::abs(at_from), std::abs(at_to));
  const double xx = scale_a * a.yy + scale_b * b.yy;
  const double xy = -scale_a * a.xy - scale_b * b.xy;
  const double yy = scale_a * a.xx + scale_b * b.xx;
  return least * least / (d.x() * (xx * d.x() + 2.0 * xy * d.y()) + yy * d.y() * d.y());
}

SIGHTLINE_VECTOR_CLONES
LineMoments momentsOf(const BeamArray& beams, std::size_t first, std::size_t end) {
  const float* variances = beams.slantVariances();
  Quad one{}, x{}, y{}, xx{}, xy{}, yy{};
  for (std::size_t i = first; i < end; i += kLanes) {
    const Packet narrow_x = load(beams.x.data() + i);
    const Packet narrow_y = load(beams.y.data() + i);
    const Packet squared_range = narrow_x * narrow_x + narrow_y * narrow_y;
    Quad px, py, v;
    widen(narrow_x, px);
    widen(narrow_y, py);
    widen(firstLanes(end - i) * squared_range / (load(variances + i) + kLeastVariance), v);
    const Quad vx = v * px;
    const Quad vy = v * py;
    one += v;
    x += vx;
    y += vy;
    xx += vx * px;
    xy += vx * py;
    yy += vy * py;
  }
  return {sum(one), sum(x), sum(y), sum(xx), sum(xy), sum(yy)};
}

LineMoments momentsOf(const BeamArray& beams, std::size_t of_return) {
  const float narrow_x = beams.x[of_return];
  const float narrow_y = beams.y[of_return];
  const float squared_range = narrow_x * narrow_x + narrow_y * narrow_y;
  const auto v =
      static_cast<double>(squared_range / (beams.slantVariances()[of_return] + kLeastVariance));
  const auto x = static_cast<double>(narrow_x);
  const auto y = static_cast<double>(narrow_y);
  return {v, v * x, v * y, v * x * x, v * x * y, v * y * y};
}

}  // namespace sightline::lines

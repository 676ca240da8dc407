#include "sightline/lines/line_sums.h"

#include <algorithm>

namespace sightline::lines {

LineSums& LineSums::operator+=(const LineSums& other) {
  w += other.w;
  a += other.a;
  aa += other.aa;
  e += other.e;
  ae += other.ae;
  ee += other.ee;
  returns += other.returns;
  return *this;
}

LineSums LineSums::operator-(const LineSums& other) const {
  return {w - other.w,   a - other.a,   aa - other.aa,          e - other.e,
          ae - other.ae, ee - other.ee, returns - other.returns};
}

double LineSums::cost() const {
  if (!(w > 0.0)) return 0.0;
  const double spread = aa - a * a / w;
  const double common = ae - a * e / w;
  const double by_slope = spread > 1e-9 * aa ? common * common / spread : 0.0;
  return std::max(0.0, ee - e * e / w - by_slope);
}

// e ≈ ρ_step − position φ_step, with the position seen from the line's own origin.
LineEstimate LineSums::line(const LineEstimate& about, double reference) const {
  LineEstimate line = about;
  const Information information{w, -a, aa};
  if (!information.isDetermined()) return about;
  const double slope = (ae - a * e / w) / (aa - a * a / w);
  line.information = information.shifted(-reference);
  line.step((e - slope * a) / w - slope * reference, -slope);
  return line;
}

LineScores LineScores::operator-(const LineScores& other) const {
  return {w - other.w, a - other.a, aa - other.aa, e - other.e, ae - other.ae};
}

Packet LineScores::gain() const {
  constexpr float kLeast = 1e-6F;
  const Packet mean = a / larger(w, all(kLeast));
  const Packet spread = aa - a * mean;
  const Packet common = ae - e * mean;
  const Packet by_slope = spread > kLeast * aa ? common * common / spread : all(0.0F);
  return e * e / larger(w, all(kLeast)) + by_slope;
}

}  // namespace sightline::lines

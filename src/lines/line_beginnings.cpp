#include "sightline/lines/line_beginnings.h"

#include <algorithm>
#include <cstring>

#include "sightline/lines/packet.h"

namespace sightline::lines {

namespace {

// Added to a determinant that is only rounding: no line explains anything then.
constexpr double kHuge = 1e300;

void addTo(double* at, double value, Quad& result) {
  std::memcpy(&result, at, sizeof(result));
  result += value;
  std::memcpy(at, &result, sizeof(result));
}

}  // namespace

void LineBeginnings::reserve(std::size_t most) {
  for (auto* array : {&before_, &one_, &x_, &y_, &xx_, &xy_, &yy_, &total_}) {
    array->resize(most + kLanes);
  }
  atom_.resize(most + kLanes);
}

void LineBeginnings::push(std::uint32_t atom, double cost_before, const LineMoments& moments) {
  before_[count_] = cost_before;
  one_[count_] = moments.one;
  x_[count_] = moments.x;
  y_[count_] = moments.y;
  xx_[count_] = moments.xx;
  xy_[count_] = moments.xy;
  yy_[count_] = moments.yy;
  atom_[count_++] = atom;
}

// Pointers of its own: the compiler would load those of the vectors anew after every store.
SIGHTLINE_VECTOR_CLONES
std::size_t LineBeginnings::advance(const LineMoments& moments) {
  double* const sums[] = {one_.data(), x_.data(), y_.data(), xx_.data(), xy_.data(), yy_.data()};
  double* const totals = total_.data();
  const double* const befores = before_.data();
  const Quad lanes{0.0, 1.0, 2.0, 3.0};
  Quad least{kHuge, kHuge, kHuge, kHuge};
  for (std::size_t k = 0; k < count_; k += kLanes) {
    Quad one, x, y, xx, xy, yy, before;
    addTo(sums[0] + k, moments.one, one);
    addTo(sums[1] + k, moments.x, x);
    addTo(sums[2] + k, moments.y, y);
    addTo(sums[3] + k, moments.xx, xx);
    addTo(sums[4] + k, moments.xy, xy);
    addTo(sums[5] + k, moments.yy, yy);
    std::memcpy(&before, befores + k, sizeof(before));
    const Quad exact = xx * yy - xy * xy;
    const Quad determinant =
        exact > LineMoments::kLeastDeterminant * xx * yy ? exact : exact + kHuge;
    const Quad explained = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant;
    const Quad total = before + (one - explained);
    std::memcpy(totals + k, &total, sizeof(total));
    const Quad counted = lanes < static_cast<double>(count_ - k) ? total : least;
    least = counted < least ? counted : least;
  }
  const double lowest = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
  std::size_t best = 0;
  while (totals[best] > lowest && best + 1 < count_) ++best;
  return best;
}

void LineBeginnings::keepBelow(double limit) {
  std::size_t kept = 0;
  while (kept < count_ && total_[kept] <= limit) ++kept;
  for (std::size_t k = kept; k < count_; ++k) {
    if (total_[k] <= limit) moveTo(kept++, k);
  }
  count_ = kept;
}

void LineBeginnings::moveTo(std::size_t to, std::size_t from) {
  if (to == from) return;
  for (auto* array : {&before_, &one_, &x_, &y_, &xx_, &xy_, &yy_}) (*array)[to] = (*array)[from];
  atom_[to] = atom_[from];
}

}  // namespace sightline::lines

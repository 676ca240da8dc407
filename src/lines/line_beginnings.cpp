#include "sightline/lines/line_beginnings.h"

#include <algorithm>
#include <cstring>
#include <limits>

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

SIGHTLINE_VECTOR_CLONES
std::size_t LineBeginnings::advance(const LineMoments& moments) {
  for (std::size_t k = 0; k < count_; k += kLanes) {
    Quad one, x, y, xx, xy, yy, before;
    addTo(one_.data() + k, moments.one, one);
    addTo(x_.data() + k, moments.x, x);
    addTo(y_.data() + k, moments.y, y);
    addTo(xx_.data() + k, moments.xx, xx);
    addTo(xy_.data() + k, moments.xy, xy);
    addTo(yy_.data() + k, moments.yy, yy);
    std::memcpy(&before, before_.data() + k, sizeof(before));
    const Quad exact = xx * yy - xy * xy;
    const Quad determinant =
        exact > LineMoments::kLeastDeterminant * xx * yy ? exact : exact + kHuge;
    const Quad explained = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant;
    const Quad total = before + (one - explained);
    std::memcpy(total_.data() + k, &total, sizeof(total));
  }
  std::size_t best = 0;
  largest_ = total_[0];
  for (std::size_t k = 1; k < count_; ++k) {
    best = total_[k] < total_[best] ? k : best;
    largest_ = std::max(largest_, total_[k]);
  }
  return best;
}

void LineBeginnings::keepBelow(double limit) {
  if (largest_ <= limit) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count_; ++k) {
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

#include "sightline/lines/splitting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

struct SplittingConstants {
  // Chosen: the fewest returns of a block, for speed; a part has two blocks at least.
  std::size_t smallest_block = 4;
  // Returns this many gates off are on something else.
  double stray_gate = 4.0;
  // Counted: a line of its own has a distance, a direction and a break.
  double line_freedom = 3.0;
  // A wall that bends by less is one that is not quite straight [sine].
  double least_bend = 0.05;
  // Lines that meet at more than this need no help to find where [sine].
  double most_bend = 0.6;
  // Nor do those that are told apart within so many returns.
  double sure_break = 2.0;
  std::size_t most_between = 8;  // returns between two pieces that adjoin
};
constexpr SplittingConstants kSplitting{};

// Sine of the turn from one line to the next.
double bendBetween(const Piece& before, const Piece& after) {
  return before.line.normal_x * after.line.normal_y - before.line.normal_y * after.line.normal_x;
}

}  // namespace

Splitting::Splitting(const BeamArray& beams, const LineExtractorConfig& config)
    : beams_(beams),
      gap_(config),
      fewest_(static_cast<std::size_t>(config.min_beams)),
      gate_squared_(config.gate * config.gate),
      price_(geometry::chiSquareLimit(config.gate, kSplitting.line_freedom)) {}

bool Splitting::split(const Piece& piece, std::vector<Piece>& parts) {
  if (isBent(piece) && gather(piece.first, piece.end, piece.line, piece.line, piece.line)) {
    const double one = costOf(0, blocks_);
    const double two = bestOfTwo().cost;
    // Where even two lines leave more than the noise does, it takes more to gain by chance.
    const double freedom = before_[blocks_].returns - 2.0;
    const double rest = std::max(1.0, freedom - kSplitting.line_freedom);
    const double most = price() * std::max(1.0, two / rest);
    // What the noise explains is one wall, be it as uneven as the noise.
    if (one - two > most && one - freedom > 0.5 * most) {
      divide(most);
      if (append(parts)) return true;
    }
  }
  parts.push_back(piece);
  return false;
}

// Chance gains by the break that suits it best.
double Splitting::price() const {
  return price_ + 2.0 * std::log(static_cast<double>(blocks_));
}

void Splitting::layOut(std::size_t first, std::size_t end) {
  first_ = first;
  end_ = end;
  block_ = std::max(kSplitting.smallest_block, (end - first + kMostBlocks - 1) / kMostBlocks);
  blocks_ = (end - first) / block_;
  fewest_blocks_ = std::max<std::size_t>(2, (fewest_ + block_ - 1) / block_);
}

// Whether any break gains enough, for speed: by the gradients at the line of the piece, and kLanes
// breaks at once.
SIGHTLINE_VECTOR_CLONES
bool Splitting::isBent(const Piece& piece) {
  layOut(piece.first, piece.end);
  if (blocks_ < 2 * fewest_blocks_) return false;
  score(piece);
  const LineScores whole = scoresOf(blocks_);
  const LineScores all_of_it{all(whole.w[0]), all(whole.a[0]), all(whole.aa[0]), all(whole.e[0]),
                             all(whole.ae[0])};
  const Packet together = all_of_it.gain();
  Packet best{};
  for (std::size_t k = fewest_blocks_; k + fewest_blocks_ <= blocks_; k += kLanes) {
    const LineScores before = scoresOf(k);
    const Packet gain = before.gain() + (all_of_it - before).gain() - together;
    best = larger(best, firstLanes(blocks_ + 1 - fewest_blocks_ - k) * gain);
  }
  const float most = std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
  return static_cast<double>(most) > price();
}

// Sums over the blocks before `block` and before the next three.
LineScores Splitting::scoresOf(std::size_t block) const {
  const LineScores* of = scores_.data() + block;
  return {sums(of[0].w, of[1].w, of[2].w, of[3].w), sums(of[0].a, of[1].a, of[2].a, of[3].a),
          sums(of[0].aa, of[1].aa, of[2].aa, of[3].aa), sums(of[0].e, of[1].e, of[2].e, of[3].e),
          sums(of[0].ae, of[1].ae, of[2].ae, of[3].ae)};
}

SIGHTLINE_VECTOR_CLONES
void Splitting::score(const Piece& piece) {
  const auto reference =
      static_cast<float>(positionOn(beams_, first_ + (end_ - first_) / 2, piece.line));
  const auto gate = static_cast<float>(gate_squared_);
  const auto stray = static_cast<float>(kSplitting.stray_gate * kSplitting.stray_gate) * gate;
  LineScores scores;
  for (std::size_t k = 0; k < blocks_; ++k) {
    scores_[k] = scores;
    const std::size_t end = beginOf(k + 1);
    for (std::size_t i = beginOf(k); i < end; i += kLanes) {
      const BeamResiduals of = residualsOf(beams_, i, piece.line);
      const Packet squared = of.squared();
      const Packet taken = squared > stray ? all(0.0F) : firstLanes(end - i);
      const Packet bounded = smaller(all(1.0F), gate / larger(squared, all(1e-6F)));
      const Packet weight = taken * of.weight * bounded;
      const Packet a = of.position - reference;
      scores.w += weight;
      scores.a += weight * a;
      scores.aa += weight * a * a;
      scores.e += weight * of.distance;
      scores.ae += weight * a * of.distance;
    }
  }
  for (std::size_t k = blocks_; k < blocks_ + kLanes; ++k) scores_[k] = scores;
}

bool Splitting::settle(Piece& before, Piece& after) {
  const double sine = std::abs(bendBetween(before, after));
  if (sine > kSplitting.most_bend || !adjoin(before, after)) return false;
  if (reachOfNoise(before, after) < kSplitting.sure_break * sine) return false;
  if (!gather(before.first, after.end, middleLine(before, after), before.line, after.line)) {
    return false;
  }
  const std::size_t at = bestOfTwo().at;
  const std::size_t moved = std::max(beginOf(at), after.first) - std::min(beginOf(at), after.first);
  if (moved < block_) return false;
  Piece first = part(0, at);
  Piece second = part(at, blocks_);
  if (!refine(beams_, gate_squared_, first) || !refine(beams_, gate_squared_, second)) return false;
  before = first;
  after = second;
  return true;
}

// Two standard deviations of the noise where pieces meet, over the distance of the returns there.
double Splitting::reachOfNoise(const Piece& before, const Piece& after) const {
  const std::size_t last = before.end - 1;
  const double spacing =
      std::hypot(beams_.x[after.first] - beams_.x[last], beams_.y[after.first] - beams_.y[last]) /
      static_cast<double>(after.first - last);
  const auto weight = static_cast<double>(residualsOf(beams_, last, before.line).weight[0]);
  return 2.0 / std::sqrt(weight) / std::max(spacing, 1e-6);
}

// Whether the pieces follow on each other and their lines meet there: one behind the other has no
// corner with it.
bool Splitting::adjoin(const Piece& before, const Piece& after) const {
  if (after.first - before.end > kSplitting.most_between) return false;
  const double length = positionOn(beams_, after.first, before.line) -
                        positionOn(beams_, before.end - 1, before.line);
  const auto reach =
      static_cast<float>(kSplitting.stray_gate * kSplitting.stray_gate * gate_squared_);
  return gap_.mayBridge(beams_, before.line, before.end - 1, after.first, length) &&
         isWithin(beams_, after.first, before.line, reach) &&
         isWithin(beams_, before.end - 1, after.line, reach);
}

// Through the place where two pieces meet, halfway between their directions.
LineEstimate Splitting::middleLine(const Piece& before, const Piece& after) const {
  LineEstimate line = before.line;
  line.normal_x += after.line.normal_x;
  line.normal_y += after.line.normal_y;
  const double length = std::hypot(line.normal_x, line.normal_y);
  line.normal_x /= length;
  line.normal_y /= length;
  line.rho = line.normal_x * static_cast<double>(beams_.x[after.first]) +
             line.normal_y * static_cast<double>(beams_.y[after.first]);
  return line;
}

// False where there are too few returns for two lines.
bool Splitting::gather(std::size_t first, std::size_t end, const LineEstimate& about,
                       const LineEstimate& before, const LineEstimate& after) {
  layOut(first, end);
  about_ = about;
  if (blocks_ < 2 * fewest_blocks_) return false;
  const std::size_t middle = first + (end - first) / 2;
  reference_ = about.alongX() * static_cast<double>(beams_.x[middle]) +
               about.alongY() * static_cast<double>(beams_.y[middle]);
  before_[0] = {};
  for (std::size_t k = 0; k < blocks_; ++k) {
    before_[k + 1] = before_[k];
    before_[k + 1] += sumOf(beginOf(k), beginOf(k + 1), before, after);
  }
  return true;
}

std::size_t Splitting::beginOf(std::size_t block) const {
  return block == blocks_ ? end_ : first_ + block * block_;
}

// Weights are those of the closer line.
SIGHTLINE_VECTOR_CLONES
LineSums Splitting::sumOf(std::size_t first, std::size_t end, const LineEstimate& before,
                          const LineEstimate& after) const {
  const auto nx = static_cast<float>(about_.normal_x);
  const auto ny = static_cast<float>(about_.normal_y);
  const auto rho = static_cast<float>(about_.rho);
  const auto reference = static_cast<float>(reference_);
  const auto gate = static_cast<float>(gate_squared_);
  const auto stray = static_cast<float>(kSplitting.stray_gate * kSplitting.stray_gate) * gate;
  Packet w{}, wa{}, waa{}, we{}, wae{}, wee{}, returns{};
  for (std::size_t i = first; i < end; i += kLanes) {
    const BeamResiduals of_before = residualsOf(beams_, i, before);
    const BeamResiduals of_after = residualsOf(beams_, i, after);
    const Packet as_before = of_before.squared();
    const Packet as_after = of_after.squared();
    const Packet squared = smaller(as_before, as_after);
    const Packet taken = squared > stray ? all(0.0F) : firstLanes(end - i);
    const Packet closer = as_before < as_after ? of_before.weight : of_after.weight;
    // Beyond the gate a return counts as if it were there.
    const Packet weight = taken * closer * smaller(all(1.0F), gate / larger(squared, all(1e-6F)));
    const Packet x = load(beams_.x.data() + i);
    const Packet y = load(beams_.y.data() + i);
    const Packet a = nx * y - ny * x - reference;
    const Packet e = nx * x + ny * y - rho;
    w += weight;
    wa += weight * a;
    waa += weight * a * a;
    we += weight * e;
    wae += weight * a * e;
    wee += weight * e * e;
    returns += taken;
  }
  return {sum(w), sum(wa), sum(waa), sum(we), sum(wae), sum(wee), sum(returns)};
}

double Splitting::costOf(std::size_t first, std::size_t end) const {
  return (before_[end] - before_[first]).cost();
}

Splitting::Break Splitting::bestOfTwo() const {
  Break best{fewest_blocks_, std::numeric_limits<double>::infinity()};
  for (std::size_t k = fewest_blocks_; k + fewest_blocks_ <= blocks_; ++k) {
    const double cost = costOf(0, k) + costOf(k, blocks_);
    if (cost < best.cost) best = {k, cost};
  }
  return best;
}

// The likeliest division of the first k blocks, for every k.
void Splitting::divide(double price) {
  least_[0] = -price;
  for (std::size_t end = 1; end <= blocks_; ++end) {
    least_[end] = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first + fewest_blocks_ <= end; ++first) {
      const double cost = least_[first] + costOf(first, end) + price;
      if (cost >= least_[end]) continue;
      least_[end] = cost;
      from_[end] = first;
    }
  }
}

Piece Splitting::part(std::size_t first, std::size_t end) const {
  Piece part;
  part.first = beginOf(first);
  part.end = beginOf(end);
  part.line = (before_[end] - before_[first]).line(about_, reference_);
  return part;
}

bool Splitting::append(std::vector<Piece>& parts) const {
  const std::size_t old_size = parts.size();
  for (std::size_t end = blocks_; end > 0; end = from_[end]) {
    Piece found = part(from_[end], end);
    if (refine(beams_, gate_squared_, found)) parts.push_back(found);
  }
  bool bends = false;
  for (std::size_t i = old_size; i + 1 < parts.size(); ++i) {
    bends = bends || std::abs(bendBetween(parts[i + 1], parts[i])) > kSplitting.least_bend;
  }
  if (bends) {
    std::reverse(parts.begin() + static_cast<std::ptrdiff_t>(old_size), parts.end());
  } else {
    parts.resize(old_size);
  }
  return bends;
}

}  // namespace sightline::lines

#include "sightline/lines/span.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/statistics.h"

namespace sightline::lines {

namespace {

struct SpanConstants {
  // Returns that a break leaves a line.
  std::size_t fewest = 5;
  // Counted: a line of its own has a distance, a direction and a break.
  double line_freedom = 3.0;
  // A wall that bends by less is one that is not quite straight [sine].
  double least_bend = 0.05;
  // Lines that meet at more than this need no help to find where [sine].
  double most_bend = 0.6;
  // Chosen: atoms that a break may move by, and of a span that may be no more than a corner.
  std::size_t reach = 4;
  std::size_t fragment = 2;
};
constexpr SpanConstants kSpan{};

// Sine of the turn from one line to the next.
double bendBetween(const Span& before, const Span& after) {
  const LineEstimate a = before.moments.line();
  const LineEstimate b = after.moments.line();
  return a.normal_x * b.normal_y - a.normal_y * b.normal_x;
}

// Squared distance between two lines along the beam that they meet at, in standard deviations of
// one return.
double stepSquared(const BeamArray& beams, const Span& before, const Span& after) {
  const std::size_t at = after.first;
  const LineEstimate a = before.moments.line();
  const LineEstimate b = after.moments.line();
  const Eigen::Vector2d direction = beams.direction(at);
  const auto range = [&](const LineEstimate& line) {
    return line.rho / (line.normal_x * direction.x() + line.normal_y * direction.y());
  };
  const double step = range(a) - range(b);
  return step * step / static_cast<double>(beams.slantVariances()[at]);
}

}  // namespace

Span joined(const Span& before, const Span& after) {
  Span whole = before;
  whole.end_atom = after.end_atom;
  whole.end = after.end;
  whole.moments += after.moments;
  whole.cost = whole.moments.cost();
  return whole;
}

// Division of two spans.
struct SpanBreaks::Break {
  std::size_t at;    // first return of the second
  std::size_t atom;  // that holds it
  double cost;
  LineMoments before, after;

  void giveBack(const LineMoments& moments) {
    before -= moments;
    after += moments;
  }
  void takeOver(const LineMoments& moments) {
    before += moments;
    after -= moments;
  }
};

SpanBreaks::SpanBreaks(const LineExtractorConfig& config)
    : gate_(config.gate),
      misfit_(config.misfit),
      price_(geometry::chiSquareLimit(config.gate, kSpan.line_freedom)),
      stray_price_(config.gate * config.gate) {}

void SpanBreaks::assign(const Atoms& atoms, const BeamArray& beams) {
  atoms_ = &atoms;
  beams_ = &beams;
}

bool SpanBreaks::adjoin(const Span& before, const Span& after) const {
  return before.end == after.first && !(*atoms_)[after.first_atom].is_cut;
}

// Walls one behind the other share no corner: their distance counts no more than a stray return.
double SpanBreaks::costOf(const Break& of) const {
  return of.before.cost() + of.after.cost() +
         std::min(stray_price_, apartSquared(of.before, of.after, beams_->direction(of.at - 1),
                                             beams_->direction(of.at)));
}

void SpanBreaks::settle(Span& before, Span& after) const {
  if (!adjoin(before, after)) return;
  Break best{before.end, after.first_atom, 0.0, before.moments, after.moments};
  best.cost = costOf(best);
  const std::size_t atom = after.first_atom;
  const bool are_small = atoms_->beginOf(atom + 1) - atoms_->beginOf(atom - 1) < kSpan.fewest;
  if (are_small || std::abs(bendBetween(before, after)) < kSpan.most_bend) {
    settleOnAtoms(before, after, best);
  }
  settleWithin(before, after, best);
  before.end = after.first = best.at;
  before.moments = best.before;
  after.moments = best.after;
}

void SpanBreaks::settleOnAtoms(const Span& before, const Span& after, Break& best) const {
  const Break start = best;
  const auto isAllowed = [&](Break& found) {
    found.at = atoms_->beginOf(found.atom);
    if (found.at < before.first + kSpan.fewest || found.at + kSpan.fewest > after.end) return false;
    found.cost = costOf(found);
    if (found.cost < best.cost) best = found;
    return true;
  };
  Break found = start;
  for (std::size_t k = 0; k < kSpan.reach && found.atom > before.first_atom + 1; ++k) {
    found.giveBack((*atoms_)[--found.atom].moments);
    if (!isAllowed(found)) break;
  }
  found = start;
  for (std::size_t k = 0; k < kSpan.reach && found.atom + 1 < after.end_atom; ++k) {
    found.takeOver((*atoms_)[found.atom++].moments);
    if (!isAllowed(found)) break;
  }
}

// Looks at the returns of the atoms beside the break.
void SpanBreaks::settleWithin(const Span& before, const Span& after, Break& best) const {
  const Break start = best;
  const std::size_t low =
      std::max(atoms_->beginOf(start.atom - 1) + 1, before.first + kSpan.fewest);
  const std::size_t high = std::min(atoms_->beginOf(start.atom + 1), after.end + 1 - kSpan.fewest);
  const auto look = [&](Break& found) {
    found.cost = costOf(found);
    if (found.cost < best.cost) best = found;
  };
  Break found = start;
  while (found.at > low) {
    --found.at;
    found.giveBack(atoms_->momentsOf(*beams_, start.atom - 1, found.at));
    look(found);
  }
  found = start;
  while (found.at + 1 < high) {
    found.takeOver(atoms_->momentsOf(*beams_, start.atom, found.at));
    ++found.at;
    look(found);
  }
}

bool SpanBreaks::join(Span& before, const Span& after) const {
  const double bend = std::abs(bendBetween(before, after));
  if (bend > kSpan.most_bend) return false;
  const Span whole = joined(before, after);
  const double parts = costOf({before.end, after.first_atom, 0.0, before.moments, after.moments});
  // A step that one return tells is none of unevenness.
  const bool has_step = stepSquared(*beams_, before, after) > stray_price_;
  if (!isOneWall(whole, parts, has_step ? kSpan.most_bend : bend)) return false;
  before = whole;
  return true;
}

bool SpanBreaks::isOneWall(const Span& whole, double parts, double bend) const {
  const double freedom = static_cast<double>(whole.end - whole.first) - 2.0;
  if (bend < kSpan.least_bend &&
      whole.cost <= misfit_ * misfit_ * geometry::chiSquareLimit(gate_, freedom)) {
    return true;
  }
  // Where even two lines leave more than the noise does, it takes more to gain by chance.
  const double rest = std::max(1.0, freedom - kSpan.line_freedom);
  const double most = price_ * std::max(1.0, parts / rest);
  // What the noise explains is one wall, be it as uneven as the noise.
  return whole.cost - parts <= most || whole.cost - freedom <= 0.5 * most;
}

// A corner in the midst of an atom leaves a short line between two.
bool SpanBreaks::shareOut(Span& before, const Span& fragment, const Span& after) const {
  if (fragment.end_atom - fragment.first_atom > kSpan.fragment) return false;
  if (!adjoin(before, fragment) || !adjoin(fragment, after)) return false;
  const Span whole = joined(before, fragment);
  Span first = whole;
  Span second = after;
  settle(first, second);
  const double two = costOf({first.end, 0, 0.0, first.moments, second.moments});
  if (two > before.cost + fragment.cost + after.cost + price_) return false;
  before = whole;
  return true;
}

}  // namespace sightline::lines

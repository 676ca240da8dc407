#include "sightline/lines/span.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

struct SpanConstants {
  // Returns that a break leaves a line.
  std::size_t fewest = 5;
  // Counted: a line of its own has a distance, a direction and a break.
  double line_freedom = 3.0;
  // Walls that meet are built at more than this; less is one that is uneven [sine].
  double least_bend = 0.1;
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

double lengthOf(const BeamArray& beams, const Span& span) {
  constexpr double kLeast = 1e-3;  // m
  const std::size_t last = span.end - 1;
  const float x = beams.x[last] - beams.x[span.first];
  const float y = beams.y[last] - beams.y[span.first];
  return std::max(kLeast, static_cast<double>(std::sqrt(x * x + y * y)));
}

// Weighted mean of the distances of returns from a wall, stray ones apart, and the weight of all:
// kLanes returns, as many as are looked at on one side of a break.
struct MeanDistance {
  MeanDistance(const BeamArray& beams, std::size_t first, const LineEstimate& wall,
               const LineEstimate& own, double gate_squared) {
    constexpr double kLeast = 1e-9;  // of a weight [1/m²]
    const BeamResiduals of = residualsOf(beams, first, wall);
    const Packet squared = residualsOf(beams, first, own).squared();
    const Packet taken = squared <= static_cast<float>(gate_squared) ? of.weight : all(0.0F);
    weight = std::max(kLeast, sum(taken));
    mean = sum(Packet(taken * of.distance)) / weight;
  }
  double mean;
  double weight;
};

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
    : config_(config),
      price_(geometry::chiSquareLimit(config.gate, kSpan.line_freedom)),
      stray_price_(config.gate * config.gate) {}

void SpanBreaks::assign(const Atoms& atoms, const BeamArray& beams) {
  atoms_ = &atoms;
  beams_ = &beams;
}

bool SpanBreaks::adjoin(const Span& before, const Span& after) const {
  return before.end == after.first && !(*atoms_)[after.first_atom].is_cut;
}

double SpanBreaks::costOf(const Break& of) const {
  return of.before.cost() + of.after.cost() + costOfMeeting(of);
}

// Walls one behind the other share no corner: their distance counts no more than a stray return.
double SpanBreaks::costOfMeeting(const Break& of) const {
  return std::min(stray_price_, apartSquared(of.before, of.after, beams_->direction(of.at - 1),
                                             beams_->direction(of.at)));
}

void SpanBreaks::look(Break& found, Break& best) const {
  found.cost = found.before.cost() + found.after.cost();
  if (found.cost >= best.cost) return;  // for speed: where they meet costs more, if anything
  found.cost += costOfMeeting(found);
  if (found.cost < best.cost) best = found;
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
    look(found, best);
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
  Break found = start;
  while (found.at > low) {
    --found.at;
    found.giveBack(atoms_->momentsOf(*beams_, start.atom - 1, found.at));
    look(found, best);
  }
  found = start;
  while (found.at + 1 < high) {
    found.takeOver(atoms_->momentsOf(*beams_, start.atom, found.at));
    ++found.at;
    look(found, best);
  }
}

// A turn u' − u of lines u · p = 1 moves the line at a place on it, across it, by −ρ p · (u' − u),
// and turns it by −ρ t · (u' − u) for the direction t along it; the covariance of u is the inverse
// of the second moments.
double SpanBreaks::apart(const Span& before, const Span& after) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (!adjoin(before, after)) return kNever;
  const LineEstimate wall = joined(before, after).moments.line();
  const Eigen::Vector2d direction = beams_->direction(after.first);
  const double facing = wall.normal_x * direction.x() + wall.normal_y * direction.y();
  if (facing < static_cast<double>(kMinIncidence)) return kNever;
  const double step = stepSquared(before, after, wall);
  if (step > price_) return step;
  Eigen::Matrix2d to_wall;
  to_wall << wall.rho / facing * direction.transpose(), wall.alongX(), wall.alongY();
  to_wall *= -wall.rho;
  const Eigen::Matrix2d of_before = before.moments.covariance();
  const Eigen::Matrix2d of_after = after.moments.covariance();
  const Eigen::Vector2d difference =
      to_wall * (of_before * before.moments.first() - of_after * after.moments.first());
  Eigen::Matrix2d covariance = to_wall * (of_before + of_after) * to_wall.transpose();
  covariance.diagonal() +=
      shape_.difference(lengthOf(*beams_, before), lengthOf(*beams_, after), 0.0);
  const double squared = difference.dot(covariance.inverse() * difference);
  return squared >= 0.0 ? squared : kNever;  // what is not determined is no number
}

bool SpanBreaks::isShort(const Span& span) const {
  return static_cast<double>(span.end - span.first) < config_.min_beams ||
         lengthOf(*beams_, span) < config_.min_length;
}

double SpanBreaks::misfit(const Span& before, const Span& after) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (!adjoin(before, after)) return kNever;
  const bool are_short[] = {isShort(before), isShort(after)};
  if (!are_short[0] && !are_short[1]) return kNever;
  if (std::abs(bendBetween(before, after)) > kSpan.least_bend) return kNever;
  const LineEstimate wall = joined(before, after).moments.line();
  if (!(wall.rho > 0.0)) return kNever;
  const bool is_wall = !are_short[0] || !are_short[1];
  const double most = is_wall ? config_.misfit * config_.misfit : 1.0;
  const auto ratio = [&](const Span& span) {
    const auto returns = static_cast<double>(span.end - span.first);
    return span.moments.costAbout(wall) / (most * geometry::chiSquareLimit(config_.gate, returns));
  };
  return std::max(ratio(before), ratio(after));
}

// Squared step from the last returns before a break to the first after it, in standard deviations:
// a wall is uneven by little over so few.
double SpanBreaks::stepSquared(const Span& before, const Span& after,
                               const LineEstimate& wall) const {
  const std::size_t from = before.end - kLanes;
  const std::size_t to = after.first + kLanes - 1;
  const MeanDistance a(*beams_, from, wall, before.moments.line(), stray_price_);
  const MeanDistance b(*beams_, after.first, wall, after.moments.line(), stray_price_);
  const double length =
      std::hypot(beams_->x[to] - beams_->x[from], beams_->y[to] - beams_->y[from]);
  // Means over adjoining halves of a random walk differ by a third of what it strays over both.
  const double variance = 1.0 / a.weight + 1.0 / b.weight + shape_.variance(length) / 3.0;
  return (b.mean - a.mean) * (b.mean - a.mean) / variance;
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

#include "sightline/lines/segmentation.h"

#include <algorithm>

namespace sightline::lines {

Segmentation::Segmentation(const LineExtractorConfig& config) : atoms_(config), breaks_(config) {}

void Segmentation::reserve(std::size_t returns) {
  atoms_.reserve(returns);
  beginnings_.reserve(returns);
  least_.resize(returns + 1);
  from_.resize(returns + 1);
  spans_.reserve(returns / kFewest + 1);
  apart_.reserve(returns / kFewest + 1);
}

void Segmentation::divide(const BeamArray& beams, std::size_t first, std::size_t end,
                          std::vector<Piece>& pieces) {
  atoms_.assign(beams, first, end);
  breaks_.assign(atoms_, beams);
  findBest();
  trace();
  join(breaks_.price(), &SpanBreaks::apart);
  shareOutFragments();
  join(1.0, &SpanBreaks::misfit);
  for (std::size_t i = 0; i + 1 < spans_.size(); ++i) breaks_.settle(spans_[i], spans_[i + 1]);
  for (const Span& span : spans_) {
    Piece piece;
    piece.first = span.first;
    piece.end = span.end;
    piece.line = span.moments.line();
    pieces.push_back(piece);
  }
}

void Segmentation::findBest() {
  beginnings_.clear();
  pendings_ = 0;
  least_[0] = 0.0;
  for (std::size_t atom = 0; atom < atoms_.size(); ++atom) takeAtom(atom);
}

void Segmentation::takeAtom(std::size_t atom) {
  if (atoms_[atom].is_cut) {
    beginnings_.clear();
    pendings_ = 0;
  }
  begin(atom);
  const auto returns = static_cast<double>(atoms_.beginOf(atom + 1) - atoms_.beginOf(atom));
  double& least = least_[atom + 1] = least_[atom] + breaks_.strayPrice() * returns;
  from_[atom + 1] = -1;
  if (beginnings_.isEmpty()) return;
  const std::size_t best = beginnings_.advance(atoms_[atom].moments);
  const double cost = beginnings_.total(best) + breaks_.price();
  if (cost < least) {
    least = cost;
    from_[atom + 1] = static_cast<std::int32_t>(beginnings_.atom(best));
  }
  // A line after this one may have to wait for enough returns.
  beginnings_.keepBelow(least + breaks_.strayPrice() * static_cast<double>(kFewest));
}

void Segmentation::begin(std::size_t atom) {
  if (pendings_ == 0 && atoms_.beginOf(atom + 1) - atoms_.beginOf(atom) >= kFewest) {
    return beginnings_.push(static_cast<std::uint32_t>(atom), least_[atom], {});
  }
  pending_[pendings_++] = {static_cast<std::uint32_t>(atom), least_[atom], {}};
  std::size_t kept = 0;
  for (std::size_t k = 0; k < pendings_; ++k) {
    Pending& of = pending_[k];
    if (atoms_.beginOf(atom + 1) - atoms_.beginOf(of.atom) >= kFewest) {
      beginnings_.push(of.atom, of.cost_before, of.moments);
      continue;
    }
    of.moments += atoms_[atom].moments;
    pending_[kept++] = of;
  }
  pendings_ = kept;
}

void Segmentation::trace() {
  spans_.clear();
  for (std::size_t end = atoms_.size(); end > 0;) {
    if (from_[end] < 0) {
      --end;
      continue;
    }
    const auto first = static_cast<std::size_t>(from_[end]);
    Span span{first, end, atoms_.beginOf(first), atoms_.beginOf(end), {}, 0.0};
    for (std::size_t i = first; i < end; ++i) span.moments += atoms_[i].moments;
    span.cost = span.moments.cost();
    spans_.push_back(span);
    end = first;
  }
  std::reverse(spans_.begin(), spans_.end());
}

// Joins the likeliest first, so that no wall depends on the side that it is come to from.
void Segmentation::join(double limit, Measure measure) {
  const auto apartAt = [&](std::size_t i) { return (breaks_.*measure)(spans_[i], spans_[i + 1]); };
  apart_.clear();
  for (std::size_t i = 0; i + 1 < spans_.size(); ++i) apart_.push_back(apartAt(i));
  while (!apart_.empty()) {
    const auto least = std::min_element(apart_.begin(), apart_.end());
    if (*least >= limit) return;
    const auto i = static_cast<std::size_t>(least - apart_.begin());
    spans_[i] = joined(spans_[i], spans_[i + 1]);
    spans_.erase(spans_.begin() + (least - apart_.begin()) + 1);
    apart_.erase(least);
    if (i > 0) apart_[i - 1] = apartAt(i - 1);
    if (i < apart_.size()) apart_[i] = apartAt(i);
  }
}

void Segmentation::shareOutFragments() {
  std::size_t kept = 0;
  for (std::size_t i = 1; i < spans_.size(); ++i) {
    // The span after a fragment has its part of it still to get, and is none itself.
    if (i + 1 < spans_.size() && breaks_.shareOut(spans_[kept], spans_[i], spans_[i + 1])) ++i;
    spans_[++kept] = spans_[i];
  }
  spans_.resize(std::min(kept + 1, spans_.size()));
}

}  // namespace sightline::lines

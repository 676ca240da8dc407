#pragma once

#include <cstddef>

#include "sightline/lines/atoms.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/line_moments.h"
#include "sightline/lines/wall_shape.h"

namespace sightline::lines {

/// Returns of one line in a division of a scan into atoms.
struct Span {
  std::size_t first_atom = 0;
  std::size_t end_atom = 0;
  std::size_t first = 0;  ///< return, by its index in the BeamArray
  std::size_t end = 0;
  LineMoments moments;
  double cost = 0.0;  ///< χ² about the line
};

/// Makes one span of two that adjoin.
Span joined(const Span& before, const Span& after);

/// Breaks between spans that adjoin.
///
/// Two walls that meet do so on the line of sight between two returns. In u = n/ρ (LineMoments)
/// that is linear, so that χ² of two lines that are held together there costs no more than that of
/// two free ones; and it says far better than this where walls meet that turn by little.
class SpanBreaks {
 public:
  explicit SpanBreaks(const LineExtractorConfig& config);

  /// What another line costs: what chance may gain by its distance, direction and break.
  double price() const { return price_; }
  /// What a return on no line costs.
  double strayPrice() const { return stray_price_; }

  /// Takes the atoms and returns that the spans are of; they have to live as long.
  void assign(const Atoms& atoms, const BeamArray& beams);

  /// Whether nothing lies between two spans, and no gap.
  bool adjoin(const Span& before, const Span& after) const;
  /// Puts the break where two lines, fitted anew for every break and held together there, explain
  /// the returns best. Spans beyond a gap are left alone.
  void settle(Span& before, Span& after) const;
  /// Squared distance between two spans as parts of one wall, in standard deviations of what noise
  /// and the unevenness of walls make of it: they are one where it is below the price of a line.
  /// Infinite where they do not adjoin.
  double apart(const Span& before, const Span& after) const;
  /// What two spans that adjoin leave about one line for both, over the most that a wall may: below
  /// 1, one that is too short for a wall is an uneven place of the other. Two that are too short
  /// may leave what the noise does, and no more. Infinite where neither is short, or they bend.
  double misfit(const Span& before, const Span& after) const;
  /// Whether a short span is no more than the corner of its neighbours: gives it to the first then,
  /// with the break to be settled.
  bool shareOut(Span& before, const Span& fragment, const Span& after) const;

 private:
  struct Break;

  bool isShort(const Span& span) const;
  double stepSquared(const Span& before, const Span& after, const LineEstimate& wall) const;
  void settleOnAtoms(const Span& before, const Span& after, Break& best) const;
  void settleWithin(const Span& before, const Span& after, Break& best) const;
  double costOf(const Break& of) const;
  double costOfMeeting(const Break& of) const;
  void look(Break& found, Break& best) const;

  LineExtractorConfig config_;
  double price_;
  double stray_price_;
  WallShape shape_;
  const Atoms* atoms_ = nullptr;
  const BeamArray* beams_ = nullptr;
};

}  // namespace sightline::lines

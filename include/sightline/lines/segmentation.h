#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sightline/lines/atoms.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_beginnings.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/line_moments.h"
#include "sightline/lines/piece.h"
#include "sightline/lines/span.h"

namespace sightline::lines {

/// Divides the returns of a scan into lines and stray returns so that the sum of χ² and of a price
/// for every line and every stray return is least: penalised maximum likelihood, by dynamic
/// programming over small runs of returns (Atoms). Beginnings of a line that can no longer be of
/// the best division are dropped as soon as that is certain (Killick, Fearnhead and Eckley 2012,
/// "Optimal detection of changepoints with a linear computational cost", eq. 3.2).
class Segmentation {
 public:
  static constexpr std::size_t kFewest = 5;  ///< returns of a line

  explicit Segmentation(const LineExtractorConfig& config);

  /// Makes room for so many returns, so that nothing is allocated later.
  void reserve(std::size_t returns);

  /// Appends the lines in [first, end), each with its returns, normal and distance.
  void divide(const BeamArray& beams, std::size_t first, std::size_t end,
              std::vector<Piece>& pieces);

 private:
  /// A line that is too short to be one as yet.
  struct Pending {
    std::uint32_t atom;
    double cost_before;
    LineMoments moments;
  };

  /// How far two spans are from being one.
  using Measure = double (SpanBreaks::*)(const Span&, const Span&) const;

  void findBest();
  void begin(std::size_t atom);
  void takeAtom(std::size_t atom);
  void trace();
  void join(double limit, Measure measure);
  void shareOutFragments();

  Atoms atoms_;
  SpanBreaks breaks_;
  LineBeginnings beginnings_;
  std::array<Pending, kFewest> pending_;
  std::size_t pendings_ = 0;
  std::vector<double> least_;       // cost of the atoms before each
  std::vector<std::int32_t> from_;  // where the line that ends before an atom begins; −1: stray
  std::vector<Span> spans_;
  std::vector<double> apart_;  // each from the next
};

}  // namespace sightline::lines

#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/gap.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/line_moments.h"

namespace sightline::lines {

/// A few returns in a row that one line explains, or a single one.
struct Atom {
  std::size_t first = 0;
  LineMoments moments;
  std::size_t stray = kNone;  ///< return that is of nothing, and costs any line the same
  bool is_cut = false;        ///< from the atom before it, by a gap that no line goes on across

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

/// Divides returns into atoms, for speed: as many in a row as the number of returns allows where a
/// line explains them, fewer where it does not, single ones at a step.
class Atoms {
 public:
  explicit Atoms(const LineExtractorConfig& config);

  void reserve(std::size_t returns);
  void assign(const BeamArray& beams, std::size_t first, std::size_t end);

  std::size_t size() const { return atoms_.size(); }
  const Atom& operator[](std::size_t i) const { return atoms_[i]; }
  /// First return of an atom, or one past the last return of all.
  std::size_t beginOf(std::size_t i) const { return i < atoms_.size() ? atoms_[i].first : end_; }
  /// What one of the returns of an atom adds to its moments.
  LineMoments momentsOf(const BeamArray& beams, std::size_t atom, std::size_t of_return) const;

 private:
  static constexpr std::size_t kSmallest = 4;  // that is divided no further
  static constexpr std::size_t kLeast = 6;     // of a whole one
  static constexpr std::size_t kMost = 64;

  void take(const BeamArray& beams, std::size_t first, std::size_t end, const LineMoments& moments);
  bool isLine(const LineMoments& moments, std::size_t count) const;
  bool takeWithStray(const BeamArray& beams, std::size_t first, const LineMoments& left,
                     const LineMoments& right);
  bool isStray(const BeamArray& beams, std::size_t first, std::size_t i,
               const LineMoments& others) const;
  bool isOpening(const BeamArray& beams, std::size_t i, const LineEstimate& line) const;
  void takeSingly(const BeamArray& beams, std::size_t first, std::size_t end);
  void append(const BeamArray& beams, std::size_t first, const LineMoments& moments,
              std::size_t stray = Atom::kNone);
  bool hasCut(const BeamArray& beams, std::size_t first, std::size_t end) const;
  bool isCut(const BeamArray& beams, std::size_t i) const;

  Gap gap_;
  double gate_;
  std::array<double, kMost + 2> limits_{};  // χ² of so many returns about a line, at most
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t most_ = kSmallest;  // returns of an atom
  std::vector<Atom> atoms_;
};

}  // namespace sightline::lines

#include "sightline/lines/piece.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/normal_equations.h"

namespace sightline::lines {

namespace {

// Gauss-Newton.
struct RefineConstants {
  int most_steps = 10;
  // A step this far below the standard deviations [σ²] leaves an error of second order in it.
  double small_step = 0.1;
  // Chosen: ratio of its returns that may come or go for the linearisation of a piece to hold.
  double few_returns = 0.2;
};
constexpr RefineConstants kRefine{};

// Blocks in which a wall is looked at for its unevenness, and returns of one.
struct BlockConstants {
  std::size_t most = 16;
  std::size_t fewest = 4;
  double chance = 1.5;         // standard deviations of χ² over its degrees of freedom
  double shared_chance = 2.5;  // the same of what the returns of a block share
  // Chosen between what is right where each block strays by itself (1/14), and where the surface is
  // a random walk, of which a line takes most for its own (3/2).
  double share = 0.5;
};
constexpr BlockConstants kBlocks{};

// A step to the maximum of likelihood; how far it was, negative where there is none.
double take(const NormalEquations& equations, Piece& piece) {
  if (equations.beams < 3.0 || !equations.information.isDetermined()) return -1.0;
  const double decrease = stepTo(equations, piece.line);
  piece.beams = equations.beams;
  piece.chi_square = std::max(0.0, equations.chi_square - decrease);
  piece.refined_first = piece.first;
  piece.refined_end = piece.end;
  return decrease;
}

std::size_t distance(std::size_t a, std::size_t b) {
  return a > b ? a - b : b - a;
}

bool hasChangedLittle(const Piece& piece) {
  const std::size_t changed =
      distance(piece.first, piece.refined_first) + distance(piece.end, piece.refined_end);
  return static_cast<double>(changed) <= kRefine.few_returns * piece.beams;
}

// The gradient is zero at the maximum of likelihood: the part that is left is that of the returns
// that came or went.
NormalEquations changed(const BeamArray& beams, double gate_squared, const Piece& piece) {
  const auto between = [&](std::size_t first, std::size_t end) {
    return linearise(beams, first, end, piece.line, gate_squared);
  };
  NormalEquations equations;
  equations.information = piece.line.information;
  equations.chi_square = piece.chi_square;
  equations.beams = piece.beams;
  equations += between(piece.first, piece.refined_first);
  equations -= between(piece.refined_first, piece.first);
  equations += between(piece.refined_end, piece.end);
  equations -= between(piece.end, piece.refined_end);
  return equations;
}

}  // namespace

bool refine(const BeamArray& beams, double gate_squared, Piece& piece) {
  if (piece.first == piece.refined_first && piece.end == piece.refined_end) return true;
  if (hasChangedLittle(piece)) {
    const double decrease = take(changed(beams, gate_squared, piece), piece);
    if (decrease >= 0.0 && decrease < kRefine.small_step) return true;
  }
  for (int i = 0; i < kRefine.most_steps; ++i) {
    const double decrease =
        take(linearise(beams, piece.first, piece.end, piece.line, gate_squared), piece);
    if (decrease < 0.0) return false;
    if (decrease < kRefine.small_step) break;
  }
  return true;
}

bool isWall(const Piece& piece, const LineExtractorConfig& config) {
  if (piece.beams < config.min_beams) return false;
  const double limit = geometry::chiSquareLimit(config.gate, piece.beams - 2.0);
  return piece.chi_square <= limit * config.misfit * config.misfit;
}

// Means over blocks of returns show what neighbours share.
SIGHTLINE_VECTOR_CLONES
double unevenness(const BeamArray& beams, double gate_squared, const Piece& piece) {
  const double freedom = piece.beams - 2.0;
  const double alone = piece.chi_square / freedom - kBlocks.chance * std::sqrt(2.0 / freedom);
  const std::size_t block = std::max(kBlocks.fewest, piece.size() / kBlocks.most);
  const std::size_t blocks = piece.size() / block;
  if (blocks < 4) return std::max(1.0, alone);
  const auto gate = static_cast<float>(gate_squared);
  double shared = 0.0;
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t end = k + 1 == blocks ? piece.end : piece.first + (k + 1) * block;
    Packet weight{};
    Packet distance{};
    for (std::size_t i = piece.first + k * block; i < end; i += kLanes) {
      const BeamResiduals of = residualsOf(beams, i, piece.line);
      const Packet taken = of.squared() <= gate ? firstLanes(end - i) : all(0.0F);
      weight += taken * of.weight;
      distance += taken * of.weight * of.distance;
    }
    const double total = sum(weight);
    if (total > 0.0) shared += sum(distance) * sum(distance) / total;
  }
  // What the returns of a block do not share is noise, which may be less than it is taken for.
  const double apart = (piece.chi_square - shared) / (piece.beams - static_cast<double>(blocks));
  const double noise = std::clamp(apart, 0.0, 1.0);
  const double of_blocks = static_cast<double>(blocks) - 2.0;
  const double by_chance = of_blocks + kBlocks.shared_chance * std::sqrt(2.0 * of_blocks);
  return std::max({1.0, alone, 1.0 + kBlocks.share * (shared - noise * by_chance)});
}

double extent(const BeamArray& beams, const Piece& piece) {
  const std::size_t last = piece.end - 1;
  return std::abs(piece.line.alongX() * static_cast<double>(beams.x[last] - beams.x[piece.first]) +
                  piece.line.alongY() * static_cast<double>(beams.y[last] - beams.y[piece.first]));
}

}  // namespace sightline::lines

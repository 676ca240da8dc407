#include "sightline/lines/arc_runs.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

// Chosen: both are wide, as what passes is fitted and judged by its likelihood.
struct ArcRunsConstants {
  // Lines that meet at more than this are no chords of one curve [sine].
  double most_bend = 0.75;
  // Noise alone does not part returns [σ].
  double jump = 8.0;
};
constexpr ArcRunsConstants kRuns{};

// Sine of the turn from one line to the next.
double bend(const Piece& before, const Piece& after) {
  return before.line.normal_x * after.line.normal_y - before.line.normal_y * after.line.normal_x;
}

}  // namespace

ArcRuns::ArcRuns(const LineExtractorConfig& config) : config_(config), gap_(config) {}

void ArcRuns::assign(const BeamArray& beams, const std::vector<Piece>& pieces) {
  beams_ = &beams;
  const bool circle = beams.size > beams.revolution;
  begin_ = circle && !pieces.empty() ? pieces.front().first : 0;
  // The arrays are as long as the scan has beams, whatever came back.
  owners_.reserve(beams.beam.size());
  runs_.reserve(beams.beam.size());
  loose_runs_.reserve(beams.beam.size());
  owners_.assign(beams.revolution, Owner::kNone);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Owner owner = judge(pieces, i);
    if (owner != Owner::kNone) setOwner(pieces[i], owner);
  }
}

ArcRuns::Owner ArcRuns::judge(const std::vector<Piece>& pieces, std::size_t i) const {
  const Piece& piece = pieces[i];
  const double length = extent(*beams_, piece);
  if (!isWall(piece, config_) || length < config_.min_length) return Owner::kNone;
  if (length > 2.0 * config_.max_radius) return Owner::kWall;
  const bool explained =
      piece.chi_square <= geometry::chiSquareLimit(config_.gate, piece.beams - 2.0);
  return explained && !isChord(pieces, i) ? Owner::kWall : Owner::kDoubtfulWall;
}

// Three adjoining lines that bend the same way, of which this is one.
bool ArcRuns::isChord(const std::vector<Piece>& pieces, std::size_t i) const {
  const auto bendAfter = [&](std::size_t k) {
    const bool joins = k + 1 < pieces.size() && mayBeChords(pieces[k], pieces[k + 1]);
    return joins ? bend(pieces[k], pieces[k + 1]) : 0.0;
  };
  for (std::size_t first = i - std::min<std::size_t>(i, 2); first <= i; ++first) {
    if (bendAfter(first) * bendAfter(first + 1) > 0.0) return true;
  }
  return false;
}

bool ArcRuns::mayBeChords(const Piece& before, const Piece& after) const {
  if (std::abs(bend(before, after)) > kRuns.most_bend) return false;
  return !isJump(before.end - 1, after.first);
}

// Returns off the line are on something else, unless they are few.
void ArcRuns::setOwner(const Piece& piece, Owner owner) {
  if (static_cast<double>(piece.size()) - piece.beams < config_.min_arc_beams) {
    return setOwner(piece.first, piece.end, owner);
  }
  const auto gate_squared = static_cast<float>(config_.gate * config_.gate);
  for (std::size_t i = piece.first; i < piece.end; ++i) {
    if (isWithin(*beams_, i, piece.line, gate_squared)) setOwner(i, i + 1, owner);
  }
}

void ArcRuns::setOwner(std::size_t first, std::size_t end, Owner owner) {
  const std::size_t revolution = owners_.size();
  const std::size_t begin = first % revolution;
  const std::size_t count = std::min(end - first, revolution);
  const std::size_t before_seam = std::min(count, revolution - begin);
  std::memset(owners_.data() + begin, static_cast<int>(owner), before_seam);
  std::memset(owners_.data(), static_cast<int>(owner), count - before_seam);
}

const std::vector<Run>& ArcRuns::withDoubtfulWalls() {
  findRuns(begin_, begin_ + owners_.size(), Owner::kDoubtfulWall, runs_);
  const bool circle = beams_->size > beams_->revolution;
  if (circle && runs_.size() > 1 && runs_.front().first == begin_ &&
      runs_.back().end == begin_ + owners_.size() &&
      !isJump(begin_ + owners_.size() - 1, begin_ + owners_.size())) {
    runs_.back().end += runs_.front().size();
    runs_.erase(runs_.begin());
  }
  return runs_;
}

const std::vector<Run>& ArcRuns::withoutWalls(const Run& run) {
  findRuns(run.first, run.end, Owner::kNone, loose_runs_);
  return loose_runs_;
}

void ArcRuns::findRuns(std::size_t first, std::size_t end, Owner most,
                       std::vector<Run>& runs) const {
  runs.clear();
  bool open = false;
  for (std::size_t i = first; i < end; ++i) {
    if (ownerOf(i) > most) {
      open = false;
      i = skipWalls(i, end) - 1;
    } else if (open && !isJump(i - 1, i)) {
      runs.back().end = i + 1;
    } else {
      runs.push_back({i, i + 1});
      open = true;
    }
  }
}

// The first return from `first` on that may be on something else: walls are long, so eight at once.
std::size_t ArcRuns::skipWalls(std::size_t first, std::size_t end) const {
  constexpr std::uint64_t kAllWall = 0x0101010101010101 * static_cast<std::uint64_t>(Owner::kWall);
  const std::size_t revolution = owners_.size();
  std::size_t i = first + 1;
  while (i + sizeof(kAllWall) <= end && i % revolution + sizeof(kAllWall) <= revolution) {
    std::uint64_t owners;
    std::memcpy(&owners, owners_.data() + i % revolution, sizeof(owners));
    if (owners != kAllWall) break;
    i += sizeof(owners);
  }
  return i;
}

// The surface of a circle recedes by no more than √(2 R s) from one beam to the next, s apart
// across the beams.
bool ArcRuns::isJump(std::size_t from, std::size_t to) const {
  if (!gap_.isSmall(*beams_, from, to)) return true;
  const auto value = [](const std::vector<float>& array, std::size_t i) {
    return static_cast<double>(array[i]);
  };
  const double x = value(beams_->x, to);
  const double y = value(beams_->y, to);
  const double dx = x - value(beams_->x, from);
  const double dy = y - value(beams_->y, from);
  const double across =
      std::abs(value(beams_->direction_x, from) * y - value(beams_->direction_y, from) * x);
  const double noise = kRuns.jump * kRuns.jump * value(beams_->range_variance, to);
  return dx * dx + dy * dy > 2.0 * config_.max_radius * across + noise;
}

}  // namespace sightline::lines

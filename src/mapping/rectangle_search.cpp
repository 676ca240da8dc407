#include "sightline/mapping/rectangle_search.h"

#include <algorithm>
#include <cmath>

namespace sightline::mapping {

namespace {

constexpr struct {
  double reach = 10.0;         // from a place to a side that is begun with [m]
  double window = 4.0;         // on either side of a place in which walls speak for a side [m]
  double least_wall = 0.3;     // of such a side [m]
  std::size_t most_sides = 7;  // to each way
  double far = 40.0;           // that a side is moved at most [m]
  std::size_t climbed = 3;     // best combinations of sides that are improved
  // A wall beyond a side [m]: how far, how much of it, and at an end of the side; and its share of
  // what the side itself shows, seen at both ends and at one.
  double deepest = 1.0;
  double least_outer = 0.35;
  double end = 0.5;
  double least_end = 0.2;
  double share_at_both = 0.1;
  double share_at_one = 0.3;
  double step = 0.9;  // between places that a search starts from [m]
} kSearch{};

// Stricter rounds first: what a clear room leaves over is described more laxly.
constexpr DescriptionWeights kWeights[RectangleSearch::kRounds] = {
    {0.7, 0.1, 0.12, 0.25, 2.0, 2.0, 1.0, 2.0},
    {0.5, 0.1, 0.12, 0.2, 1.0, 2.0, 1.0, 0.5},
    {0.3, 0.05, 0.12, 0.15, 0.5, 2.0, 0.5, -0.5},
};

int& sideOf(CellBox& box, int side) {
  return side == 0 ? box.x0 : side == 1 ? box.y0 : side == 2 ? box.x1 : box.y1;
}

}  // namespace

// Lines beyond a place where much wall faces it, nearest first.
std::vector<int> RectangleSearch::sidesOf(int facing, int x, int y) const {
  const bool is_column = facing % 2 == 0;
  const int here = is_column ? x : y;
  const int across = is_column ? y : x;
  const int window = static_cast<int>(kSearch.window / images_.cell());
  const int from = std::max(0, across - window);
  const int to = std::min(is_column ? images_.height() : images_.width(), across + window);
  const int lines = is_column ? images_.width() : images_.height();
  const int step = facing < 2 ? -1 : 1;
  const int reach = static_cast<int>(kSearch.reach / images_.cell());
  std::vector<std::pair<double, int>> peaks;
  for (int i = 1; i < reach; ++i) {
    const int line = here + i * step;
    if (line < 1 || line + 1 >= lines) break;
    const double wall = score_.wall(facing, line, from, to);
    if (wall < kSearch.least_wall || wall < score_.wall(facing, line - 1, from, to) ||
        wall <= score_.wall(facing, line + 1, from, to)) {
      continue;
    }
    peaks.emplace_back(-wall, line);
  }
  std::sort(peaks.begin(), peaks.end());
  if (peaks.size() > kSearch.most_sides) peaks.resize(kSearch.most_sides);
  std::vector<int> found;
  for (const auto& [wall, line] : peaks) found.push_back(facing < 2 ? line + 1 : line);
  if (found.empty()) found.push_back(here + step * static_cast<int>(1.0 / images_.cell()));
  return found;
}

RectangleSearch::Candidate RectangleSearch::best(const Eigen::Vector2d& place) const {
  const int x = static_cast<int>(place.x());
  const int y = static_cast<int>(place.y());
  std::array<std::vector<int>, kFacings> lines;
  for (int f = 0; f < kFacings; ++f) lines[static_cast<std::size_t>(f)] = sidesOf(f, x, y);
  std::vector<Candidate> all;
  for (const int x0 : lines[0]) {
    for (const int y0 : lines[1]) {
      for (const int x1 : lines[2]) {
        for (const int y1 : lines[3]) {
          const CellBox box{x0, y0, x1, y1};
          if (score_.fits(box)) all.push_back({box, score_.of(box)});
        }
      }
    }
  }
  if (all.empty()) return {{}, -1e9};
  const auto better = [](const Candidate& a, const Candidate& b) { return a.score > b.score; };
  const std::size_t kept = std::min(all.size(), kSearch.climbed);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end(),
                    better);
  all.resize(kept);
  for (Candidate& candidate : all) climb(candidate, place);
  const Candidate whole = *std::min_element(all.begin(), all.end(), better);
  return split(whole, place);
}

void RectangleSearch::climb(Candidate& candidate, const Eigen::Vector2d& place) const {
  for (int round = 0; round < 8; ++round) {
    bool moved = false;
    for (int side = 0; side < 4; ++side) moved = moveSide(candidate, side, place) || moved;
    if (!moved) return;
  }
}

// The place stays inside.
bool RectangleSearch::moveSide(Candidate& candidate, int side, const Eigen::Vector2d& place) const {
  const int reach = static_cast<int>(kSearch.far / images_.cell());
  Candidate best = candidate;
  for (int i = -reach; i <= reach; ++i) {
    CellBox box = candidate.box;
    sideOf(box, side) += i;
    if (!score_.fits(box) || !box.contains(place)) continue;
    const double here = score_.of(box);
    if (here > best.score + 1e-6) best = {box, here};
  }
  const bool moved = best.score > candidate.score;
  candidate = best;
  return moved;
}

// Part of a rectangle that holds the place, where two parts explain more than the whole.
RectangleSearch::Candidate RectangleSearch::split(const Candidate& whole,
                                                  const Eigen::Vector2d& place) const {
  double most = whole.score;
  Candidate part = whole;
  for (const int axis : {0, 1}) {
    const int from = axis == 0 ? whole.box.x0 : whole.box.y0;
    const int to = axis == 0 ? whole.box.x1 : whole.box.y1;
    for (int cut = from; cut < to; ++cut) {
      for (const int gap : {2, 3, 4, 6, 8}) {
        Candidate low = whole;
        Candidate high = whole;
        sideOf(low.box, axis + 2) = cut;
        sideOf(high.box, axis) = cut + gap;
        if (!score_.fits(low.box) || !score_.fits(high.box)) continue;
        low.score = score_.of(low.box);
        high.score = score_.of(high.box);
        if (low.score + high.score <= most) continue;
        most = low.score + high.score;
        part = place[axis] < cut + 0.5 * gap ? low : high;
      }
    }
  }
  if (most <= whole.score) return whole;
  if (!part.box.contains(place)) return {part.box, -1e9};
  return split(part, place);
}

void RectangleSearch::begin(int round) {
  score_.weigh(kWeights[round]);
  seeds_.clear();
  for (const Eigen::Vector2d& place : places_) {
    const bool is_new = std::none_of(seeds_.begin(), seeds_.end(), [&](const Seed& seed) {
      return (seed.place - place).norm() * images_.cell() < kSearch.step;
    });
    if (is_new) seeds_.push_back({place, {}});
  }
}

std::vector<RectangleSearch::Seed>::iterator RectangleSearch::leader() {
  for (Seed& seed : seeds_) {
    if (!seed.is_known) seed.best = best(seed.place);
    seed.is_known = true;
  }
  return std::max_element(seeds_.begin(), seeds_.end(),
                          [](const Seed& a, const Seed& b) { return a.best.score < b.best.score; });
}

std::optional<double> RectangleSearch::bestScore() {
  const auto first = leader();
  if (first == seeds_.end() || first->best.score < score_.weights().least_score) {
    return std::nullopt;
  }
  return first->best.score;
}

CellBox RectangleSearch::takeBest() {
  const CellBox room = leader()->best.box;
  score_.take(room);
  leave([&](const Eigen::Vector2d& place) { return room.contains(place); });
  for (Seed& seed : seeds_) seed.is_known = seed.is_known && !seed.best.box.overlaps(room);
  return room;
}

void RectangleSearch::giveAway(const std::function<bool(const Eigen::Vector2d&)>& holds) {
  score_.take(holds);
  leave(holds);
  for (Seed& seed : seeds_) seed.is_known = false;
}

void RectangleSearch::leave(const std::function<bool(const Eigen::Vector2d&)>& holds) {
  seeds_.erase(std::remove_if(seeds_.begin(), seeds_.end(),
                              [&](const Seed& seed) { return holds(seed.place); }),
               seeds_.end());
  places_.erase(std::remove_if(places_.begin(), places_.end(), holds), places_.end());
}

void RectangleSearch::pushOut(CellBox& box) const {
  for (int side = 0; side < 4; ++side) pushOut(box, side);
}

// What a line of a side shows, cell by cell, of the wall that lies so far beyond.
RectangleSearch::Beyond RectangleSearch::lookBeyond(const CellBox& box, int side, int far) const {
  const bool is_column = side % 2 == 0;
  const int outwards = side < 2 ? -1 : 1;
  const int line = side == 0 ? box.x0 - 1 : side == 1 ? box.y0 - 1 : side == 2 ? box.x1 : box.y1;
  const int from = is_column ? box.y0 : box.x0;
  const int to = is_column ? box.y1 : box.x1;
  const int end = static_cast<int>(kSearch.end / images_.cell());
  const auto isWallAt = [&](int at, int i) {
    for (const int near : {0, -1, 1}) {
      const int x = is_column ? at + near : i;
      const int y = is_column ? i : at + near;
      if (images_.isInside(x, y) && images_.isWall(side, x, y)) return true;
    }
    return false;
  };
  Beyond beyond;
  for (int i = from; i < to; ++i) {
    if (isWallAt(line, i)) {
      ++beyond.inner;
      continue;
    }
    if (!isWallAt(line + far * outwards, i)) continue;
    int free = 0;
    for (int j = 0; j < far - 1; ++j) {
      const int x = is_column ? line + j * outwards : i;
      const int y = is_column ? i : line + j * outwards;
      free += images_.isFree(x, y) && !score_.isUsed(x, y) ? 1 : 0;
    }
    if (free < 0.7 * (far - 1)) continue;
    ++beyond.outer;
    if (i < from + end) ++beyond.first;
    if (i >= to - end) ++beyond.last;
  }
  return beyond;
}

// A side lies on furniture where the wall is seen beyond it, at its ends.
void RectangleSearch::pushOut(CellBox& box, int side) const {
  const int reach = static_cast<int>(kSearch.deepest / images_.cell());
  const int least_end = static_cast<int>(kSearch.least_end / images_.cell());
  int best = 0;
  int most = static_cast<int>(kSearch.least_outer / images_.cell());
  for (int far = 3; far <= reach; ++far) {
    CellBox moved = box;
    sideOf(moved, side) += side < 2 ? -far : far;
    if (!score_.fits(moved)) break;
    const Beyond beyond = lookBeyond(box, side, far);
    const int ends = (beyond.first >= least_end ? 1 : 0) + (beyond.last >= least_end ? 1 : 0);
    const double share = ends == 2 ? kSearch.share_at_both : kSearch.share_at_one;
    if (ends == 0 || beyond.outer < share * beyond.inner || beyond.outer <= most) continue;
    most = beyond.outer;
    best = far;
  }
  sideOf(box, side) += side < 2 ? -best : best;
}

}  // namespace sightline::mapping

#include "polygon_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "sightline/world/room_map.h"

namespace sightline::mapping {

namespace {

using Spot = Eigen::Vector2d;

constexpr struct {
  double tolerance = 0.08;  // of a point from its side: images and paths are off by that [m]
  double gap = 0.5;         // between neighbouring looks on one surface [m]
  double shortest = 0.35;   // side [m]
  double straight = 0.06;   // turn between two sides that may be one [rad]
  double offset = 0.06;     // between them [m]
  double parallel = 0.03;   // sides that turn by less have no corner [rad]
  double corner = 0.35;     // from where a side ends to where it meets the next, at most [m]
} kFit{};

// A side in the making: between two points, along points that lie on it, if any.
struct Piece {
  Spot start;
  Spot end;
  std::vector<Spot> points;
  Spot along = Spot::UnitX();
  Spot middle = Spot::Zero();
  double bend = 0.0;
  double curvature = 0.0;

  double length() const { return along.dot(end - start); }
  Spot inwards() const { return {-along.y(), along.x()}; }
  double turnTo(const Piece& next) const {
    return std::atan2(along.x() * next.along.y() - along.y() * next.along.x(),
                      along.dot(next.along));
  }
};

Piece chord(const Spot& start, const Spot& end) {
  return {start, end, {}, (end - start).normalized(), 0.5 * (start + end)};
}

// Curvature of points along a line, of the parabola through them.
double curvatureOf(const Piece& piece) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Identity() * 1e-9;
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  for (const Spot& p : piece.points) {
    const double at = piece.along.dot(p - piece.middle);
    const Eigen::Vector3d powers(1.0, at, at * at);
    squares += powers * powers.transpose();
    products += piece.inwards().dot(p - piece.middle) * powers;
  }
  return 2.0 * squares.ldlt().solve(products)[2];
}

// The line that fits the points best, from the first to the last of them.
Piece lineThrough(std::vector<Spot> points) {
  Spot mean = Spot::Zero();
  for (const Spot& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Spot& p : points) {
    scatter += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
  }
  const double turn = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  Spot along(std::cos(turn), std::sin(turn));
  if (along.dot(points.back() - points.front()) < 0.0) along = -along;
  Piece piece;
  piece.along = along;
  piece.middle = mean;
  piece.start = mean + along.dot(points.front() - mean) * along;
  piece.end = mean + along.dot(points.back() - mean) * along;
  piece.bend = std::sqrt(std::max(0.0, piece.inwards().dot(scatter * piece.inwards())));
  piece.points = std::move(points);
  piece.curvature = curvatureOf(piece);
  return piece;
}

using Pieces = std::vector<Piece>;

// Splits points where they are farthest from the line that joins their ends, until none is far;
// points all around, whose ends are one, where they are farthest from these.
void splitFar(const std::vector<Spot>& points, std::size_t first, std::size_t last,
              Pieces& pieces) {
  const Piece line = chord(points[first], points[last]);
  const bool is_round = (line.end - line.start).norm() < kFit.shortest;
  double most = kFit.tolerance;
  std::size_t at = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Spot from_start = points[i] - line.start;
    const double off = is_round ? from_start.norm() : std::abs(line.inwards().dot(from_start));
    if (off > most) at = i;
    most = std::max(most, off);
  }
  if (at != first) {
    splitFar(points, first, at, pieces);
    splitFar(points, at, last, pieces);
    return;
  }
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
  pieces.push_back(lineThrough({begin, points.begin() + static_cast<std::ptrdiff_t>(last) + 1}));
}

bool goesOn(const OutlinePoint& a, const OutlinePoint& b) {
  return a.end == LookEnd::kSolid && b.end == LookEnd::kSolid && !a.opens_after &&
         (a.place - b.place).norm() < kFit.gap;
}

// Surfaces of an outline, each as its points; the first begins where one begins, if any does.
std::vector<std::vector<Spot>> surfacesOf(const std::vector<OutlinePoint>& outline) {
  const std::size_t n = outline.size();
  std::size_t begin = 0;
  while (begin < n && goesOn(outline[(begin + n - 1) % n], outline[begin])) ++begin;
  std::vector<std::vector<Spot>> surfaces;
  for (std::size_t i = 0; i < n; ++i) {
    const OutlinePoint& here = outline[(begin + i) % n];
    if (here.end != LookEnd::kSolid) continue;
    const OutlinePoint& before = outline[(begin + i + n - 1) % n];
    if (surfaces.empty() || i == 0 || !goesOn(before, here)) surfaces.emplace_back();
    surfaces.back().push_back(here.place);
  }
  return surfaces;
}

Pieces piecesOf(const std::vector<OutlinePoint>& outline) {
  Pieces pieces;
  for (const auto& points : surfacesOf(outline)) {
    const bool is_speck = std::all_of(points.begin(), points.end(), [&](const Spot& p) {
      return (p - points.front()).norm() < kFit.shortest;
    });
    if (!is_speck) splitFar(points, 0, points.size() - 1, pieces);
  }
  return pieces;
}

std::size_t after(const Pieces& pieces, std::size_t i) {
  return (i + 1) % pieces.size();
}

void closeGaps(Pieces& pieces) {
  Pieces closed;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    closed.push_back(pieces[i]);
    const Spot& next = pieces[after(pieces, i)].start;
    if ((next - pieces[i].end).norm() > kFit.shortest) {
      closed.push_back(chord(pieces[i].end, next));
    }
  }
  pieces = std::move(closed);
}

bool isOneLine(const Piece& a, const Piece& b) {
  return std::abs(a.turnTo(b)) < kFit.straight &&
         std::abs(a.inwards().dot(b.middle - a.middle)) < kFit.offset &&
         std::abs(b.inwards().dot(a.middle - b.middle)) < kFit.offset;
}

Piece joined(const Piece& a, const Piece& b) {
  std::vector<Spot> points = a.points;
  points.insert(points.end(), b.points.begin(), b.points.end());
  Piece piece = points.size() < 2 ? chord(a.start, b.end) : lineThrough(std::move(points));
  piece.start = piece.middle + piece.along.dot(a.start - piece.middle) * piece.along;
  piece.end = piece.middle + piece.along.dot(b.end - piece.middle) * piece.along;
  return piece;
}

// A wall goes on behind an opening: what lies between two pieces of a line is of their side.
bool joinAcross(Pieces& pieces) {
  for (std::size_t i = 0; i < pieces.size() && pieces.size() > 3; ++i) {
    std::rotate(pieces.begin(), pieces.begin() + 1, pieces.end());
    const std::size_t over = pieces[1].points.empty() ? 2 : 1;
    const auto second = pieces.begin() + static_cast<std::ptrdiff_t>(over);
    for (const auto& next : {pieces.begin() + 1, second}) {
      if (!isOneLine(pieces.front(), *next)) continue;
      pieces.front() = joined(pieces.front(), *next);
      pieces.erase(pieces.begin() + 1, next + 1);
      return true;
    }
  }
  return false;
}

Spot cornerOf(const Piece& a, const Piece& b) {
  const double cross = a.along.x() * b.along.y() - a.along.y() * b.along.x();
  const Spot off = b.middle - a.middle;
  return a.middle + (off.x() * b.along.y() - off.y() * b.along.x()) / cross * a.along;
}

bool meet(const Piece& a, const Piece& b) {
  if (std::abs(std::sin(a.turnTo(b))) < kFit.parallel) return false;
  const Spot corner = cornerOf(a, b);
  return (corner - a.end).norm() < kFit.corner && (corner - b.start).norm() < kFit.corner;
}

// Short pieces go where their neighbours meet without them.
void dropShort(Pieces& pieces) {
  for (std::size_t i = 0; i < pieces.size() && pieces.size() > 4;) {
    const Piece& before = pieces[(i + pieces.size() - 1) % pieces.size()];
    const bool is_short = pieces[i].length() < kFit.shortest;
    if (is_short && meet(before, pieces[after(pieces, i)])) {
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

// Sides between neighbours that have no corner in common.
void connect(Pieces& pieces) {
  Pieces connected;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    connected.push_back(pieces[i]);
    const Piece& next = pieces[after(pieces, i)];
    if (!meet(pieces[i], next)) connected.push_back(chord(pieces[i].end, next.start));
  }
  pieces = std::move(connected);
}

RoomOutline roomOf(const Pieces& pieces) {
  RoomOutline room;
  for (const Piece& piece : pieces) {
    room.anchor += 0.5 * (piece.start + piece.end) / static_cast<double>(pieces.size());
  }
  for (const Piece& piece : pieces) {
    SideLine side;
    side.angle = std::atan2(piece.inwards().y(), piece.inwards().x());
    side.distance = side.normal().dot(piece.middle - room.anchor);
    side.bend = piece.bend;
    side.curvature = piece.curvature;
    room.sides.push_back(side);
  }
  room.spans.resize(room.sides.size());
  return room;
}

// Whether each side lies about where its piece lay.
bool isAlong(const RoomOutline& room, const Pieces& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const geometry::Segment side = room.side(i);
    if (!(side.length() > 0.05) || side.direction().dot(pieces[i].along) < 0.9) return false;
    if ((side.start - pieces[i].start).norm() > 2.0 * kFit.corner) return false;
  }
  return true;
}

}  // namespace

std::optional<RoomOutline> polygonAlong(const std::vector<OutlinePoint>& outline) {
  Pieces pieces = piecesOf(outline);
  if (pieces.size() < 2) return std::nullopt;
  closeGaps(pieces);
  while (joinAcross(pieces)) {
  }
  dropShort(pieces);
  connect(pieces);
  if (pieces.size() < 3) return std::nullopt;
  RoomOutline room = roomOf(pieces);
  if (!isAlong(room, pieces) || !isRoom(room)) return std::nullopt;
  return room;
}

}  // namespace sightline::mapping

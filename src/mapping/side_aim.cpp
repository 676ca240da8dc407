#include "sightline/mapping/side_aim.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double piece = 0.1;       // of a side [m]
  double row = 0.01;        // of distances from it [m]
  double reach = 0.2;       // of what is taken for a side or a thing before it [m]
  double on_line = 0.025;   // of a line: noise of scanners and path [m]
  double facing = 0.94;     // least cosine between the normals of a point and of the side
  double fewest = 6.0;      // points that a piece needs to be heard
  double most_turn = 0.03;  // away from the room [rad]
  double turn_step = 0.002;
  // Walls of buildings are out of square by so much [rad]; a turn of that costs this length [m].
  double usual_turn = 0.01;
  double turn_cost = 0.05;
  double gain = 0.15;  // of length that a side is moved for [m]
} kAim{};

struct AimedLine {
  double offset = 0.0;  // of the middle of the side, inwards [m]
  double turn = 0.0;    // [rad]
};

// Points about a side: pieces along it by rows of distance from it, as sums over the rows.
class SideProfile {
 public:
  explicit SideProfile(const geometry::Segment& side)
      : side_(side),
        normal_(side.leftNormal()),
        direction_(side.direction()),
        length_(side.length()) {
    pieces_.assign(static_cast<std::size_t>(std::max(1.0, std::round(length_ / kAim.piece))),
                   std::vector<double>(kRows + 1, 0.0));
  }

  void take(const Eigen::Vector2d& place, const Eigen::Vector2d& facing) {
    const Eigen::Vector2d off = place - side_.start;
    const double distance = normal_.dot(off);
    if (std::abs(distance) >= kAim.reach || normal_.dot(facing) < kAim.facing) return;
    const double along = direction_.dot(off) / length_;
    if (along < 0.0 || along >= 1.0) return;
    const auto piece = static_cast<std::size_t>(along * static_cast<double>(pieces_.size()));
    pieces_[piece][rowOf(distance) + 1] += 1.0;
  }

  void sum() {
    for (auto& piece : pieces_) {
      for (std::size_t row = 1; row < piece.size(); ++row) piece[row] += piece[row - 1];
    }
  }

  // Length that lies on a line.
  double lengthOn(const AimedLine& line) const {
    double length = 0.0;
    const double piece = length_ / static_cast<double>(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const double all = pieces_[i].back();
      if (all < kAim.fewest) continue;
      const double along = (static_cast<double>(i) + 0.5) * piece - 0.5 * length_;
      const double at = line.offset + along * std::tan(line.turn);
      if (std::abs(at) >= kAim.reach) continue;
      const double on =
          pieces_[i][rowOf(at + kAim.on_line) + 1] - pieces_[i][rowOf(at - kAim.on_line)];
      length += piece * on / all;
    }
    return length;
  }

 private:
  static constexpr std::size_t kRows = 40;
  static std::size_t rowOf(double distance) {
    const double row = std::floor((distance + kAim.reach) / kAim.row);
    return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(kRows - 1)));
  }

  geometry::Segment side_;
  Eigen::Vector2d normal_;
  Eigen::Vector2d direction_;
  double length_;
  std::vector<std::vector<double>> pieces_;
};

double worth(const SideProfile& profile, const AimedLine& line, double room_turn) {
  const double off = (line.turn - room_turn) / kAim.usual_turn;
  return profile.lengthOn(line) - kAim.turn_cost * off * off;
}

// @param room_turn  from the side as it is to the direction of its room
AimedLine best(const SideProfile& profile, double room_turn) {
  AimedLine line;
  double most = worth(profile, line, room_turn) + kAim.gain;
  for (double turn = -kAim.most_turn; turn <= kAim.most_turn; turn += kAim.turn_step) {
    for (double offset = -0.5 * kAim.reach; offset <= 0.5 * kAim.reach; offset += kAim.row) {
      const AimedLine tried{offset, room_turn + turn};
      const double here = worth(profile, tried, room_turn);
      if (here <= most || profile.lengthOn(tried) < kAim.gain) continue;
      line = tried;
      most = here;
    }
  }
  return line;
}

// The side through its middle, moved inwards and turned there.
void aim(const AimedLine& line, const Eigen::Vector2d& middle, RoomOutline& room, std::size_t i) {
  SideLine& side = room.sides[i];
  const Eigen::Vector2d moved = middle + line.offset * side.normal();
  side.angle = geometry::wrapAngle(side.angle + line.turn);
  side.distance = side.normal().dot(moved - room.anchor);
}

}  // namespace

void aimSides(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses,
              const std::vector<RoomOutline>& found, std::vector<RoomOutline>& rooms) {
  std::vector<SideProfile> profiles;
  for (const RoomOutline& room : rooms) {
    for (std::size_t i = 0; i < room.sides.size(); ++i) profiles.emplace_back(room.side(i));
  }
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const Eigen::Matrix2d rotation = poses[k].rotation();
    for (const auto& point : keys[k].surfaces.points) {
      if (!point.hasNormal()) continue;
      const Eigen::Vector2d place = rotation * point.position + poses[k].translation();
      const Eigen::Vector2d facing = rotation * point.normal;
      for (SideProfile& profile : profiles) profile.take(place, facing);
    }
  }
  std::size_t at = 0;
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    const RoomOutline before = rooms[r];
    const bool is_square = isSquare(found[r]);
    for (std::size_t i = 0; i < before.sides.size(); ++i) {
      SideProfile& profile = profiles[at++];
      if (!is_square) continue;
      profile.sum();
      const double room_turn = geometry::wrapAngle(found[r].sides[i].angle - before.sides[i].angle);
      aim(best(profile, room_turn), before.side(i).midpoint(), rooms[r], i);
    }
  }
}

}  // namespace sightline::mapping

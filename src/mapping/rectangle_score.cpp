#include "sightline/mapping/rectangle_score.h"

namespace sightline::mapping {

namespace {

constexpr struct {
  double least_size = 0.8;  // of a room [m]
  double thickest = 0.3;    // wall between two rooms [m]
  double run = 0.65;        // wall this long is more than a thing that stands about [m]
  double run_share = 0.6;   // of that which has to be seen
} kScore{};

}  // namespace

RectangleScore::RectangleScore(const FacingImages& images) : images_(images) {
  used_.assign(static_cast<std::size_t>(images.width()) * static_cast<std::size_t>(images.height()),
               0);
  findDividers();
}

void RectangleScore::weigh(const DescriptionWeights& weights) {
  weights_ = weights;
  sumSides();
  sumArea();
}

// A side that faces +x is the line before the box's x0: a column, whose sums run along y.
void RectangleScore::sumSides() {
  for (int f = 0; f < kFacings; ++f) {
    const bool is_column = f % 2 == 0;
    const int lines = is_column ? images_.width() : images_.height();
    const int length = is_column ? images_.height() : images_.width();
    for (LineSums* sums :
         {&sides_[static_cast<std::size_t>(f)], &lengths_[static_cast<std::size_t>(f)]}) {
      sums->length = length;
      sums->sums.clear();
      sums->sums.reserve(static_cast<std::size_t>(lines) * (static_cast<std::size_t>(length) + 1));
    }
    for (int line = 0; line < lines; ++line) {
      double gain = 0.0;
      double wall = 0.0;
      sides_[static_cast<std::size_t>(f)].sums.push_back(0.0F);
      lengths_[static_cast<std::size_t>(f)].sums.push_back(0.0F);
      for (int i = 0; i < length; ++i) {
        const int x = is_column ? line : i;
        const int y = is_column ? i : line;
        gain += images_.cell() * sideGain(f, x, y);
        wall += images_.isWall(f, x, y) ? images_.cell() : 0.0;
        sides_[static_cast<std::size_t>(f)].sums.push_back(static_cast<float>(gain));
        lengths_[static_cast<std::size_t>(f)].sums.push_back(static_cast<float>(wall));
      }
    }
  }
}

double RectangleScore::sideGain(int facing, int x, int y) const {
  const int dx = facing % 2 == 0 ? 1 : 0;
  const int dy = 1 - dx;
  for (const int i : {0, -1, 1}) {
    if (!images_.isInside(x + i * dx, y + i * dy)) continue;
    if (images_.isWall(facing, x + i * dx, y + i * dy)) return i == 0 ? 1.0 : 0.8;
  }
  if (images_.isFree(x, y)) return -weights_.open;
  return -weights_.unseen;
}

void RectangleScore::sumArea() {
  const auto width = static_cast<std::size_t>(images_.width());
  area_.assign((width + 1) * (static_cast<std::size_t>(images_.height()) + 1), 0.0);
  for (int y = 0; y < images_.height(); ++y) {
    double row = 0.0;
    for (int x = 0; x < images_.width(); ++x) {
      row += cellGain(x, y);
      const std::size_t above =
          static_cast<std::size_t>(y) * (width + 1) + static_cast<std::size_t>(x) + 1;
      area_[above + width + 1] = area_[above] + row;
    }
  }
}

double RectangleScore::cellGain(int x, int y) const {
  const double cell = images_.cell();
  const std::size_t at = cellAt(x, y);
  double gain = 0.0;
  if (images_.isFree(x, y)) gain += weights_.free_area;
  if (!images_.isKnown(x, y)) gain -= weights_.unseen_area;
  if (used_[at] != 0) gain -= weights_.used_area;
  gain *= cell * cell;
  gain -= weights_.divider * cell * dividers_[at];
  return gain;
}

bool RectangleScore::hasTwoFaces(int facing, int x, int y) const {
  if (!images_.isInside(x, y) || !images_.isWall(facing, x, y)) return false;
  const int dx = facing == 0 ? -1 : 0;
  const int dy = facing == 1 ? -1 : 0;
  const int thickest = static_cast<int>(kScore.thickest / images_.cell());
  for (int i = 0; i <= thickest; ++i) {
    const int bx = x + i * dx;
    const int by = y + i * dy;
    if (images_.isInside(bx, by) && images_.isWall(facing + 2, bx, by)) return true;
  }
  return false;
}

// Walls seen from both sides over some length: they stand between rooms.
void RectangleScore::findDividers() {
  dividers_.assign(used_.size(), 0);
  const int half = static_cast<int>(0.5 * kScore.run / images_.cell());
  const double least = kScore.run_share * (2 * half + 1);
  for (const int f : {0, 1}) {
    std::vector<std::uint8_t> faces(used_.size(), 0);
    std::size_t at = 0;
    for (int y = 0; y < images_.height(); ++y) {
      for (int x = 0; x < images_.width(); ++x) faces[at++] = hasTwoFaces(f, x, y) ? 1 : 0;
    }
    const std::ptrdiff_t across = f == 0 ? 1 : images_.width();
    const std::ptrdiff_t along = f == 0 ? images_.width() : 1;
    const auto cells = static_cast<std::ptrdiff_t>(faces.size());
    for (std::ptrdiff_t i = 0; i < cells; ++i) {
      if (faces[static_cast<std::size_t>(i)] == 0) continue;
      int run = 0;
      for (std::ptrdiff_t j = -half; j <= half; ++j) {
        const auto is_face = [&](std::ptrdiff_t k) {
          return k >= 0 && k < cells && faces[static_cast<std::size_t>(k)] != 0;
        };
        const std::ptrdiff_t k = i + j * along;
        run += is_face(k) || is_face(k - across) || is_face(k + across) ? 1 : 0;
      }
      if (run >= least) ++dividers_[static_cast<std::size_t>(i)];
    }
  }
}

double RectangleScore::area(const CellBox& box) const {
  const auto at = [&](int x, int y) {
    return area_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(images_.width()) + 1) +
                 static_cast<std::size_t>(x)];
  };
  return at(box.x1, box.y1) - at(box.x0, box.y1) - at(box.x1, box.y0) + at(box.x0, box.y0);
}

// The lines of its sides lie just outside.
bool RectangleScore::fits(const CellBox& box) const {
  const int least = static_cast<int>(kScore.least_size / images_.cell());
  return box.x0 > 0 && box.y0 > 0 && box.x1 < images_.width() && box.y1 < images_.height() &&
         box.x1 - box.x0 >= least && box.y1 - box.y0 >= least;
}

double RectangleScore::of(const CellBox& box) const {
  return sides_[0].between(box.x0 - 1, box.y0, box.y1) +
         sides_[1].between(box.y0 - 1, box.x0, box.x1) + sides_[2].between(box.x1, box.y0, box.y1) +
         sides_[3].between(box.y1, box.x0, box.x1) + area(box) - weights_.room;
}

void RectangleScore::take(const CellBox& box) {
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      used_[cellAt(x, y)] = 1;
    }
  }
  sumArea();
}

void RectangleScore::take(const std::function<bool(const Eigen::Vector2d&)>& holds) {
  for (int y = 0; y < images_.height(); ++y) {
    for (int x = 0; x < images_.width(); ++x) {
      if (holds(Eigen::Vector2d(x + 0.5, y + 0.5))) used_[cellAt(x, y)] = 1;
    }
  }
  sumArea();
}

}  // namespace sightline::mapping

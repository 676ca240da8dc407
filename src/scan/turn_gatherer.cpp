#include "sightline/scan/turn_gatherer.h"

#include <cmath>
#include <utility>

#include "sightline/geometry/angle.h"

namespace sightline::scan {

namespace {

constexpr double kWholeTurn = 2.0 * geometry::kPi;
// Increments between the end of a part and the beginning of the next.
constexpr double kSeam = 3.0;
// Time that a turn takes at most [ns]: parts farther apart belong to different ones.
constexpr std::int64_t kLongestTurn = 2'000'000'000;

}  // namespace

// The angle as it goes on from the last one in the sense of the scanner, or a little before that
// where two parts overlap.
double TurnGatherer::angleOnFrom(double last, double angle) const {
  const double sense = before_->angleIncrement() > 0.0 ? 1.0 : -1.0;
  double step = std::fmod(sense * (angle - last), kWholeTurn);
  if (step < 0.0) step += kWholeTurn;
  if (step > kWholeTurn - kSeam * std::abs(before_->angleIncrement())) step -= kWholeTurn;
  return last + sense * step;
}

bool TurnGatherer::follows(const Scan& sweep) const {
  const ScanGeometry& next = *sweep.geometry();
  if (!before_ || before_->beams() < 2 || next.beams() < 2) return false;
  const double seam = kSeam * std::abs(before_->angleIncrement());
  const double gap =
      std::abs(geometry::wrapAngle(next.angles().front() - before_->angles().back()));
  const double moved =
      std::abs(geometry::wrapAngle(next.angles().front() - before_->angles().front()));
  return gap < seam && moved > seam &&
         (next.angleIncrement() > 0.0) == (before_->angleIncrement() > 0.0);
}

std::optional<Scan> TurnGatherer::add(const Scan& sweep) {
  const bool begins_alike =
      before_ && before_->angles().front() == sweep.geometry()->angles().front();
  if (begins_alike) {
    gathers_ = false;
    first_.reset();
  } else if (follows(sweep)) {
    gathers_ = true;
  }
  before_ = sweep.geometry();
  if (!gathers_) return sweep;
  return gather(sweep);
}

std::optional<Scan> TurnGatherer::gather(const Scan& sweep) {
  std::optional<Scan> whole;
  if (first_) {
    const double begin = angleOnFrom(angles_.back(), sweep.geometry()->angles().front());
    const std::int64_t elapsed = sweep.stamp - first_->stamp;
    const bool is_next = std::abs(begin - angles_.front()) < kWholeTurn - 1e-6 && elapsed > 0 &&
                         elapsed < kLongestTurn;
    if (!is_next) whole = finish();
  }
  append(sweep);
  const double covered = std::abs(angles_.back() - angles_.front());
  const double increment = std::abs(before_->angleIncrement());
  return !whole && covered > kWholeTurn - 1.5 * increment ? finish() : whole;
}

bool TurnGatherer::isFarther(double angle) const {
  const double so_far = std::abs(angles_.back() - angles_.front());
  const double covered = std::abs(angle - angles_.front());
  return covered > so_far && covered < kWholeTurn - 1e-6;
}

// Beams that a part has in common with the one before, and those beyond a turn, are left out.
void TurnGatherer::append(const Scan& sweep) {
  if (!first_) first_ = sweep;
  const double since_first = 1e-9 * static_cast<double>(sweep.stamp - first_->stamp);
  for (std::size_t i = 0; i < sweep.beams(); ++i) {
    const double angle = sweep.geometry()->angles()[i];
    const double on = angles_.empty() ? angle : angleOnFrom(angles_.back(), angle);
    if (!angles_.empty() && !isFarther(on)) continue;
    angles_.push_back(on);
    offsets_.push_back(since_first + sweep.geometry()->timeOffsets()[i]);
    ranges_.push_back(sweep.ranges()[i]);
  }
}

std::optional<Scan> TurnGatherer::finish() {
  const Scan first = *std::exchange(first_, std::nullopt);
  const auto geometry =
      std::make_shared<ScanGeometry>(std::exchange(angles_, {}), std::exchange(offsets_, {}),
                                     first.geometry()->rangeMin(), first.geometry()->rangeMax());
  Scan turn(geometry, first.stamp, std::exchange(ranges_, {}));
  turn.frame = first.frame;
  return turn;
}

}  // namespace sightline::scan

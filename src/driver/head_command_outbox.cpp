#include "sightline/driver/head_command_outbox.h"

#include <limits>

namespace sightline::driver {

namespace {

constexpr std::int64_t kBetweenCommands = 20'000'000;     // [ns]: faster than any servo answers
constexpr std::int64_t kFirstRepetition = 100'000'000;    // [ns]; each pause is twice the last
constexpr std::int64_t kCommandPatience = 1'000'000'000;  // [ns]

// Since it was sent last.
std::int64_t pauseAfter(int times_sent) {
  return times_sent == 0 ? kBetweenCommands : kFirstRepetition << (times_sent - 1);
}

}  // namespace

void HeadCommandOutbox::give(const motion::HeadCommand& command, std::int64_t now) {
  pending_ = Pending{{command}, now, 0};
  sequence_.reset();
}

void HeadCommandOutbox::dropLost(std::int64_t now) {
  if (!pending_ || now - pending_->given <= kCommandPatience) return;
  ++counts_.lost;
  pending_.reset();
}

std::optional<HeadTarget> HeadCommandOutbox::due(std::int64_t now) {
  dropLost(now);
  if (!pending_) return std::nullopt;
  if (now - last_sent_ < pauseAfter(pending_->times_sent)) return std::nullopt;
  ++pending_->times_sent;
  last_sent_ = now;
  return pending_->target;
}

void HeadCommandOutbox::take(const Acknowledgement& answer) {
  const bool is_of_pending = pending_ && answer.command == FrameKind::kHeadTarget && sequence_ &&
                             answer.sequence == *sequence_;
  if (!is_of_pending) return;
  if (answer.result != CommandResult::kDone) ++counts_.refused;
  pending_.reset();
}

}  // namespace sightline::driver

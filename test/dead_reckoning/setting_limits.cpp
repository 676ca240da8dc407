#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/dead_reckoner.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

enum class End { kLeast, kMost };

std::string nameOf(Method method) {
  return method == Method::kSubmap      ? "submap"
         : method == Method::kPoseSpace ? "pose_space"
                                        : "histogram";
}

/// Puts one field of a configuration that a method reads, or all of all methods, to an end of its
/// range.
class EndSetter : public config::FieldVisitor {
 public:
  static constexpr int kAll = -1;
  EndSetter(Method method, int field, End end)
      : method_(nameOf(method)), wanted_(field), end_(end) {}

  int fields() const { return count_; }
  const std::string& name() const { return name_; }

 private:
  void member(const char* name, const config::Member& member, const config::Field& field) override {
    std::visit([&](const auto& kind) { take(name, kind, field); }, member);
  }
  void enter(const char* name) override { group_ = name; }
  void leave() override { group_.clear(); }
  bool wants(const char*, bool present) override { return present; }
  std::vector<std::string> names(const std::vector<std::string>& present, const char*) override {
    return present;
  }

  void take(const char* name, double* value, const config::Field& field) {
    if (isWanted(name)) *value = endOf(field);
  }
  void take(const char* name, int* value, const config::Field& field) {
    if (isWanted(name)) *value = static_cast<int>(endOf(field));
  }
  void take(const char* name, std::vector<double>* values, const config::Field& field) {
    if (isWanted(name)) std::fill(values->begin(), values->end(), endOf(field));
  }
  template <class Kind>
  void take(const char*, const Kind&, const config::Field&) {}

  // Groups that are named after a method are of that method alone.
  bool isRead() const {
    const bool is_of_method = group_ == "submap" || group_ == "pose_space" || group_ == "histogram";
    return !is_of_method || group_ == method_;
  }
  bool isWanted(const char* name) {
    if (!isRead()) return wanted_ == kAll;
    const bool wanted = wanted_ == kAll || wanted_ == count_;
    if (wanted) name_ = name;
    ++count_;
    return wanted;
  }
  double endOf(const config::Field& field) const {
    return end_ == End::kLeast ? field.range.min : field.range.max;
  }

  std::string method_;
  std::string group_;
  int wanted_;
  End end_;
  int count_ = 0;
  std::string name_;
};

/// Most poses that any scan was compared at: some at the usual rate, one that sees nothing, and one
/// from another place after a gap.
std::size_t mostEvaluations(const DeadReckonerConfig& config) {
  constexpr double kGap = 2.5;  // s
  DeadReckoner reckoner(config);
  // Few beams: the number of poses does not depend on them, the time does.
  test::Viewer viewer(test::furnishedRoom(), test::scanner(46), 1);
  std::size_t most = 0;
  const auto take = [&](const scan::Scan& scan) {
    const auto match = reckoner.match(scan, Pose2());
    ASSERT_TRUE(match);
    most = std::max(most, match->outcome.evaluations);
    const auto update = reckoner.commit(*match);
    EXPECT_TRUE(update.pose.mean.isFinite());
    EXPECT_TRUE(update.pose.covariance.allFinite());
    EXPECT_TRUE(update.step.covariance.allFinite());
    EXPECT_TRUE(update.twist.covariance.allFinite());
  };
  for (int i = 0; i < 3; ++i) take(viewer.look({0.05 * i, 0.0, 0.02 * i}, 0.2 * i));
  scan::Scan blind = viewer.look({}, 0.6);
  for (std::size_t i = 0; i < blind.beams(); ++i) blind.setRange(i, std::nan(""));
  take(blind);
  take(viewer.look({1.2, 0.4, 1.0}, 0.6 + kGap));
  return most;
}

class Limits : public testing::TestWithParam<Method> {};

TEST_P(Limits, NoEndOfAnySettingAsksForMorePosesThanCanBeTried) {
  constexpr std::size_t kMost = 1'300'000;  // two references of the default method, and a margin
  DeadReckonerConfig usual;
  EndSetter counter(GetParam(), EndSetter::kAll, End::kMost);
  usual.visit(counter);
  for (int field = EndSetter::kAll; field < counter.fields(); ++field) {
    for (const End end : {End::kLeast, End::kMost}) {
      DeadReckonerConfig config;
      EndSetter setter(GetParam(), field, end);
      config.visit(setter);
      config.method = GetParam();
      EXPECT_LT(mostEvaluations(config), kMost)
          << setter.name() << (end == End::kLeast ? " least" : " most");
    }
  }
}

// The widest window with the finest grid, which no single setting asks for.
TEST_P(Limits, AFastCarrierAndAFineGridAreBounded) {
  DeadReckonerConfig config;
  config.method = GetParam();
  config.carrier = {50.0, 50.0, 100.0, 100.0};
  config.pose_space.step = 1e-3;
  config.pose_space.angle_step = 1e-3;
  config.histogram.resolution = 1e-3;
  config.histogram.bin = 1e-3;
  EXPECT_LT(mostEvaluations(config), 1'300'000U);
}

INSTANTIATE_TEST_SUITE_P(DeadReckoner, Limits,
                         testing::Values(Method::kSubmap, Method::kPoseSpace, Method::kHistogram));

}  // namespace
}  // namespace sightline::dead_reckoning

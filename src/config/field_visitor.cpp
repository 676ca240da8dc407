#include "sightline/config/field_visitor.h"

namespace sightline::config {

namespace {

std::vector<double> coordinates(const geometry::Pose2& pose) {
  return {pose.x(), pose.y(), pose.theta()};
}

struct ValueOf {
  template <class T>
  Value operator()(const T* member) const {
    return *member;
  }
  Value operator()(const PathText& path) const { return *path.text; }
  Value operator()(const Choice& choice) const {
    return std::string(choice.options->at(*choice.index));
  }
  Value operator()(const FixedNumbers& numbers) const {
    return std::vector<double>(numbers.first, numbers.first + numbers.count);
  }
  Value operator()(const geometry::Pose2* pose) const { return coordinates(*pose); }
  Value operator()(const std::optional<geometry::Pose2>* pose) const {
    return *pose ? coordinates(**pose) : std::vector<double>();
  }
};

}  // namespace

Value valueOf(const Member& member) {
  return std::visit(ValueOf(), member);
}

}  // namespace sightline::config

#include "nodes/gaze_controls.h"

#include <cmath>

#include "sightline/bridge/pose_conversion.h"

namespace sightline::nodes {

namespace {

const char* nameOf(gaze::GazeMode mode) {
  switch (mode) {
    case gaze::GazeMode::kSweep:
      return "sweep";
    case gaze::GazeMode::kFixate:
      return "fixate";
    case gaze::GazeMode::kInform:
      return "inform";
    case gaze::GazeMode::kHold:
      break;
  }
  return "hold";
}

}  // namespace

GazeControls::GazeControls(ros::NodeHandle node, ros::NodeHandle private_node,
                           const std::string& odom_frame, const pipeline::Transforms& transforms,
                           gaze::GazeControl& gaze, diagnostic_updater::Updater& updater)
    : odom_frame_(odom_frame),
      transforms_(transforms),
      gaze_(gaze),
      clicks_(node.resolveName("clicked_point"), updater),
      fixate_server_(private_node.advertiseService("fixate", &GazeControls::onFixate, this)),
      hold_server_(advertise(private_node, "hold", &gaze::GazeControl::hold)),
      sweep_server_(advertise(private_node, "sweep", &gaze::GazeControl::sweep)),
      inform_server_(advertise(private_node, "inform", &gaze::GazeControl::inform)),
      click_subscriber_(node.subscribe("clicked_point", 5, &GazeControls::onClick, this)) {
  updater.add("gaze", this, &GazeControls::report);
}

ros::ServiceServer GazeControls::advertise(ros::NodeHandle& private_node, const std::string& name,
                                           Wish wish) {
  return private_node.advertiseService<Trigger::Request, Trigger::Response>(
      name, [this, wish](Trigger::Request&, Trigger::Response& response) {
        (gaze_.*wish)();
        response.success = true;
        return true;
      });
}

gaze::Fixated GazeControls::fixateAt(const geometry_msgs::PointStamped& point) {
  const Eigen::Vector3d place(point.point.x, point.point.y, point.point.z);
  if (!place.allFinite()) return {false, 0, "a point that is not finite"};
  const auto T_odom_point =
      transforms_.newest(odom_frame_, bridge::withoutSlash(point.header.frame_id));
  if (!T_odom_point) {
    return {false, 0, "no transform from '" + point.header.frame_id + "' to " + odom_frame_};
  }
  return gaze_.fixateAt((T_odom_point->T_target_source * place).head<2>());
}

gaze::Fixated GazeControls::fixate(const Fixate::Request& request) {
  switch (request.rule) {
    case Fixate::Request::BY_ID:
      return gaze_.fixate(request.id);
    case Fixate::Request::NEAREST_CORNER:
      return gaze_.fixateNearestCorner();
    case Fixate::Request::MOST_INFORMATIVE:
      return gaze_.fixateMostInformative();
    case Fixate::Request::AT_POINT:
      return fixateAt(request.point);
    default:
      return {false, 0, "there is no such rule"};
  }
}

bool GazeControls::onFixate(Fixate::Request& request, Fixate::Response& response) {
  const gaze::Fixated fixated = fixate(request);
  response.success = fixated.success;
  response.id = fixated.id;
  response.message = fixated.message;
  return true;
}

void GazeControls::onClick(const geometry_msgs::PointStamped& point) {
  clicks_.use([&] {
    const gaze::Fixated fixated = fixateAt(point);
    if (!fixated.success) throw bridge::BadMessage(fixated.message);
  });
}

void GazeControls::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const gaze::GazeState& state = gaze_.state();
  const bool is_fine = state.message.empty();
  const auto level = is_fine       ? DiagnosticStatus::OK
                     : state.rests ? DiagnosticStatus::WARN
                                   : DiagnosticStatus::ERROR;
  status.summary(level, is_fine ? nameOf(state.mode) : state.message);
  status.add("mode", nameOf(state.mode));
  status.add("at rest for want of input", state.rests);
  status.add("feature", state.target);
  status.add("feature is lost", state.is_target_lost);
  if (state.wanted) status.add("head angle wanted [rad]", *state.wanted);
}

}  // namespace sightline::nodes

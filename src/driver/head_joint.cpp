#include "sightline/driver/head_joint.h"

#include <cmath>

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "sightline/config/error.h"
#include "sightline/config/text_file.h"

namespace sightline::driver {

namespace {

constexpr double kExact = 1e-6;  // [1], of directions

// Collects the messages of the parser, which would print them.
class ParserMessages : public console_bridge::OutputHandler {
 public:
  ParserMessages() { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& message, console_bridge::LogLevel, const char*, int) override {
    text_ += (text_.empty() ? "" : "; ") + message;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

urdf::ModelInterfaceSharedPtr parse(const std::string& xml, const std::string& source) {
  const ParserMessages messages;
  const auto model = urdf::parseURDF(xml);
  if (!model) throw config::Error(source, 0, "", "not a robot description: " + messages.text());
  return model;
}

// Fails by the name of a joint or link.
[[noreturn]] void refuse(const std::string& source, const std::string& name,
                         const std::string& reason) {
  throw config::Error(source, 0, name, reason);
}

bool isParallel(const urdf::Rotation& rotation) {
  return std::abs(std::abs(rotation.w) - 1.0) < kExact;
}

void requireLink(const std::string& found, const std::string& wanted, const char* which,
                 const urdf::Joint& joint, const std::string& source) {
  if (found == wanted) return;
  refuse(source, joint.name, fmt::format("its {} is '{}', not '{}'", which, found, wanted));
}

void checkHead(const urdf::Joint& joint, const HeadFrames& frames, const std::string& source) {
  requireLink(joint.parent_link_name, frames.mount, "parent", joint, source);
  requireLink(joint.child_link_name, frames.head, "child", joint, source);
  if (joint.type != urdf::Joint::REVOLUTE) refuse(source, joint.name, "is not revolute");
  if (std::abs(joint.axis.x) > kExact || std::abs(joint.axis.y) > kExact || joint.axis.z < kExact) {
    refuse(source, joint.name, "does not turn about z");
  }
  const urdf::Pose& origin = joint.parent_to_joint_origin_transform;
  const urdf::Vector3& at = origin.position;
  if (std::hypot(at.x, at.y, at.z) > kExact || !isParallel(origin.rotation)) {
    refuse(source, joint.name, "does not sit in the origin of '" + frames.mount + "'");
  }
  if (!joint.limits) refuse(source, joint.name, "has no limits");
}

motion::HeadLimits limitsOf(const urdf::Joint& joint, const std::string& source) {
  motion::HeadLimits limits;
  limits.lower = joint.limits->lower;
  limits.upper = joint.limits->upper;
  limits.max_rate = joint.limits->velocity;
  limits.check(source + ": " + joint.name);
  return limits;
}

Eigen::Vector3d scanOriginOf(const urdf::ModelInterface& model, const HeadFrames& frames,
                             const std::string& source) {
  const auto link = model.getLink(frames.projection);
  if (!link) refuse(source, frames.projection, "no such link");
  const auto joint = link->parent_joint;
  if (!joint || joint->parent_link_name != frames.head) {
    refuse(source, frames.projection, "does not hang on '" + frames.head + "'");
  }
  const urdf::Pose& origin = joint->parent_to_joint_origin_transform;
  if (joint->type != urdf::Joint::FIXED) refuse(source, joint->name, "is not fixed");
  if (!isParallel(origin.rotation)) refuse(source, joint->name, "is turned against the head");
  return {origin.position.x, origin.position.y, origin.position.z};
}

}  // namespace

void HeadFrames::visit(config::FieldVisitor& visitor) {
  visitor.text("joint", joint, "name of the head's joint");
  visitor.text("mount_frame", mount, "frame in which the head turns about the z axis");
  visitor.text("head_frame", head, "frame that turns with the head, about its own origin");
  visitor.text("frame", projection, "projection frame: that of the scans, parallel to the head's");
}

HeadJoint HeadJoint::fromUrdf(const std::string& xml, const HeadFrames& frames,
                              const std::string& source) {
  const auto model = parse(xml, source);
  const auto head = model->getJoint(frames.joint);
  if (!head) refuse(source, frames.joint, "no such joint");
  checkHead(*head, frames, source);
  const Eigen::Vector3d origin = scanOriginOf(*model, frames, source);
  return {limitsOf(*head, source), origin.head<2>(), origin.z(), frames.projection};
}

HeadJoint HeadJoint::readFile(const std::string& path, const HeadFrames& frames) {
  return fromUrdf(config::readText(path), frames, path);
}

void HeadJoint::requireScanOrigin(const Eigen::Vector2d& expected,
                                  const std::string& source) const {
  constexpr double kSame = 1e-3;  // [m]
  if ((scan_origin - expected).norm() < kSame) return;
  refuse(source, projection,
         fmt::format("is at ({}, {}) m on the head, by the calibration at ({}, {}) m",
                     scan_origin.x(), scan_origin.y(), expected.x(), expected.y()));
}

}  // namespace sightline::driver

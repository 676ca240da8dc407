#include <cmath>
#include <memory>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "nodes/sim_robot_topics.h"
#include "nodes/sim_sensor_setup.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/run_clock.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/simulation/simulation.h"
#include "sightline/targets/target_log.h"

namespace sightline::nodes {

namespace {

using simulation::Simulation;

class SimSensorNode {
 public:
  SimSensorNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  void addMover(const SimMoverConfig& mover);
  void publishTruth();
  void onTimer();
  void step();
  template <class Values>
  void publishEach(Values& values);
  void end();

  ros::NodeHandle node_;
  SimSetup setup_;
  Simulation simulation_;
  bridge::RunClock clock_;
  diagnostic_updater::Updater updater_;
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
  std::vector<std::unique_ptr<SimRobotTopics>> robots_;
  ros::Publisher truth_;
  ros::WallTimer timer_;
  ros::SteadyTimer diagnostics_timer_;
  ros::WallTimer end_timer_;
};

SimSetup readSetup(const ros::NodeHandle& private_node) {
  SimSetup setup = SimSetup::read(bridge::parametersBelow(private_node));
  if (setup.node.clock && !ros::Time::isSimTime()) {
    throw config::Error(private_node.getNamespace(), 0, "clock",
                        "needs the parameter /use_sim_time");
  }
  return setup;
}

SimSensorNode::SimSensorNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : node_(node),
      setup_(readSetup(private_node)),
      simulation_(world::World::readFile(setup_.node.world),
                  static_cast<std::uint64_t>(setup_.node.seed)),
      clock_(setup_.node.clock ? bridge::RunClock(node, setup_.node.speed_factor)
                               : bridge::RunClock()),
      updater_(node, private_node) {
  updater_.setHardwareID("none");
  for (const SimRobotSetup& robot : setup_.robots) {
    robots_.push_back(std::make_unique<SimRobotTopics>(
        node, robot, setup_.node.map_frame, simulation_, clock_, updater_, static_broadcaster_));
  }
  for (const SimMoverConfig& mover : setup_.movers) addMover(mover);
  if (!setup_.node.truth.empty()) publishTruth();
  timer_ = node_.createWallTimer(ros::WallDuration(1e-9 * Simulation::kStep),
                                 [this](const ros::WallTimerEvent&) { onTimer(); });
  diagnostics_timer_ = node_.createSteadyTimer(
      ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { updater_.force_update(); });
}

void SimSensorNode::addMover(const SimMoverConfig& mover) {
  simulation_.addMover(mover.body, simulation::Path::readFile(mover.path), mover.start_pose);
}

void SimSensorNode::publishTruth() {
  truth_ = node_.advertise<visualization_msgs::MarkerArray>("target_truth", 1, /*latch=*/true);
  truth_.publish(bridge::toMarkers(targets::readTargetTruth(setup_.node.truth), /*stamp=*/0,
                                   setup_.node.map_frame));
}

void SimSensorNode::onTimer() {
  const std::int64_t due = clock_.due(simulation_.time());
  const auto last = std::llround(1e9 * setup_.node.duration);
  while (simulation_.time() + Simulation::kStep <= due) {
    if (last > 0 && simulation_.time() >= last) return end();
    step();
  }
}

// Outputs that tell where things were go ahead of the scans.
void SimSensorNode::step() {
  simulation::Outputs outputs = simulation_.step();
  clock_.publish(simulation_.time());
  publishEach(outputs.states);
  publishEach(outputs.motions);
  publishEach(outputs.heads);
  for (const auto& turret : outputs.turrets) robots_[turret.robot]->publishTurret(turret);
  publishEach(outputs.sweeps);
  publishEach(outputs.range_scans);
}

template <class Values>
void SimSensorNode::publishEach(Values& values) {
  for (auto& value : values) robots_[value.robot]->publish(value);
}

void SimSensorNode::end() {
  // Publishes once more, so that the last sweep is covered.
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i]->publish(simulation_.carrier(i).report(i));
  }
  timer_.stop();
  // The others get a moment to take in what was published last.
  end_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0), [](const ros::WallTimerEvent&) { ros::shutdown(); }, true);
}

}  // namespace

std::shared_ptr<void> makeSimSensor(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<SimSensorNode>(node, private_node);
}

}  // namespace sightline::nodes

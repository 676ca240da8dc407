// Every setting of every node.
#include <gmock/gmock.h>

#include "nodes/gaze_config.h"
#include "nodes/laser_odometry_config.h"
#include "nodes/line_extractor_config.h"
#include "nodes/room_tracker_config.h"
#include "nodes/sim_sensor_config.h"
#include "nodes/sync_scan_driver_config.h"
#include "nodes/target_tracker_config.h"
#include "settings_test.h"
#include "sightline/bridge/bag_from_carmen.h"
#include "sightline/bridge/bag_from_mrclam.h"

namespace sightline::test {
namespace {

using OfTheNodes =
    testing::Types<nodes::GazeNodeConfig, nodes::LaserOdometryNodeConfig,
                   nodes::LineExtractorNodeConfig, nodes::RoomTrackerNodeConfig,
                   nodes::SimSensorConfig, nodes::SimRobotConfig, nodes::SimMoverConfig,
                   nodes::SimScannerConfig, nodes::SimActiveSensorConfig,
                   nodes::SyncScanDriverConfig, nodes::TargetTrackerNodeConfig,
                   bridge::CarmenBagOptions, bridge::MrclamBagOptions>;
INSTANTIATE_TYPED_TEST_SUITE_P(Nodes, EverySetting, OfTheNodes);

}  // namespace
}  // namespace sightline::test

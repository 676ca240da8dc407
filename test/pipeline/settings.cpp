// Every setting of every struct below the nodes.
#include <gmock/gmock.h>

#include "settings_test.h"
#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/driver/device_session.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/motion/head_command.h"
#include "sightline/motion/odometry_noise.h"
#include "sightline/pipeline/estimators_config.h"
#include "sightline/scan/noise_model.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/simulation/gait.h"
#include "sightline/simulation/mounting.h"
#include "sightline/simulation/path.h"
#include "sightline/simulation/robot.h"
#include "sightline/simulation/scanner_profile.h"
#include "sightline/tracking/tracker_config.h"

namespace sightline::test {
namespace {

using OfTheLibrary =
    testing::Types<dead_reckoning::DeadReckonerConfig, driver::SessionConfig,
                   lines::LineExtractorConfig, motion::HeadLimits, motion::OdometryNoise,
                   pipeline::EstimatorsConfig, scan::NoiseModel, simulation::ActiveSensorProfile,
                   simulation::GaitConfig, simulation::Mounting, simulation::Path,
                   simulation::RobotConfig, simulation::ScannerProfile, tracking::TrackerConfig>;
INSTANTIATE_TYPED_TEST_SUITE_P(Library, EverySetting, OfTheLibrary);

}  // namespace
}  // namespace sightline::test

// Figures of features over scans and of the gaze. All is simulated: the sensor of the paper, its
// head angles told in steps of 0.36° and with noise of half a step, and a robot whose wheels err as
// jensfelt's do, which the estimators are told.
//
// gaze.head_<rate>_<sense>: a wall while the head turns. gaze.fixation: in_view, of the scans
// during which a head angle had the corner in field and reach; reacquire_s, from the first scan in
// which nothing nearer hides the corner. gaze.features: a scanner of 270° and 10 Hz in a room with
// boxes; nees and in_gate of those called fixed, seen or not; id_changes a minute that a feature
// stays in view; recall and precision of what is called fixed, of features watched for a second.
// gaze.triangulation: the tracker on this sensor, mean over the scans of the square root of the
// trace of x and y; against the better of a fixed head and a sweep; bound_ratio: what a sensor that
// looked everywhere at once would have, where nothing hides a wall. gaze.turret: the scanner of
// jensfelt on a turret, by the shipped settings, against straight ahead; plain_locked_in: runs of
// the plain method in jensfelt's living room that are off by the depth of the shelf for 2 s.
// gaze.node: load of the running node, in the mode inform on the demo's floor.
//
// usage: bench_gaze [PART]   head fixation features triangulation turret node
#include "bench/gaze/features.h"
#include "bench/gaze/fixation.h"
#include "bench/gaze/head.h"
#include "bench/gaze/node.h"
#include "bench/gaze/triangulation.h"
#include "bench/gaze/turret.h"

int main(int argc, char** argv) {
  using namespace sightline::bench;
  constexpr std::uint64_t kSeeds = 20;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const std::string part = argc > 1 ? argv[1] : "";
  const auto is_wanted = [&](const char* name) { return part.empty() || part == name; };
  if (is_wanted("head")) turningHead(15 * kSeeds);
  if (is_wanted("fixation")) fixation(kSeeds);
  if (is_wanted("features")) {
    features({"alone"}, kSeeds);
    features({"among_movers", true, true}, kSeeds);
    features({"unmeasured_wheels", true, true, true}, kSeeds);
  }
  if (is_wanted("triangulation")) triangulation(kSeeds);
  if (is_wanted("turret")) turret(kSeeds);
  if (is_wanted("node")) printGazeNode();
  return 0;
}

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/logs/trajectory.h"

/// Errors of a trajectory against what is known to be true.
namespace sightline::logs {

struct Statistics {
  double mean = 0.0;
  double std = 0.0;  ///< of the population
  double median = 0.0;
  double max = 0.0;
};

/// The values have to be at least one.
Statistics statisticsOf(std::vector<double> values);

/// Errors of some poses or motions.
struct PoseErrors {
  Statistics translation;  ///< [m]
  Statistics rotation;     ///< [deg]
};

/// Errors of relative motion (Kümmerle, Burgard et al. 2009).
struct RelationErrors {
  std::size_t used = 0;  ///< relations of which the trajectory has both poses
  std::size_t total = 0;
  std::optional<PoseErrors> short_term;  ///< of relations over at most 5 s: dead reckoning
  double bad = 0.0;                      ///< [%] of those, off by more than 0.1 m or 3°
  std::optional<PoseErrors> all;         ///< none where no relation is used
};

/// Compares the motion between two poses of a trajectory with the relation that names them. A pose
/// is the one a relation names where its stamp is the nearest and within 2 ms.
///
/// @param T_body_measured  the frame the relations hold for, in the frame whose trajectory it is
RelationErrors compareWithRelations(const Trajectory& trajectory,
                                    const std::vector<Relation>& relations,
                                    const geometry::Pose2& T_body_measured = {});

/// Errors of poses in one and the same frame.
struct TruthErrors {
  std::size_t used = 0;  ///< poses at whose time the truth is known
  std::size_t total = 0;
  std::optional<PoseErrors> absolute;  ///< none where no pose is used
};

/// Compares each pose with the truth at its time, interpolated between the two nearest poses of the
/// truth where these are no more than 1 s apart. The frames are taken as one: nothing is aligned.
///
/// @param T_body_measured  the frame the truth holds for, in the frame whose trajectory it is
TruthErrors compareWithTruth(const Trajectory& trajectory, const Trajectory& truth,
                             const geometry::Pose2& T_body_measured = {});

/// One figure a line, `name value unit`, each name after the prefix: `relations.used`, then
/// `short.translation.mean` and so on with `std median max`, `short.rotation.…`, `short.bad`,
/// `all.…`.
std::string figures(const RelationErrors& errors, const std::string& prefix = "");
/// `truth.used`, then `absolute.translation.mean` and so on as above, `absolute.rotation.…`.
std::string figures(const TruthErrors& errors, const std::string& prefix = "");

}  // namespace sightline::logs

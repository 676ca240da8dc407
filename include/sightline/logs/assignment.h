#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace sightline::logs {

/// The column given to each row so that the sum of the costs is least, one to one; every row has
/// one where there are no more rows than columns, otherwise every column is used. Costs are finite.
/// Shortest augmenting paths (Jonker and Volgenant 1987), O(n³).
std::vector<std::optional<std::size_t>> assign(const Eigen::MatrixXd& cost);

}  // namespace sightline::logs

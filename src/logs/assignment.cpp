#include "sightline/logs/assignment.h"

#include <limits>

namespace sightline::logs {

namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// Shortest augmenting paths over reduced costs, for no more rows than columns. Column n is a
// stand-in from which each path starts.
class Augmenter {
 public:
  explicit Augmenter(const Eigen::MatrixXd& cost)
      : cost_(cost),
        columns_(static_cast<std::size_t>(cost.cols())),
        row_price_(static_cast<std::size_t>(cost.rows()), 0.0),
        column_price_(columns_ + 1, 0.0),
        row_of_(columns_ + 1, kNone),
        before_(columns_ + 1, columns_) {}

  void add(std::size_t row) {
    row_of_[columns_] = row;
    distance_.assign(columns_ + 1, std::numeric_limits<double>::infinity());
    done_.assign(columns_ + 1, false);
    std::size_t column = columns_;
    while (row_of_[column] != kNone) column = advance(column);
    while (column != columns_) {
      row_of_[column] = row_of_[before_[column]];
      column = before_[column];
    }
  }

  std::vector<std::optional<std::size_t>> result() const {
    std::vector<std::optional<std::size_t>> columns(row_price_.size());
    for (std::size_t column = 0; column < columns_; ++column) {
      if (row_of_[column] != kNone) columns[row_of_[column]] = column;
    }
    return columns;
  }

 private:
  // Settles a column and returns the nearest one that is not settled.
  std::size_t advance(std::size_t column) {
    done_[column] = true;
    const std::size_t row = row_of_[column];
    for (std::size_t next = 0; next < columns_; ++next) {
      if (!done_[next]) relax(row, column, next);
    }
    const std::size_t nearest = nearestOpen();
    raisePrices(distance_[nearest]);
    return nearest;
  }

  void relax(std::size_t row, std::size_t column, std::size_t next) {
    const double reduced = cost_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(next)) -
                           row_price_[row] - column_price_[next];
    if (reduced >= distance_[next]) return;
    distance_[next] = reduced;
    before_[next] = column;
  }

  std::size_t nearestOpen() const {
    std::size_t nearest = kNone;
    for (std::size_t column = 0; column < columns_; ++column) {
      if (done_[column]) continue;
      if (nearest == kNone || distance_[column] < distance_[nearest]) nearest = column;
    }
    return nearest;
  }

  void raisePrices(double step) {
    for (std::size_t column = 0; column <= columns_; ++column) {
      if (done_[column]) {
        row_price_[row_of_[column]] += step;
        column_price_[column] -= step;
      } else {
        distance_[column] -= step;
      }
    }
  }

  const Eigen::MatrixXd& cost_;
  std::size_t columns_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<std::size_t> row_of_;
  std::vector<std::size_t> before_;  // on the shortest path
  std::vector<double> distance_;
  std::vector<bool> done_;
};

std::vector<std::optional<std::size_t>> transposed(
    const std::vector<std::optional<std::size_t>>& rows, std::size_t count) {
  std::vector<std::optional<std::size_t>> columns(count);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row]) columns[*rows[row]] = row;
  }
  return columns;
}

}  // namespace

std::vector<std::optional<std::size_t>> assign(const Eigen::MatrixXd& cost) {
  if (cost.rows() > cost.cols()) {
    return transposed(assign(cost.transpose()), static_cast<std::size_t>(cost.rows()));
  }
  Augmenter augmenter(cost);
  for (Eigen::Index row = 0; row < cost.rows(); ++row) augmenter.add(static_cast<std::size_t>(row));
  return augmenter.result();
}

}  // namespace sightline::logs

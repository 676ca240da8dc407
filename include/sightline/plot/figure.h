#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace sightline::plot {

/// A figure that cannot be drawn: what() says why, with what gnuplot had to say.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Point {
  double x = 0.0;
  double y = 0.0;
  double colour = 0.0;  ///< of coloured points, on the panel's colour scale
};

enum class Style { kPoints, kLine, kLineAndPoints, kColouredPoints };

struct Series {
  std::string title;  ///< in the key; empty: not there
  Style style = Style::kPoints;
  std::vector<Point> points;  ///< one that is not finite interrupts a line
};

/// One pair of axes.
struct Panel {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::string colour_label;  ///< of coloured points
  double colour_limit = 0.0;  ///< the scale is [−limit, limit], grey in the middle; 0: as they need
  std::vector<Series> series;
};

struct Figure {
  int width = 1200;  ///< [pixels]
  int height = 900;
  int columns = 1;  ///< of panels, filled row by row
  std::vector<Panel> panels;
};

/// Script for gnuplot, data included.
std::string gnuplotScript(const Figure& figure, const std::string& png_path);

/// Draws with gnuplot. Throws Error where that is missing or fails.
void writePng(const Figure& figure, const std::string& path);

}  // namespace sightline::plot

#include "sightline/plot/figure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace sightline::plot {

namespace {

// A text as gnuplot takes it; it has no line breaks.
std::string literal(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

std::string blockName(std::size_t panel, std::size_t series) {
  return fmt::format("$panel{}series{}", panel, series);
}

std::string dataBlock(const std::string& name, const Series& series) {
  std::string text = name + " << END\n";
  for (const Point& point : series.points) {
    const bool is_gap = !std::isfinite(point.x) || !std::isfinite(point.y);
    text += is_gap ? "\n" : fmt::format("{:.8g} {:.8g} {:.8g}\n", point.x, point.y, point.colour);
  }
  return text + "END\n";
}

std::string styleOf(Style style) {
  switch (style) {
    case Style::kLine:
      return "with lines lw 2";
    case Style::kLineAndPoints:
      return "with linespoints lw 2 pt 7";
    case Style::kColouredPoints:
      return "using 1:2:3 with points pt 7 ps 0.6 palette";
    case Style::kPoints:
      break;
  }
  return "with points pt 7 ps 0.4";
}

std::string axesOf(const Panel& panel) {
  std::string text = fmt::format("set title {}\nset xlabel {}\nset ylabel {}\nset cblabel {}\n",
                                 literal(panel.title), literal(panel.x_label),
                                 literal(panel.y_label), literal(panel.colour_label));
  if (panel.colour_limit > 0.0) {
    return text + fmt::format(
                      "set palette defined (-1 '#2166ac', 0 '#dddddd', 1 '#b2182b')\n"
                      "set cbrange [{}:{}]\n",
                      -panel.colour_limit, panel.colour_limit);
  }
  return text +
         "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n"
         "set cbrange [*:*]\n";
}

std::string drawing(const Panel& panel, std::size_t index) {
  std::string text = axesOf(panel) + "plot ";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& series = panel.series[i];
    text += fmt::format(
        "{}{} {} {}", i == 0 ? "" : ", ", blockName(index, i), styleOf(series.style),
        series.title.empty() ? std::string("notitle") : "title " + literal(series.title));
  }
  return text + "\n";
}

// A file of its own, gone with it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    path_ = (std::filesystem::temp_directory_path() / "sightline-plot-XXXXXX").string();
    const int handle = mkstemp(path_.data());
    if (handle < 0) throw Error("no temporary file for gnuplot at " + path_);
    close(handle);
    std::ofstream file(path_);
    if (!(file << content).flush()) throw Error("no room for gnuplot's script at " + path_);
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string quotedForShell(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

struct Outcome {
  int status;
  std::string said;
};

// gnuplot reads the script from a file and speaks through the pipe: written to, a gnuplot that is
// missing or dies would end this process with a signal.
Outcome runGnuplot(const std::string& script_path) {
  FILE* pipe = popen(("gnuplot " + quotedForShell(script_path) + " 2>&1").c_str(), "r");
  if (!pipe) throw Error("gnuplot cannot be started");
  Outcome outcome{0, ""};
  std::array<char, 1024> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) {
    outcome.said += buffer.data();
  }
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

}  // namespace

std::string gnuplotScript(const Figure& figure, const std::string& png_path) {
  const int panels = static_cast<int>(figure.panels.size());
  const int columns = std::max(1, figure.columns);
  std::string text = fmt::format(
      "set encoding utf8\nset terminal pngcairo noenhanced size {},{} font 'Sans,11'\n"
      "set output {}\nset grid\n",
      figure.width, figure.height, literal(png_path));
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const auto& series = figure.panels[i].series;
    for (std::size_t k = 0; k < series.size(); ++k) text += dataBlock(blockName(i, k), series[k]);
  }
  text += fmt::format("set multiplot layout {},{}\n", (panels + columns - 1) / columns, columns);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) text += drawing(figure.panels[i], i);
  return text + "unset multiplot\nset output\n";
}

void writePng(const Figure& figure, const std::string& path) {
  for (const Panel& panel : figure.panels) {
    const auto has_points = [](const Series& series) { return !series.points.empty(); };
    if (std::none_of(panel.series.begin(), panel.series.end(), has_points)) {
      throw Error(fmt::format("{}: the panel '{}' has nothing to draw", path, panel.title));
    }
  }
  const TemporaryFile script(gnuplotScript(figure, path));
  const Outcome outcome = runGnuplot(script.path());
  constexpr int kNotFound = 127;
  if (outcome.status == kNotFound) throw Error(path + ": gnuplot is not installed");
  if (outcome.status != 0) {
    throw Error(fmt::format("{}: gnuplot failed ({}): {}", path, outcome.status, outcome.said));
  }
}

}  // namespace sightline::plot

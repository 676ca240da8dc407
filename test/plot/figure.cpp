#include "sightline/plot/figure.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "temporary_folder.h"

namespace sightline::plot {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

Figure twoPanels() {
  Figure figure;
  figure.columns = 2;
  figure.panels.resize(2);
  figure.panels[0].title = "what's up [µm]";
  figure.panels[0].series = {{"line", Style::kLine, {{0, 1}, {1, 2}}},
                             {"", Style::kPoints, {{0, 2}, {NAN, 1}}}};
  figure.panels[1].colour_limit = 3.0;
  figure.panels[1].series = {{"", Style::kColouredPoints, {{0, 1, -2}, {1, 2, 3}}}};
  return figure;
}

TEST(Figure, IsAScriptWithItsData) {
  const std::string script = gnuplotScript(twoPanels(), "a 'b'.png");
  EXPECT_THAT(script, HasSubstr("set output 'a ''b''.png'"));
  EXPECT_THAT(script, HasSubstr("set title 'what''s up [µm]'"));
  EXPECT_THAT(script, HasSubstr("layout 1,2"));
  EXPECT_THAT(script, HasSubstr("1 2 3\nEND\n"));
  EXPECT_THAT(script, HasSubstr("set cbrange [-3:3]"));
  EXPECT_THAT(script, Not(HasSubstr("nan")));
}

TEST(Figure, IsDrawn) {
  const TemporaryFolder folder;
  const std::string path = folder.path("it's a plot.png");
  writePng(twoPanels(), path);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
}

TEST(Figure, SaysWhyItCannotBeDrawn) {
  try {
    writePng(twoPanels(), "/none/a.png");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/none/a.png: gnuplot failed"));
    EXPECT_THAT(error.what(), HasSubstr("cannot open file"));
  }
  const TemporaryFolder folder;
  Figure empty = twoPanels();
  empty.panels[0].series.clear();
  EXPECT_THROW(writePng(empty, folder.path("a.png")), Error);
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path("").c_str(), 1);
  EXPECT_THROW(writePng(twoPanels(), folder.path("a.png")), Error);
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace sightline::plot

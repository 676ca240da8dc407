// Any text, read as a document of settings: a struct that passes validate() and can be written, or
// config::Error.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/config/yaml_writer.h"

namespace {

using namespace sightline;

enum class Mode { kSlow, kFast };

struct Inner {
  double gain = 1.0;
  int count = 3;

  void visit(config::FieldVisitor& visitor) {
    visitor.number("gain", gain, {"-", config::kPositive, "a number"});
    visitor.integer("count", count, {"-", {0, 10}, "a whole number"});
  }
};

struct Outer {
  double width = 0.5;
  bool active = true;
  std::string name = "none";
  std::vector<std::string> topics = {"scan"};
  std::string file;
  std::vector<double> widths = {0.0};
  std::array<double, 2> sigmas = {0.1, 0.1};
  std::optional<geometry::Pose2> pose;
  Mode mode = Mode::kSlow;
  Inner inner;
  std::optional<Inner> second;
  std::map<std::string, geometry::Pose2> mountings;

  void visit(config::FieldVisitor& visitor) {
    visitor.number("width", width, {"m", {0.0, 1.0}, "a number"});
    visitor.flag("active", active, "a flag");
    visitor.text("name", name, "a text");
    visitor.texts("topics", topics, "texts");
    visitor.path("file", file, "a path");
    visitor.numbers("widths", widths, {"m", {-100.0, 100.0}, "numbers"});
    visitor.numbers("sigmas", sigmas, {"m", {0.0, 100.0}, "two numbers"});
    visitor.pose("pose", pose, "a pose");
    visitor.choice("mode", mode, {"slow", "fast"}, "one of two");
    visitor.group("inner", inner);
    visitor.group("second", second);
    visitor.entries("mountings", mountings, "poses by name");
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    Outer outer;
    config::read(config::Node::parse(text, "fuzz"), outer);
    config::validate(outer);
    config::toYaml(outer);
  } catch (const config::Error&) {
  }
  return 0;
}

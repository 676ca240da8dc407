// Any text, read as a document of settings: a struct that passes validate(), or config::Error.
#include <cstdint>
#include <string>
#include <vector>

#include "sightline/config/fields.h"

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
  std::vector<double> pose = {0.0, 0.0, 0.0};
  Mode mode = Mode::kSlow;
  Inner inner;

  void visit(config::FieldVisitor& visitor) {
    visitor.number("width", width, {"m", {0.0, 1.0}, "a number"});
    visitor.flag("active", active, "a flag");
    visitor.text("name", name, "a text");
    visitor.numbers("pose", pose, {"m", {-100.0, 100.0}, "numbers"});
    visitor.choice("mode", mode, {"slow", "fast"}, "one of two");
    visitor.group("inner", inner);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    Outer outer;
    config::read(config::Node::parse(text, "fuzz"), outer);
    config::validate(outer);
  } catch (const config::Error&) {
  }
  return 0;
}

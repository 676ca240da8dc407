#include "sightline/config/yaml_writer.h"

#include <gmock/gmock.h>

namespace sightline::config {
namespace {

struct WrittenPart {
  double length = 0.1;
  std::vector<double> places{0.5, 1.0 / 3.0};

  void visit(FieldVisitor& visitor) {
    visitor.number("length", length, {"m", kPositive, "of the part"});
    visitor.numbers("places", places, {"m", {}, "where it is"});
  }
};

struct WrittenWhole {
  std::string name = "whole";
  int count = 2;
  bool is_new = true;
  std::size_t colour = 0;
  WrittenPart part;

  void visit(FieldVisitor& visitor) {
    visitor.text("name", name, "what it is called");
    visitor.integer("count", count, {"1", {0, 10}, "how many"});
    visitor.flag("is_new", is_new, "or old");
    visitor.option("colour", colour, {"red", "blue"}, "of it");
    visitor.group("part", part);
  }
};

TEST(YamlWriter, SaysUnitAndMeaning) {
  const std::string yaml = toYaml(WrittenWhole());
  EXPECT_THAT(yaml,
              testing::HasSubstr("  length: 0.1                            # m, of the part\n"));
  EXPECT_THAT(yaml, testing::HasSubstr("part:\n"));
}

TEST(YamlWriter, IsReadBack) {
  WrittenWhole written;
  written.name = "\"a\": [#\n\t\\";
  written.count = 7;
  written.is_new = false;
  written.colour = 1;
  written.part.length = 1.0 / 7.0;
  written.part.places = {};
  WrittenWhole found;
  read(Node::parse(toYaml(written), "w.yaml"), found);
  EXPECT_EQ(found.name, written.name);
  EXPECT_EQ(found.count, 7);
  EXPECT_FALSE(found.is_new);
  EXPECT_EQ(found.colour, 1U);
  EXPECT_EQ(found.part.length, 1.0 / 7.0);
  EXPECT_TRUE(found.part.places.empty());
}

}  // namespace
}  // namespace sightline::config

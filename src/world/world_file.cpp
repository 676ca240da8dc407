#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "sightline/geometry/pose2.h"
#include "sightline/world/world.h"

namespace sightline::world {

namespace {

constexpr config::Range kHeights{0.0, 1e6};

Eigen::Vector2d planePoint(const config::Node& node) {
  const auto xy = node.numbers(2, kBuildingCoordinates);
  return {xy[0], xy[1]};
}

Eigen::Vector2d planeSize(const config::Node& node) {
  const auto xy = node.numbers(2, kBuildingLengths);
  return {xy[0], xy[1]};
}

// Reads one file of a world into the world that it belongs to, where its frame stands in it.
class WorldFile {
 public:
  WorldFile(World& world, const geometry::Pose2& T_map_file, std::vector<std::string> included_from)
      : world_(world), T_map_file_(T_map_file), included_from_(std::move(included_from)) {}

  void read(const config::Node& document) {
    document.allowOnly({"include", "rooms", "walls", "materials", "floor", "ceiling", "segments",
                        "boxes", "discs"});
    if (document.has("materials")) readMaterials(document.at("materials"));
    if (document.has("include")) readIncludes(document);
    if (document.has("walls")) readWallDefaults(document.at("walls"));
    if (document.has("rooms")) readRooms(document.at("rooms"));
    if (document.has("floor")) readFloor(document.at("floor"));
    if (document.has("ceiling")) readCeiling(document.at("ceiling"));
    for (const auto& node : listOf(document, "segments")) readSegment(node);
    for (const auto& node : listOf(document, "boxes")) readBox(node);
    for (const auto& node : listOf(document, "discs")) readDisc(node);
  }

 private:
  // Fields of every upright thing.
  struct Upright {
    double bottom;
    double top;
    std::size_t material;
  };

  static std::vector<config::Node> listOf(const config::Node& document, const char* key) {
    return document.has(key) ? document.at(key).items() : std::vector<config::Node>{};
  }

  std::size_t materialOf(const config::Node& node) const {
    if (!node.has("material")) return wall_material_;
    const config::Node name = node.at("material");
    const auto material = world_.findMaterial(name.text());
    if (!material) name.fail(fmt::format("no material is called '{}'", name.text()));
    return *material;
  }

  Upright uprightOf(const config::Node& node) const {
    const double bottom = node.numberOr("bottom", 0.0, kHeights);
    const double top = node.numberOr("top", wall_height_, kHeights);
    if (!(bottom < top)) node.fail(fmt::format("bottom {} m is not below top {} m", bottom, top));
    return {bottom, top, materialOf(node)};
  }

  void readMaterials(const config::Node& node) {
    for (const auto& [name, material] : node.entries()) {
      material.allowOnly({"reflectivity", "lobe"});
      const double reflectivity = material.at("reflectivity").number(config::kPositive);
      const Lobe lobe = material.has("lobe") ? lobeOf(material.at("lobe")) : Lobe{};
      world_.addMaterial({name, reflectivity, lobe});
    }
  }

  static Lobe lobeOf(const config::Node& node) {
    node.allowOnly({"gain", "half_width", "steepness"});
    Lobe lobe;
    lobe.gain = node.at("gain").number({0.0, 1e6});
    lobe.half_width = node.at("half_width").number({1e-9, 2.0});
    lobe.steepness = node.numberOr("steepness", lobe.steepness, {0.1, 100.0});
    return lobe;
  }

  void readIncludes(const config::Node& document) {
    auto chain = included_from_;
    chain.push_back(document.source());
    for (const auto& node : document.at("include").items()) {
      node.allowOnly({"file", "pose"});
      const std::string path = node.at("file").path();
      if (std::find(chain.begin(), chain.end(), path) != chain.end()) {
        node.at("file").fail("a file cannot include itself");
      }
      WorldFile(world_, T_map_file_ * placeOf(node), chain).read(config::Node::readFile(path));
    }
  }

  static geometry::Pose2 placeOf(const config::Node& node) {
    if (!node.has("pose")) return {};
    const auto pose = node.at("pose").numbers(3, kBuildingCoordinates);
    return {pose[0], pose[1], pose[2]};
  }

  void readWallDefaults(const config::Node& node) {
    node.allowOnly({"height", "material"});
    wall_height_ = node.numberOr("height", wall_height_, kBuildingLengths);
    wall_material_ = materialOf(node);
  }

  void readRooms(const config::Node& node) {
    for (const auto& wall : solidWalls(RoomMap::readFile(node.path()))) {
      world_.add(WorldSegment{T_map_file_ * wall, 0.0, wall_height_, wall_material_});
    }
  }

  void readFloor(const config::Node& node) {
    node.allowOnly({"material"});
    world_.add(WorldPlate{{}, 0.0, materialOf(node)});
  }

  void readCeiling(const config::Node& node) {
    node.allowOnly({"height", "material"});
    world_.add(WorldPlate{{}, node.at("height").number(kBuildingLengths), materialOf(node)});
  }

  void readSegment(const config::Node& node) {
    node.allowOnly({"from", "to", "bottom", "top", "material"});
    const geometry::Segment segment{planePoint(node.at("from")), planePoint(node.at("to"))};
    if (!(segment.length() >= kBuildingLengths.min)) node.fail("from and to are the same point");
    const Upright upright = uprightOf(node);
    world_.add(WorldSegment{T_map_file_ * segment, upright.bottom, upright.top, upright.material});
  }

  void readBox(const config::Node& node) {
    node.allowOnly({"centre", "size", "yaw", "bottom", "top", "material"});
    const Eigen::Vector2d half = 0.5 * planeSize(node.at("size"));
    const geometry::Pose2 T_file_box(planePoint(node.at("centre")),
                                     node.numberOr("yaw", 0.0, kBuildingCoordinates));
    addBox(T_map_file_ * T_file_box, half, uprightOf(node));
  }

  void addBox(const geometry::Pose2& T_map_box, const Eigen::Vector2d& half,
              const Upright& upright) {
    std::vector<Eigen::Vector2d> corners;
    for (const auto& [x, y] :
         std::array<std::array<double, 2>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
      corners.push_back(T_map_box * Eigen::Vector2d(x * half.x(), y * half.y()));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const geometry::Segment side{corners[i], corners[(i + 1) % corners.size()]};
      world_.add(WorldSegment{side, upright.bottom, upright.top, upright.material});
    }
    world_.add(WorldPlate{corners, upright.bottom, upright.material});
    world_.add(WorldPlate{corners, upright.top, upright.material});
  }

  void readDisc(const config::Node& node) {
    node.allowOnly({"centre", "radius", "bottom", "top", "material"});
    const Upright upright = uprightOf(node);
    const Eigen::Vector2d centre_map = T_map_file_ * planePoint(node.at("centre"));
    world_.add(WorldDisc{centre_map, node.at("radius").number(kBuildingLengths), upright.bottom,
                         upright.top, upright.material});
  }

  World& world_;
  geometry::Pose2 T_map_file_;
  std::vector<std::string> included_from_;
  double wall_height_ = WorldSegment{}.top;
  std::size_t wall_material_ = 0;
};

}  // namespace

World::World(const config::Node& document) : World() {
  WorldFile(*this, {}, {}).read(document);
}

}  // namespace sightline::world

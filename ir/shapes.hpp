// Every shape a scene can contain. `material` and `transform` are common to all (Placing).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "ir/schema.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

struct Sphere {
  Point3 center;
  Length radius{1};
};
template <>
struct Schema<Sphere> {
  static constexpr std::string_view name = "sphere";
  static constexpr std::string_view doc =
      "A sphere; u runs counter-clockwise about +y from +x, v from south to north.";
  static constexpr auto keys = std::tuple{
      key(&Sphere::center, "center", range::any, "centre"),
      key(&Sphere::radius, "radius", range::positive, "distance from centre to surface"),
  };
  static constexpr auto rules = no_rules;
};

struct Plane {
  Direction normal{0, 1, 0};
  Length offset;
};
template <>
struct Schema<Plane> {
  static constexpr std::string_view name = "plane";
  static constexpr std::string_view doc = "An unbounded plane.";
  static constexpr auto keys = std::tuple{
      key(&Plane::normal, "normal", range::any, "direction the outer side faces; normalised"),
      key(&Plane::offset, "offset", range::any, "signed distance from the origin along the normal"),
  };
  static constexpr auto rules = no_rules;
};

struct Triangle {
  std::array<Point3, 3> vertices;
  std::optional<std::array<Direction, 3>> normals;
  std::optional<std::array<Vec2, 3>> uvs;
};
template <>
struct Schema<Triangle> {
  static constexpr std::string_view name = "triangle";
  static constexpr std::string_view doc =
      "A triangle; counter-clockwise vertices face the viewer with their outer side.";
  static constexpr auto keys = std::tuple{
      required(&Triangle::vertices, "vertices", range::any, "the three corners"),
      key(&Triangle::normals, "normals", range::any, "shading normals at the corners"),
      key(&Triangle::uvs, "uvs", range::any, "texture coordinates at the corners"),
  };
  static constexpr auto rules = no_rules;
};

struct Quad {
  Point3 corner;
  Point3 edge_u;
  Point3 edge_v;
};
template <>
struct Schema<Quad> {
  static constexpr std::string_view name = "quad";
  static constexpr std::string_view doc = "A parallelogram; its outer side faces edge_u x edge_v.";
  static constexpr auto keys = std::tuple{
      required(&Quad::corner, "corner", range::any, "the corner with uv = (0, 0)"),
      required(&Quad::edge_u, "edge_u", range::any, "from the corner to uv = (1, 0)"),
      required(&Quad::edge_v, "edge_v", range::any, "from the corner to uv = (0, 1)"),
  };
  static constexpr auto rules = no_rules;
};

struct Disk {
  Point3 center;
  Direction normal;
  Length radius;
};
template <>
struct Schema<Disk> {
  static constexpr std::string_view name = "disk";
  static constexpr std::string_view doc = "A flat disk.";
  static constexpr auto keys = std::tuple{
      required(&Disk::center, "center", range::any, "centre"),
      required(&Disk::normal, "normal", range::any, "direction the outer side faces"),
      required(&Disk::radius, "radius", range::positive, "radius"),
  };
  static constexpr auto rules = no_rules;
};

struct Box {
  Point3 min;
  Point3 max;
};
template <>
struct Schema<Box> {
  static constexpr std::string_view name = "box";
  static constexpr std::string_view doc = "A box with its edges along the axes.";
  static constexpr auto keys = std::tuple{
      required(&Box::min, "min", range::any, "corner with the smallest coordinates"),
      required(&Box::max, "max", range::any, "corner with the largest coordinates"),
  };
  static constexpr auto rules = no_rules;
};

struct Cylinder {
  Point3 base;
  Point3 top;
  Length radius;
  bool capped = true;
};
template <>
struct Schema<Cylinder> {
  static constexpr std::string_view name = "cylinder";
  static constexpr std::string_view doc = "A circular cylinder between two points.";
  static constexpr auto keys = std::tuple{
      required(&Cylinder::base, "base", range::any, "centre of the base"),
      required(&Cylinder::top, "top", range::any, "centre of the top"),
      required(&Cylinder::radius, "radius", range::positive, "radius"),
      key(&Cylinder::capped, "capped", range::any, "whether base and top are closed by disks"),
  };
  static constexpr auto rules = no_rules;
};

enum class NormalMode : std::uint8_t { automatic, file, smooth, flat };
template <>
struct EnumNames<NormalMode> {
  static constexpr std::array<std::string_view, 4> names{"auto", "file", "smooth", "flat"};
};
// `.auto` takes the file's normals where it has them, else flat ones; inline meshes may list one
// normal a vertex instead of a mode.
struct MeshNormals {
  NormalMode mode = NormalMode::automatic;
  std::vector<Direction> list;
  friend auto operator<=>(const MeshNormals&, const MeshNormals&) = default;
};
using Face = std::vector<std::uint32_t>;  // three or more 0-based vertex indices

struct Mesh {
  AssetId file;
  std::optional<std::string> part;
  Length unit{1};
  MeshNormals normals;
  std::vector<Point3> vertices;
  std::vector<Face> faces;
  std::vector<Vec2> uvs;
};
template <>
struct Schema<Mesh> {
  static constexpr std::string_view name = "mesh";
  static constexpr std::string_view doc =
      "Triangles and polygons from an OBJ or PLY file, or listed inline.";
  static constexpr auto keys = std::tuple{
      key(&Mesh::file, "file", range::any, "OBJ or PLY file"),
      key(&Mesh::part, "part", range::any,
          "take the faces of this `usemtl` material or group of the file only"),
      key(&Mesh::unit, "unit", range::positive, "length of one unit of the file"),
      key(&Mesh::normals, "normals", range::any,
          "which shading normals to use, or one normal a vertex"),
      key(&Mesh::vertices, "vertices", range::any, "positions"),
      key(&Mesh::faces, "faces", range::any,
          "lists of 0-based vertex indices, counter-clockwise from outside"),
      key(&Mesh::uvs, "uvs", range::any, "one texture coordinate a vertex"),
  };
  static constexpr std::array rules{
      KeyRule{KeyRule::Kind::exactly_one, {"file", "vertices"}},
      KeyRule{KeyRule::Kind::together, {"vertices", "faces"}},
  };
};

enum class Axis : std::uint8_t { x, y, z };
template <>
struct EnumNames<Axis> {
  static constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
};
enum class RevolveSolver : std::uint8_t { certified, newton, tessellated };
template <>
struct EnumNames<RevolveSolver> {
  static constexpr std::array<std::string_view, 3> names{"certified", "newton", "tessellated"};
};
struct Revolve {
  Curve profile;
  Axis axis = Axis::y;
  RevolveSolver solver = RevolveSolver::certified;
  std::int64_t steps = 64;
};
template <>
struct Schema<Revolve> {
  static constexpr std::string_view name = "revolve";
  static constexpr std::string_view doc = "A profile curve turned about an axis.";
  static constexpr auto keys = std::tuple{
      required(&Revolve::profile, "profile", range::any, "curve of [radius, height] points"),
      key(&Revolve::axis, "axis", range::any, "axis of rotation through the origin"),
      key(&Revolve::solver, "solver", range::any, "how rays meet the surface"),
      key(&Revolve::steps, "steps", range::between(3, 65536),
          "steps round the axis when tessellated"),
  };
  static constexpr auto rules = no_rules;
};

// A placed copy of a proto. Its material, where given, replaces every material inside.
struct Instance {
  ProtoId of;
};
template <>
struct Schema<Instance> {
  static constexpr std::string_view name = "instance";
  static constexpr std::string_view doc = "A placed copy of a proto.";
  static constexpr auto keys = std::tuple{required(&Instance::of, "of", range::any, "the proto")};
  static constexpr auto rules = no_rules;
};

// The keys every shape, instance and group has besides its own.
struct Placing {
  MaterialId material;
  std::optional<Transform> transform;
};
template <>
struct Schema<Placing> {
  static constexpr std::string_view name = "item";
  static constexpr std::string_view doc = "Keys common to all placed items.";
  static constexpr auto keys = std::tuple{
      key(&Placing::material, "material", range::any, "what it is made of"),
      key(&Placing::transform, "transform", range::any,
          "a transform or a list of them, the first applied first"),
  };
  static constexpr auto rules = no_rules;
};

// The closed list of shapes; a new one is added here and in the backend's dispatch.
template <class... Ts>
struct TypeList {};
using ShapeTypes =
    TypeList<Sphere, Plane, Triangle, Quad, Disk, Box, Cylinder, Mesh, Revolve, Instance>;
using ShapeRef = std::variant<Id<Sphere>, Id<Plane>, Id<Triangle>, Id<Quad>, Id<Disk>, Id<Box>,
                              Id<Cylinder>, Id<Mesh>, Id<Revolve>, Id<Instance>>;

}  // namespace scenec::ir

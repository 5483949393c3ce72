// Objects of a course scene: groups, transforms and shapes, written as native items while they are
// read. Keeps the running `MaterialIndex` and remembers what glows, for lights that coincide.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frontend/course/materials.hpp"

namespace scenec::frontend::course {

// Native transforms, the first applied first.
using Operations = std::vector<Text>;

struct EmissiveSphere {
  std::array<double, 3> center;
  double radius = 0;
};
using EmissiveTriangle = std::array<std::array<double, 3>, 3>;

class Objects {
 public:
  Objects(Context& context, Materials& materials) : context_(context), materials_(materials) {}

  void write_scene(const Entry& group, Text& out);
  // One object that glows with a material of its own.
  void write_emitter(const Entry& object, const std::string& material, Text& out);

  [[nodiscard]] const std::vector<EmissiveSphere>& emissive_spheres() const {
    return emissive_spheres_;
  }
  [[nodiscard]] const std::vector<EmissiveTriangle>& emissive_triangles() const {
    return emissive_triangles_;
  }

 private:
  struct Target {
    Text& out;
    std::size_t indent = 0;
    const Operations& outer;
  };
  void write_members(const Entry& group, const Target& target);
  void set_material(const Entry& entry);
  void write_object(const Entry& entry, const Target& target);
  void write_group(const Entry& entry, const Target& target);
  void write_transform(const Entry& entry, const Target& target);
  [[nodiscard]] Text operation_of(const Entry& entry);
  void write_sphere(const Entry& entry, const Target& target);
  void write_plane(const Entry& entry, const Target& target);
  void write_triangle(const Entry& entry, const Target& target);
  void write_mesh(const Entry& entry, const Target& target);
  void write_tiny_obj(const Entry& entry, const Target& target);
  void write_obj_file(const Entry& file, bool phong, const Target& target);
  void write_rectangle(const Entry& entry, const Target& target);
  void write_corners(const Entry& entry, const Target& target);
  void write_disc(const Entry& entry, const Target& target);
  void write_revolve(const Entry& entry, const Target& target);
  void write_cage(const Entry& entry, const Target& target);
  void skip_curve(const Entry& entry);

  // Material and transform, then the item itself. A material is needed by the original reader for
  // some shapes only.
  enum class NeedsMaterial : std::uint8_t { no, yes };
  void finish(Item& item, const Entry& entry, const Operations& own, const Target& target,
              NeedsMaterial needs);
  void add_material(Item& item, const Entry& entry, NeedsMaterial needs);

  Context& context_;
  Materials& materials_;
  std::optional<std::size_t> material_;  // index into the materials
  Span material_span_;
  bool material_stated_ = false;  // a MaterialIndex was read, even one with a mistake
  std::string variant_;           // replaces the material of the next item
  std::string emitter_;           // replaces every material
  std::vector<EmissiveSphere> emissive_spheres_;
  std::vector<EmissiveTriangle> emissive_triangles_;
};

// The entries of a block by role, the last of each; reports the required ones that lack.
class Fields {
 public:
  Fields() = default;
  Fields(Context& context, const Entry& block, Place place, std::initializer_list<Role> required);
  [[nodiscard]] bool complete() const { return complete_; }
  // A word of the block had wrong values, which was reported.
  [[nodiscard]] bool had_mistakes() const { return had_mistakes_; }
  [[nodiscard]] const Entry* find(Role role) const;
  [[nodiscard]] const Entry& operator[](Role role) const { return *find(role); }  // a required one
  [[nodiscard]] double value(Role role, double otherwise) const;

 private:
  std::vector<Entry> entries_;
  bool complete_ = true;
  bool had_mistakes_ = false;
};

[[nodiscard]] std::array<double, 3> vector_of(const Entry& entry);
[[nodiscard]] Text transform_text(const Operations& operations);
// The profile of a RevSurface, or nullopt (reported).
[[nodiscard]] std::optional<Text> read_profile(Context& context, const Entry& profile);
// The control points of a curve: three numbers each, or two.
[[nodiscard]] std::optional<std::vector<std::vector<Number>>> read_controls(Context& context,
                                                                            const Entry& curve);

}  // namespace scenec::frontend::course

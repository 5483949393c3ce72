// Lights of a course scene: read when their block comes, written when the method is known and the
// glowing objects they may coincide with have been seen.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/course/objects.hpp"

namespace scenec::frontend::course {

class Lights {
 public:
  Lights(Context& context, Materials& materials, Objects& objects)
      : context_(context), materials_(materials), objects_(objects) {}

  void read(const Entry& block, Place place);
  // `inverse_pi`: the method's surfaces carry 1/pi, which course renderers leave out.
  void write(Text& out, bool inverse_pi);

 private:
  struct Light {
    Entry block;
    Fields fields;
  };
  void write_one(const Light& light, Text& out);
  void write_point(const Light& light, Text& out);
  void write_directional(const Light& light, Text& out);
  void write_sphere(const Light& light, Text& out);
  void write_disk(const Light& light, Text& out);
  void write_spot(const Light& light, Text& out);
  void write_axis_disk(const Light& light, Text& out);
  void write_axis_rect(const Light& light, Text& out);
  void write_rect(const Light& light, Text& out);
  void write_area(const Light& light, Text& out);
  void write_parallelogram(const Light& light, Text& out);
  void write_triangle(const Light& light, Text& out);
  void write_mesh(const Light& light, Text& out);
  void write_disk_of_area(const Light& light, Text& out);
  void write_object(const Light& light, Text& out);
  void write_skybox(const Light& light, Text& out);
  [[nodiscard]] bool require(const Light& light, std::initializer_list<Role> roles);
  [[nodiscard]] Text color_of_light(const Light& light) const;
  // The native key from the numbers of a word.
  static void add_list(Item& item, std::string_view key, const Light& light, Role role);
  static void add_number(Item& item, std::string_view key, const Light& light, Role role);
  // Strength of a point or spot light: power where it is given, else as the course has it.
  void add_power_or_unit(Item& item, const Entry* power) const;
  // The axis that `normal` names; nothing when it names none (reported).
  struct Axis;
  [[nodiscard]] std::optional<Axis> axis_of_normal(const Light& light);
  // radiance and colour, or power where it is given.
  void add_strength(Item& item, const Light& light) const;
  void finish(Item& item, const Light& light, Text& out) const;

  Context& context_;
  Materials& materials_;
  Objects& objects_;
  std::vector<Light> lights_;
  bool inverse_pi_ = false;
};

}  // namespace scenec::frontend::course

// The vocabulary of the course dialect, declared once in words.def: which word may stand where,
// what follows it, what it means. Reading, hints, the legal lists of messages and the manual's
// table are all derived from it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scenec::frontend::course {

// The kinds of block a word may stand in.
enum class Place : std::uint8_t {
  file,
  camera,
  model,
  background,
  lights,
  disk_lights,
  light,
  materials,
  material,
  noise,
  textures,
  group,
  sphere,
  moving_sphere,
  plane,
  triangle,
  mesh,
  rectangle,
  corners,
  disc,
  cage,
  revolve,
  curve,
  transform,
};
[[nodiscard]] std::string_view name_of(Place place);  // as messages say it: "a light"

// What a word means; synonyms share one.
enum class Role : std::uint8_t {
  ignored,
  ignored_block,
  count,
  color,
  position,
  direction,
  up,
  file,
  object,
  texture,
  // top level and settings
  camera,
  realistic_camera,
  background,
  lights,
  disk_lights,
  materials,
  textures,
  model,
  group,
  angle,
  width,
  height,
  aperture,
  inverse_aperture,
  lens_diameter,
  focus,
  has_lens,
  tracing,
  samples,
  // lights
  directional_light,
  point_light,
  sphere_light,
  area_light,
  disk_light,
  axis_disk_light,
  axis_rect_light,
  rect_light,
  spot_light,
  skybox,
  radius,
  radiance,
  area,
  edge_u,
  edge_v,
  vertex0,
  vertex1,
  vertex2,
  right,
  size,
  size_x,
  size_y,
  axis_x,
  axis_y,
  axis_z,
  two_sided,
  power,
  scale,
  falloff,
  // materials
  material_plain,
  material_diffuse,
  material_mirror,
  material_glass,
  material_glossy,
  material_metal,
  material_light,
  specular,
  shininess,
  normal_map,
  bump,
  noise,
  emission,
  lobe,
  weight_diffuse,
  weight_mirror,
  weight_glass,
  weight_glossy,
  transparent,
  refr,
  ior,
  ior_of_lobe,
  cauchy,
  reflect,
  refract,
  reflection,
  tint,
  attenuation,
  absorption,
  roughness,
  alpha,
  alpha_y,
  f0,
  metallic,
  kd,
  rho_d,
  rho_s,
  material_type,
  surface_type,
  octaves,
  // objects
  material_index,
  sphere,
  plane,
  triangle,
  mesh,
  transform,
  curve,
  revolve,
  obj_material_type,
  obj_file,
  tiny_obj,
  moving_sphere,
  rectangle,
  corners,
  disc,
  cage,
  theta,
  offset,
  smooth,
  minimum,
  maximum,
  profile,
  points,
  uniform_scale,
  translate,
  rotate_x,
  rotate_y,
  rotate_z,
  rotate,
  matrix,
};

// What may follow a word; a set.
enum class Values : std::uint16_t {
  flag = 1,  // nothing
  number = 2,
  vec2 = 4,
  vec3 = 8,
  word = 16,          // one word: a file or a name
  file_numbers = 32,  // a file, then any count of numbers
  block = 64,
  object = 128,  // the word of an object, then its block
  points = 256,  // [ x y z ] ..., or a count and then numbers
  braced = 512,  // { numbers }
};
[[nodiscard]] constexpr Values operator|(Values a, Values b) {
  return static_cast<Values>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
[[nodiscard]] constexpr bool allows(Values set, Values one) {
  return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}
[[nodiscard]] std::string text_of(Values set);  // "a number or 3 numbers"

// What a word says about the method of its scene; the highest one found decides.
enum class Vocabulary : std::uint8_t { base, neutral, whitted, path };
enum class Treat : std::uint8_t { plain, chosen, ignored };

struct Word {
  Place place;
  std::string_view text;
  Role role;
  Values values;
  Vocabulary vocabulary;
  Treat treat;
  std::string_view reading;
  std::string_view found;  // lineage and number of repositories, for the manual
};

[[nodiscard]] std::span<const Word> all_words();
// The word of a place, or null. In a transform the objects of a group are words too.
[[nodiscard]] const Word* find_word(Place place, std::string_view text);
[[nodiscard]] std::vector<std::string_view> words_of(Place place);
// The reading of a word followed by such values.
[[nodiscard]] std::string_view reading_for(const Word& word, Values form);

}  // namespace scenec::frontend::course

// Materials of a course scene: read when their block comes, written when the method is known.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "frontend/course/assets.hpp"
#include "frontend/course/context.hpp"
#include "frontend/course/obj_materials.hpp"
#include "frontend/course/reader.hpp"
#include "frontend/course/writer.hpp"

namespace scenec::frontend::course {

// An image in the place of a colour.
struct TextureUse {
  std::string path;
  Span span;
  std::vector<Number> repeat;  // none or two
};

struct MaterialData {
  Role kind = Role::material_plain;
  std::string_view word;  // of its block
  Span word_span;
  Span span;  // word and block
  std::map<Role, Entry> entries;
  std::optional<TextureUse> texture;
  std::optional<TextureUse> normal_map;
  std::vector<Entry> noise_colors;
  std::map<Role, Entry> noise;

  [[nodiscard]] const Entry* find(Role role) const {
    const auto found = entries.find(role);
    return found == entries.end() ? nullptr : &found->second;
  }
  [[nodiscard]] double value(Role role, double otherwise) const {
    const Entry* const entry = find(role);
    return entry == nullptr || entry->numbers.empty() ? otherwise : entry->numbers.front().value;
  }
};

// A material that is not in the `Materials` block: of an MTL, or of a light that is a shape.
struct ExtraMaterial {
  std::string name;
  Item item;
};

class Materials {
 public:
  explicit Materials(Context& context) : context_(context) {}

  void read_textures(const Entry& block);
  void read(const Entry& block);
  [[nodiscard]] std::size_t size() const { return materials_.size(); }
  // The name of a material, which then counts as used.
  [[nodiscard]] std::string use(std::size_t index);
  [[nodiscard]] bool is_emissive(std::size_t index) const;
  // The same material with another texture; its name.
  [[nodiscard]] std::string add_variant(std::size_t index, TextureUse texture);
  [[nodiscard]] std::string add_obj_material(const ObjMaterial& material, bool phong, Span origin);
  // A black surface that glows; its name.
  [[nodiscard]] std::string add_emitter(const Text& radiance, Span origin);
  [[nodiscard]] std::optional<TextureUse> read_texture(const Entry& entry);

  void write(Text& out, bool physical) const;  // physical: method .path

 private:
  void read_one(const Entry& entry);
  void read_noise(MaterialData& material, grammar::NodeRef block);
  void check_required(const MaterialData& material);

  Context& context_;
  std::vector<MaterialData> materials_;
  std::set<std::size_t> used_;
  std::vector<std::pair<std::string, MaterialData>> variants_;
  std::vector<ExtraMaterial> extras_;
  std::vector<std::optional<TextureUse>> textures_;
};

[[nodiscard]] Text image_text(const Context& context, const TextureUse& texture);
// The items of one material: itself, and before it those it mixes.
[[nodiscard]] std::vector<Item> items_of(const Context& context, const MaterialData& material,
                                         const std::string& name, bool physical);
// The lobe a `type` names: 0 diffuse, 1 mirror, 2 glass, 3 glossy, 4 light.
[[nodiscard]] std::optional<int> find_lobe(std::string_view name);

}  // namespace scenec::frontend::course

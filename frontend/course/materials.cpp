#include "frontend/course/materials.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/counts.hpp"
#include "frontend/course/native_text.hpp"

namespace scenec::frontend::course {

namespace {

bool is_zero(const Entry& entry) {
  return std::all_of(entry.numbers.begin(), entry.numbers.end(),
                     [](const Number& n) { return n.value == 0; });
}

constexpr std::array<std::string_view, 7> lobe_words{"DIFF",  "SPEC", "REFR", "GLOS",
                                                     "METAL", "REFL", "LIGHT"};

}  // namespace

std::optional<int> find_lobe(std::string_view name) {
  static constexpr std::array<int, lobe_words.size()> lobes{0, 1, 2, 3, 1, 1, 4};
  for (std::size_t i = 0; i < lobe_words.size(); ++i) {
    if (lobe_words[i] == name) return lobes[i];
  }
  return std::nullopt;
}

std::optional<TextureUse> Materials::read_texture(const Entry& entry) {
  if (entry.name.empty()) {
    const double index = entry.numbers.front().value;
    if (textures_.empty() || index < 0) return std::nullopt;  // -1, or the flag of one author
    if (index != std::floor(index) || index >= static_cast<double>(textures_.size())) {
      context_.error(DiagnosticKind::course_wrong_values, entry.numbers.front().span,
                     fmt::format("there is no texture {}; `Textures` has {}",
                                 short_number_text(index), textures_.size()));
      return std::nullopt;
    }
    return textures_[static_cast<std::size_t>(index)];
  }
  const std::string path = find_asset(context_, entry.name, entry.name_span);
  TextureUse texture{path, entry.name_span, {}};
  if (entry.numbers.size() == 2) {
    texture.repeat = entry.numbers;
  } else if (!entry.numbers.empty()) {
    context_.warn_once(
        DiagnosticKind::course_ignored_word, "texture numbers", entry.values_span(),
        "the numbers that place the texture have no effect: surfaces use their own uv");
  }
  return texture;
}

void Materials::read_textures(const Entry& block) {
  read_counted(context_, block, Place::textures, "numTextures", "texture",
               [&](const Entry& entry) { textures_.push_back(read_texture(entry)); });
}

void Materials::read(const Entry& block) {
  read_counted(context_, block, Place::materials, "numMaterials", "material",
               [&](const Entry& entry) { read_one(entry); });
}

void Materials::read_one(const Entry& block) {
  MaterialData material;
  material.kind = block.role();
  material.word = block.word->text;
  material.word_span = block.word_span;
  material.span = join(block.word_span, block.block.span());
  BlockReader reader(context_, block.block, Place::material);
  while (const auto entry = reader.next()) {
    switch (entry->role()) {
      case Role::texture:
        material.texture = read_texture(*entry);
        continue;
      case Role::normal_map:
        material.normal_map = read_texture(*entry);
        continue;
      case Role::bump:
        (void)read_texture(*entry);
        continue;  // unused, yet it must be there
      case Role::noise:
        read_noise(material, entry->block);
        continue;
      case Role::lobe:
        if (!entry->name.empty() && !find_lobe(entry->name)) {
          context_.error(DiagnosticKind::course_wrong_values, entry->name_span,
                         fmt::format("`{}` is no type of material; known are {}",
                                     printable(entry->name), quoted_list(lobe_words)));
          continue;
        }
        break;
      default:
        break;
    }
    const auto [found, added] = material.entries.insert_or_assign(entry->role(), *entry);
    if (!added) {
      context_.warn_once(
          DiagnosticKind::course_repeated_word, entry->word->text, entry->word_span,
          fmt::format("`{}` replaces an earlier value in this material", entry->word->text));
    }
  }
  check_required(material);
  materials_.push_back(std::move(material));
}

void Materials::read_noise(MaterialData& material, grammar::NodeRef block) {
  BlockReader reader(context_, block, Place::noise);
  while (const auto entry = reader.next()) {
    if (entry->role() == Role::color) {
      material.noise_colors.push_back(*entry);
    } else {
      material.noise.insert_or_assign(entry->role(), *entry);
    }
  }
}

void Materials::check_required(const MaterialData& material) {
  const bool rough =
      material.kind == Role::material_glossy || material.kind == Role::material_metal;
  if (rough && material.find(Role::roughness) == nullptr && material.find(Role::alpha) == nullptr) {
    context_.error(DiagnosticKind::course_missing_word, material.word_span,
                   fmt::format("`{}` lacks `roughness`", material.word));
  }
  if (const Entry* const type = material.find(Role::lobe);
      type != nullptr && type->numbers.size() == 1) {
    const double value = type->numbers.front().value;
    if (value != 0 && value != 1 && value != 2 && value != 3) {
      context_.error(DiagnosticKind::course_wrong_values, type->numbers.front().span,
                     "this type of material has no reading; known are 0 (diffuse), 1 (mirror), 2 "
                     "(glass), 3 (light)");
    }
  }
}

namespace {

std::string name_of_material(std::size_t index) {
  return fmt::format("m{}", index);
}

}  // namespace

std::string Materials::use(std::size_t index) {
  used_.insert(index);
  return name_of_material(index);
}

bool Materials::is_emissive(std::size_t index) const {
  if (index >= materials_.size()) return false;
  const Entry* const emission = materials_[index].find(Role::emission);
  return emission != nullptr && !is_zero(*emission);
}

std::string Materials::add_variant(std::size_t index, TextureUse texture) {
  const std::string name = fmt::format("m{}_textured{}", index, variants_.size());
  MaterialData copy = materials_[index];
  copy.texture = std::move(texture);
  variants_.emplace_back(name, std::move(copy));
  return name;
}

std::string Materials::add_obj_material(const ObjMaterial& material, bool phong, Span origin) {
  ExtraMaterial extra;
  extra.name = fmt::format("obj{}", extras_.size());
  extra.item.origin = origin;
  extra.item.head.put("material ").put(extra.name).put(phong ? ": phong" : ": diffuse");
  Text color = color_of_values(material.diffuse, origin);
  if (material.texture) color = image_text(context_, {*material.texture, origin, {}});
  extra.item.add(phong ? "diffuse" : "color", color);
  if (phong) {
    extra.item.add("specular", color_of_values(material.specular, origin));
    extra.item.add("shininess", text_of_value(material.shininess, origin));
  }
  if (material.texture && extension_of(*material.texture) == ".png") {
    Text alpha = image_text(context_, {*material.texture, origin, {}});
    extra.item.add("opacity", alpha.put(".alpha"));
    extra.item.add("cutout", "0.5");
  }
  if (material.glows()) {
    extra.item.add("emission", color_of_values(material.emission, origin));
    extra.item.add("two_sided", "true");
  }
  extras_.push_back(extra);
  return extra.name;
}

std::string Materials::add_emitter(const Text& radiance, Span origin) {
  ExtraMaterial extra;
  extra.name = fmt::format("light{}", extras_.size());
  extra.item.origin = origin;
  extra.item.head.put("material ").put(extra.name).put(": diffuse");
  extra.item.add("color", "black");
  extra.item.add("emission", radiance);
  extra.item.add("two_sided", "true");
  extras_.push_back(extra);
  return extra.name;
}

void Materials::write(Text& out, bool physical) const {
  const auto put_all = [&](const MaterialData& material, const std::string& name, bool used) {
    const std::vector<Item> items = items_of(context_, material, name, physical);
    for (const Item& item : items) {
      // Course files list materials that no object takes: their authors copied the handout's list.
      if (!used && &item == &items.back()) out.put("@allow(unused_declaration)\n");
      write_item(out, item, 0);
    }
  };
  for (std::size_t i = 0; i < materials_.size(); ++i)
    put_all(materials_[i], name_of_material(i), used_.contains(i));
  for (const auto& [name, material] : variants_) put_all(material, name, true);
  for (const ExtraMaterial& extra : extras_) write_item(out, extra.item, 0);
}

}  // namespace scenec::frontend::course

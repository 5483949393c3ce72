// Materials as native items: each lobe a material, several lobes mixed.
#include <cmath>

#include <fmt/format.h>

#include "frontend/course/lobes.hpp"
#include "frontend/course/materials.hpp"
#include "frontend/course/native_text.hpp"

namespace scenec::frontend::course {

namespace {

class LobeWriter {
 public:
  LobeWriter(const Context& context, const MaterialData& material, bool physical, double factor)
      : context_(context), material_(material), physical_(physical), factor_(factor) {}

  [[nodiscard]] Item item(const std::string& name, LobeKind kind) const {
    Item item;
    item.origin = material_.span;
    item.head.put("material ").put(name, material_.word_span).put(": ");
    switch (kind) {
      case LobeKind::diffuse:
        write_diffuse(item);
        break;
      case LobeKind::mirror:
        write_mirror(item);
        break;
      case LobeKind::glass:
        write_glass(item);
        break;
      case LobeKind::glossy:
        write_glossy(item);
        break;
      case LobeKind::phong:
        write_phong(item);
        break;
    }
    if (material_.normal_map) item.add("normal_map", image_text(context_, *material_.normal_map));
    return item;
  }

 private:
  // The colour of a role, scaled; white when missing.
  [[nodiscard]] Text color(const Entry* entry, double factor) const {
    factor *= factor_;
    if (entry == nullptr || entry->numbers.empty()) {
      return color_of_values(std::array{factor, factor, factor}, material_.word_span);
    }
    if (factor == 1) return color_of(entry->numbers);
    return color_of(entry->numbers).put(" * ").put(text_of_value(factor));
  }

  // The diffuse colour: a pattern or texture where there is one.
  [[nodiscard]] Text surface_color(double factor = 1) const {
    Text text;
    if (material_.texture) {
      text = image_text(context_, *material_.texture);
    } else if (material_.noise_colors.size() == 2) {
      text = noise();
    } else {
      return color(material_.find(Role::color), factor);
    }
    if (factor * factor_ != 1) text.put(" * ").put(text_of_value(factor * factor_));
    return text;
  }

  [[nodiscard]] Text noise() const {
    Text text("fractal(");
    const auto scale = material_.noise.find(Role::scale);
    text.put(scale == material_.noise.end() ? Text("1") : text_of(scale->second.numbers[0]));
    const auto octaves = material_.noise.find(Role::octaves);
    if (octaves != material_.noise.end())
      text.put(", octaves = ").put(text_of(octaves->second.numbers[0]));
    text.put(", a = ").put(color_of(material_.noise_colors[0].numbers));
    text.put(", b = ").put(color_of(material_.noise_colors[1].numbers)).put(")");
    return text;
  }

  void write_diffuse(Item& item) const {
    item.head.put("diffuse");
    if (material_.kind == Role::material_light) {
      item.add("color", "black");
    } else {
      item.add("color", surface_color());
    }
  }

  [[nodiscard]] const Entry* mirror_color() const {
    const Entry* const specular = material_.find(Role::specular);
    if (specular != nullptr && !all_zero(*specular)) return specular;
    if (const Entry* const attenuation = material_.find(Role::attenuation)) return attenuation;
    return material_.find(Role::color);
  }

  void write_mirror(Item& item) const {
    const bool rough = material_.value(Role::roughness, 0) > 0;
    item.head.put(rough ? "conductor" : "mirror");
    item.add(rough ? "f0" : "color", color(mirror_color(), 1));
    if (rough) add_roughness(item);
  }

  [[nodiscard]] Text ior() const {
    for (const Role role : {Role::ior, Role::ior_of_lobe, Role::refr}) {
      const Entry* const entry = material_.find(role);
      const bool fraction = role == Role::refr && material_.find(Role::lobe) == nullptr &&
                            entry != nullptr && entry->numbers[0].value <= 1;
      if (entry != nullptr && !fraction && entry->numbers[0].value != 0)
        return text_of(entry->numbers[0]);
    }
    if (const Entry* const cauchy = material_.find(Role::cauchy)) {
      constexpr double sodium_micrometres = 0.5893;
      return text_of_value(cauchy->numbers[0].value +
                               cauchy->numbers[1].value / (sodium_micrometres * sodium_micrometres),
                           cauchy->values_span());
    }
    return "1.5";
  }

  void write_glass(Item& item) const {
    item.head.put("dielectric");
    item.add("ior", ior());
    const Entry* tint = material_.find(Role::tint);
    if (tint == nullptr) tint = material_.find(Role::attenuation);
    if (tint == nullptr) tint = material_.find(Role::color);
    if (tint != nullptr || factor_ != 1) item.add("tint", color(tint, 1));
    const Entry* const absorption = material_.find(Role::absorption);
    if (absorption != nullptr && !all_zero(*absorption))
      item.add("absorption", color_of(absorption->numbers));
  }

  void add_roughness(Item& item) const {
    if (const Entry* const roughness = material_.find(Role::roughness)) {
      item.add("roughness", text_of(roughness->numbers[0]), roughness->span);
    } else if (const Entry* const alpha = material_.find(Role::alpha)) {
      const double along = alpha->numbers[0].value;
      const double mean = std::sqrt(along * material_.value(Role::alpha_y, along));
      item.add("roughness", text_of_value(std::sqrt(mean), alpha->values_span()), alpha->span);
    } else {
      item.add("roughness", "0.3");
    }
  }

  void write_metal(Item& item, const Entry* f0, double factor) const {
    item.head.put("conductor");
    item.add("f0", color(f0, factor));
    add_roughness(item);
  }

  void write_glossy(Item& item) const {
    const Entry* const base = material_.find(Role::color);
    const Entry* const f0 = material_.find(Role::f0);
    const double metallic = material_.value(Role::metallic, 0);
    const double kd =
        material_.value(Role::kd, material_.find(Role::material_type) != nullptr ? 0 : 1);
    const bool black_base = !material_.texture && (kd == 0 || (base != nullptr && all_zero(*base)));
    if (material_.kind == Role::material_metal || metallic >= 1) return write_metal(item, base, 1);
    if (black_base && f0 != nullptr) return write_metal(item, f0, 1);
    item.head.put("ggx");
    item.add("base", surface_color(kd * material_.value(Role::rho_d, 1) * (1 - metallic)));
    write_f0(item, f0, base, metallic);
    add_roughness(item);
  }

  void write_f0(Item& item, const Entry* f0, const Entry* base, double metallic) const {
    const double rho_s = material_.value(Role::rho_s, 1);
    if (f0 != nullptr) {
      item.add("f0", color(f0, rho_s), f0->span);
    } else if (material_.find(Role::rho_s) != nullptr) {
      item.add("f0", color_of_values(std::array{rho_s, rho_s, rho_s},
                                     material_.find(Role::rho_s)->values_span()));
    } else if (metallic > 0 && base != nullptr) {
      std::vector<double> values;
      values.reserve(base->numbers.size());
      for (const Number& number : base->numbers)
        values.push_back(0.04 * (1 - metallic) + number.value * metallic);
      item.add("f0", color_of_values(values, base->values_span()));
    } else if (const Entry* const eta = material_.find(Role::ior_of_lobe)) {
      const double ratio = (eta->numbers[0].value - 1) / (eta->numbers[0].value + 1);
      item.add("f0", color_of_values(std::array{ratio * ratio, ratio * ratio, ratio * ratio},
                                     eta->values_span()));
    } else if (const Entry* const specular = material_.find(Role::specular)) {
      item.add("f0", color_of(specular->numbers), specular->span);
    }
  }

  void write_phong(Item& item) const {
    const Entry* const specular = material_.find(Role::specular);
    const Entry* const reflect = reflect_entry();
    const Entry* refract = material_.find(Role::refract);
    if (refract == nullptr && reflect == nullptr && material_.find(Role::ior) != nullptr)
      refract = specular;
    const Entry* const rho_s = material_.find(Role::rho_s);
    const bool shiny = rho_s != nullptr || (specular != nullptr && !all_zero(*specular));
    if (physical_ && !shiny && reflect == nullptr && refract == nullptr) {
      item.head.put("diffuse");
      item.add("color", surface_color(material_.value(Role::rho_d, 1)));
      return;
    }
    item.head.put("phong");
    item.add("diffuse", surface_color(material_.value(Role::rho_d, 1)));
    if (rho_s != nullptr) {
      item.add("specular", color(material_.find(Role::color), rho_s->numbers[0].value));
    } else if (specular != nullptr) {
      item.add("specular", color_of(specular->numbers), specular->span);
    }
    if (specular != nullptr || rho_s != nullptr) {
      const Entry* const shininess = material_.find(Role::shininess);
      item.add("shininess", shininess == nullptr ? Text("0") : text_of(shininess->numbers[0]),
               shininess == nullptr ? Span{} : shininess->span);
    }
    if (reflect != nullptr) item.add("reflect", color_of(reflect->numbers), reflect->span);
    if (refract != nullptr) {
      item.add("refract", color_of(refract->numbers), refract->span);
      item.add("ior", ior());
    }
  }

  [[nodiscard]] const Entry* reflect_entry() const {
    if (const Entry* const reflect = material_.find(Role::reflect)) return reflect;
    const Entry* const reflection = material_.find(Role::reflection);
    return reflection != nullptr && reflection->numbers.size() == 3 ? reflection : nullptr;
  }

  static bool all_zero(const Entry& entry) {
    for (const Number& number : entry.numbers) {
      if (number.value != 0) return false;
    }
    return true;
  }

  const Context& context_;
  const MaterialData& material_;
  bool physical_;
  double factor_;
};

void add_emission(Item& item, const MaterialData& material) {
  const Entry* emission = material.find(Role::emission);
  const Entry* const type = material.find(Role::lobe);
  const bool light_type =
      type != nullptr &&
      ((type->numbers.size() == 1 && type->numbers[0].value == 3) || type->name == "LIGHT");
  if (emission == nullptr && light_type) emission = material.find(Role::specular);
  if (emission == nullptr) return;
  bool any = false;
  for (const Number& number : emission->numbers) any = any || number.value != 0;
  if (!any) return;
  item.add("emission", color_of(emission->numbers), emission->span);
  item.add("two_sided", "true", emission->word_span);
}

}  // namespace

Text image_text(const Context& context, const TextureUse& texture) {
  Text text("image(");
  text.put(path_text(context, texture.path, texture.span));
  if (!texture.repeat.empty()) text.put(", scale = ").put(list_of(texture.repeat));
  text.put(")");
  text.cover(0, texture.span);
  return text;
}

std::vector<Item> items_of(const Context& context, const MaterialData& material,
                           const std::string& name, bool physical) {
  const Lobes lobes = lobes_of(material);
  const LobeWriter writer(context, material, physical, lobes.factor);
  std::vector<Item> items;
  if (lobes.list.size() == 1) {
    items.push_back(writer.item(name, lobes.list[0].kind));
  } else {
    for (const Lobe& lobe : lobes.list) {
      const auto kind = static_cast<std::size_t>(lobe.kind);
      items.push_back(writer.item(fmt::format("{}_{}", name, lobe_names[kind]), lobe.kind));
    }
    // The first with the rest, the rest the same way: weights relative to what is left.
    std::string rest =
        fmt::format("{}_{}", name, lobe_names[static_cast<std::size_t>(lobes.list.back().kind)]);
    double rest_weight = lobes.list.back().weight;
    for (std::size_t i = lobes.list.size() - 1; i-- > 0;) {
      const double sum = rest_weight + lobes.list[i].weight;
      const std::string mixed = i == 0 ? name : fmt::format("{}_rest{}", name, i);
      Item item;
      item.origin = material.span;
      item.head.put("material ").put(mixed, material.word_span).put(": mix");
      item.add("a", Text(fmt::format("{}_{}", name,
                                     lobe_names[static_cast<std::size_t>(lobes.list[i].kind)])));
      item.add("b", Text(rest));
      item.add("weight", text_of_value(rest_weight / sum, material.word_span));
      items.push_back(std::move(item));
      rest = mixed;
      rest_weight = sum;
    }
  }
  add_emission(items.back(), material);
  return items;
}

}  // namespace scenec::frontend::course

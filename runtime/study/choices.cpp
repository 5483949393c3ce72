#include "runtime/study/choices.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "backend/materials/fresnel.hpp"
#include "backend/materials/metals.hpp"

namespace scenec::runtime {

namespace {

// Paths that never end by chance have to end somewhere: here, unless the scene says where.
constexpr std::int64_t fixed_depths[] = {8, 32};
constexpr std::string_view only_path = "the scene's method is not `.path`";

// A metal whose reflectance follows from measured indices.
std::optional<backend::MetalIndices> indices_of(const ir::Conductor& metal) {
  if (metal.f0) return std::nullopt;
  if (metal.preset) return backend::indices_of(*metal.preset);
  if (!metal.eta || !metal.k) return std::nullopt;
  return backend::MetalIndices{{metal.eta->r, metal.eta->g, metal.eta->b},
                               {metal.k->r, metal.k->g, metal.k->b}};
}

template <class Kind>
std::vector<const Kind*> materials_of(const ir::Scene& scene) {
  std::vector<const Kind*> found;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    const auto* kind = std::get_if<Kind>(&scene.materials[ir::MaterialId(i)].kind);
    if (kind != nullptr) found.push_back(kind);
  }
  return found;
}

bool has_measured_metal(const ir::Scene& scene) {
  const auto metals = materials_of<ir::Conductor>(scene);
  return std::any_of(metals.begin(), metals.end(),
                     [](const ir::Conductor* metal) { return indices_of(*metal).has_value(); });
}

// Schlick's approximation stands for Fresnel's equations where a metal is told by f0 alone.
void use_schlick(ir::Scene& scene) {
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    auto* metal = std::get_if<ir::Conductor>(&scene.materials[ir::MaterialId(i)].kind);
    const auto n = metal != nullptr ? indices_of(*metal) : std::nullopt;
    if (!n) continue;
    metal->f0 = ir::ColorInput{{backend::fresnel_conductor(1, n->eta.r, n->k.r),
                                backend::fresnel_conductor(1, n->eta.g, n->k.g),
                                backend::fresnel_conductor(1, n->eta.b, n->k.b)},
                               {}};
  }
}

// A choice among the settings of the render.
Choice setting(std::string name, std::string what,
               std::function<void(ir::RenderSettings&)> change) {
  return {.name = std::move(name),
          .what = std::move(what),
          .why_not = {},
          .set = [change = std::move(change)](Variant& variant) { change(variant.settings); }};
}

class ChoiceList {
 public:
  ChoiceList(const ir::Scene& scene, const Variant& base) : scene_(scene), base_(base) {}

  std::vector<Choice> made() && {
    add(setting("again", "the same once more: what no change looks like", [](auto&) {}));
    add_light_finding();
    add_numbers();
    add_path_lengths();
    add_filters();
    for (const double times : {3.0, 10.0, 30.0}) {
      add({.name = "clamp at " + std::to_string(static_cast<int>(times)) + " × mean",
           .what = "no sample brighter than so many times the mean of the picture",
           .why_not = {},
           .clamp = times});
    }
    add({.name = "--adaptive",
         .what = "more samples where the error is",
         .why_not = {},
         .set = [](Variant& v) { v.spread = backend::SampleSpread::adaptive; }});
    add_arithmetic();
    add_solvers();
    return std::move(list_);
  }

 private:
  void add(Choice choice) { list_.push_back(std::move(choice)); }
  [[nodiscard]] bool is_path() const { return base_.settings.method == ir::Method::path; }

  void add_light_finding() {
    const backend::LightTable& lights = base_.scene->lights;
    const bool has_extent = !lights.emitters.empty() || !lights.environments.empty();
    const std::string_view why_not = !is_path()    ? only_path
                                     : !has_extent ? "no light has an extent: all are aimed at, "
                                                     "none is met by chance"
                                                   : "";
    const auto by = [](backend::LightFinding finding) {
      return [finding](backend::RenderScene& built) { built.lights.finding = finding; };
    };
    add({.name = "light by aiming only",
         .what = "next-event estimation without multiple importance sampling",
         .why_not = std::string(why_not),
         .adjust = by(backend::LightFinding::aiming)});
    // Light without extent is not met by chance at all: every way has to aim at it.
    add({.name = "light by chance only",
         .what = "scattered rays find lights; nothing aims at them",
         .why_not = std::string(why_not),
         .adjust = by(backend::LightFinding::chance)});
  }

  void add_numbers() {
    const bool sobol = base_.settings.sampler == ir::SamplerKind::sobol;
    add(setting(sobol ? "sampler .independent" : "sampler .sobol", "other random numbers",
                [sobol](ir::RenderSettings& s) {
                  s.sampler = sobol ? ir::SamplerKind::independent : ir::SamplerKind::sobol;
                }));
  }

  void add_path_lengths() {
    for (const std::int64_t depth : {2, 4, 8}) {
      add(setting("max_depth " + std::to_string(depth), "paths cut off at a fixed depth",
                  [depth](ir::RenderSettings& s) { s.max_depth = depth; }));
    }
    const std::string why_not(is_path() ? "" : only_path);
    const auto never = [](backend::RenderScene& built) {
      built.sure_bounces = std::numeric_limits<std::uint32_t>::max();
    };
    if (base_.settings.max_depth) {
      add({.name = "roulette off",
           .what = "no path ends by chance: all go on to the depth the scene asks for",
           .why_not = why_not,
           .adjust = never});
      return;
    }
    for (const std::int64_t depth : fixed_depths) {
      add({.name = "roulette off, max_depth " + std::to_string(depth),
           .what = "no path ends by chance: all go on to a fixed depth, where they are cut off",
           .why_not = why_not,
           .set = [depth](Variant& variant) { variant.settings.max_depth = depth; },
           .adjust = never});
    }
  }

  void add_filters() {
    for (const ir::FilterKind kind :
         {ir::FilterKind::box, ir::FilterKind::gaussian, ir::FilterKind::mitchell}) {
      if (kind == base_.settings.filter.kind) continue;
      const auto name = ir::EnumNames<ir::FilterKind>::names[static_cast<std::size_t>(kind)];
      add(setting("filter ." + std::string(name), "another pixel filter",
                  [kind](ir::RenderSettings& s) { s.filter = {kind, ir::usual_radius(kind)}; }));
    }
  }

  void add_arithmetic() {
    add({.name = "--precision double",
         .what = "vertices of meshes in double",
         .why_not = base_.scene->meshes.empty() ? "no mesh in this scene" : "",
         .build = {.precision = backend::Precision::full}});
    add({.name = "Fresnel by Schlick",
         .what = "metals by their reflectance at normal incidence",
         .why_not =
             has_measured_metal(scene_) ? "" : "no metal with measured indices in this scene",
         .rewrite = use_schlick});
    add({.name = "energy compensation off",
         .what = "light that bounces between the facets of rough metals and coats is lost",
         .why_not = base_.scene->ggx_albedo ? "" : "no metal and no coated material in this scene",
         .adjust = [](backend::RenderScene& built) {
           built.ggx_albedo->lost_light = backend::LostLight::left_out;
         }});
  }

  void add_solvers() {
    const bool has_revolve = scene_.table<ir::Revolve>().size() > 0;
    const auto solver = [&](std::string name, ir::RevolveSolver kind, std::int64_t steps) {
      add({.name = "solver " + std::move(name),
           .what = "another way to meet surfaces of revolution",
           .why_not = has_revolve ? "" : "no body of revolution in this scene",
           .rewrite = [kind, steps](ir::Scene& scene) {
             auto& revolves = std::get<Table<ir::Revolve>>(scene.shapes);
             for (std::uint32_t i = 0; i < revolves.size(); ++i) {
               revolves[Id<ir::Revolve>(i)].solver = kind;
               revolves[Id<ir::Revolve>(i)].steps = steps;
             }
           }});
    };
    solver(".certified", ir::RevolveSolver::certified, 64);
    solver(".newton", ir::RevolveSolver::newton, 64);
    for (const std::int64_t steps : {16, 64, 256})
      solver(".tessellated, " + std::to_string(steps) + " steps", ir::RevolveSolver::tessellated,
             steps);
  }

  const ir::Scene& scene_;
  const Variant& base_;
  std::vector<Choice> list_;
};

}  // namespace

std::vector<Choice> effects_left_out(const Variant& base) {
  std::vector<Choice> list;
  for (std::size_t i = 0; i < ir::effect_count; ++i) {
    const auto effect = static_cast<ir::Effect>(i);
    if (!base.effects.has(effect)) continue;
    list.push_back({.name = std::string(name_of(effect)),
                    .what = std::string(doc_of(effect)),
                    .why_not = {},
                    .set = [effect](Variant& variant) { variant.effects.remove(effect); }});
  }
  return list;
}

std::vector<Choice> other_choices(const ir::Scene& scene, const Variant& base) {
  return ChoiceList(scene, base).made();
}

}  // namespace scenec::runtime

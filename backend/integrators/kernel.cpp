// The list of compiled kernels: each stands in a file of its own in kernels/.
#include "backend/integrators/kernel.hpp"

#include <algorithm>
#include <array>

#include "backend/integrators/tile-inl.hpp"

namespace scenec::backend {

using TileFunction = bool (*)(const TileJob&, Film&, const Tile&, const SampleRange&, KernelWorker&,
                              const std::stop_token&);

#define SCENEC_KERNEL(method, name)                                          \
  extern template bool render_tile<ir::Method::method, kernel_masks::name>(  \
      const TileJob&, Film&, const Tile&, const SampleRange&, KernelWorker&, \
      const std::stop_token&);
#define SCENEC_PROBING_KERNEL(method, name) SCENEC_KERNEL(method, name)
#include "backend/integrators/kernels.def"
#undef SCENEC_KERNEL

namespace {

struct Kernel {
  KernelInfo info;
  TileFunction run;
};

constexpr std::array kernels{
#define SCENEC_KERNEL(method, name)                       \
  Kernel{{ir::Method::method, #name, kernel_masks::name}, \
         render_tile<ir::Method::method, kernel_masks::name>},
#include "backend/integrators/kernels.def"
#undef SCENEC_KERNEL
};

// One a method: they may do all that the full kernels do.
constexpr std::array probing_kernels{
#define SCENEC_KERNEL(method, name)
#define SCENEC_PROBING_KERNEL(method, name)               \
  Kernel{{ir::Method::method, #name, kernel_masks::name}, \
         render_tile<ir::Method::method, kernel_masks::name>},
#include "backend/integrators/kernels.def"
#undef SCENEC_KERNEL
};

const Kernel& choose(ir::Method method, EffectMask effects, KernelChoice choice) {
  if (choice == KernelChoice::probing) {
    return *std::find_if(probing_kernels.begin(), probing_kernels.end(),
                         [&](const Kernel& kernel) { return kernel.info.method == method; });
  }
  const Kernel* chosen = nullptr;
  for (const Kernel& kernel : kernels) {
    if (kernel.info.method != method) continue;
    const bool holds = (effects & ~kernel.info.mask) == 0;
    if (!holds) continue;
    chosen = &kernel;
    if (choice == KernelChoice::smallest) break;
  }
  return *chosen;  // the last of each method has all effects
}

bool layers_need(const ir::RenderSettings& settings, bool (*wants)(ir::Aov)) {
  return std::any_of(settings.aovs.begin(), settings.aovs.end(), wants);
}

TraceJob trace_job(const RenderScene& scene, const ir::RenderSettings& settings,
                   EffectMask effects) {
  const bool textured = (effects & mask_of({ir::Effect::textures, ir::Effect::normal_maps})) != 0;
  const HitDetail detail = layers_need(settings, [](ir::Aov aov) { return aov == ir::Aov::uv; })
                               ? HitDetail::texture
                           : textured ? HitDetail::where_textured
                                      : HitDetail::place;
  const bool first = layers_need(
      settings, [](ir::Aov aov) { return aov != ir::Aov::variance && aov != ir::Aov::samples; });
  return {scene, settings, effects, detail, first, {}};
}

}  // namespace

EffectMask mask_of(const ir::EffectSet& effects) {
  EffectMask mask = 0;
  for (std::size_t i = 0; i < ir::effect_count; ++i)
    if (effects.has(static_cast<ir::Effect>(i))) mask |= bit_of(static_cast<ir::Effect>(i));
  return mask;
}

ir::EffectSet set_of(EffectMask mask) {
  ir::EffectSet set;
  for (std::size_t i = 0; i < ir::effect_count; ++i)
    if ((mask & bit_of(static_cast<ir::Effect>(i))) != 0) set.add(static_cast<ir::Effect>(i));
  return set;
}

KernelSummary kernel_for(ir::Method method, const ir::EffectSet& effects, KernelChoice choice) {
  const KernelInfo& info = choose(method, mask_of(effects), choice).info;
  return {info.name, set_of(info.mask).without(effects)};
}

TileKernel::TileKernel(const RenderScene& scene, const ir::RenderSettings& settings,
                       const ir::EffectSet& effects, KernelChoice choice, const ir::Camera* camera)
    : job_{trace_job(scene, settings, mask_of(effects)),
           CameraSampler(camera != nullptr ? *camera : scene.scene->cameras[settings.camera],
                         settings.size,
                         effects.has(ir::Effect::depth_of_field) ? CameraSampler::Lens::simulated
                                                                 : CameraSampler::Lens::left_out),
           FilterSampler(settings.filter)},
      run_(choose(settings.method, mask_of(effects), choice).run) {
  if (scene.textures.wants_widths()) job_.trace.cone = job_.camera.cone();
}

}  // namespace scenec::backend

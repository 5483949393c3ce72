// What a study measures: the curve, then one comparison after the other, each within its share of
// the time that is left.
#include <algorithm>
#include <chrono>
#include <utility>

#include "backend/materials/fresnel.hpp"
#include "backend/materials/metals.hpp"
#include "backend/render_scene.hpp"
#include "runtime/study/curve.hpp"
#include "runtime/study/variant.hpp"

namespace scenec::runtime {

namespace {

using Clock = std::chrono::steady_clock;

// Share of the time for the curve; the rest is for comparisons.
constexpr double curve_share = 0.4;
constexpr std::int64_t fewest_samples = 16;
constexpr std::int64_t most_samples = 1024;
constexpr std::int64_t most_clamped_samples = 64;  // a round each

// Schlick's approximation stands for Fresnel's equations where a metal is told by f0 alone.
bool use_schlick(ir::Scene& scene) {
  bool changed = false;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    auto* metal = std::get_if<ir::Conductor>(&scene.materials[ir::MaterialId(i)].kind);
    if (metal == nullptr || metal->f0) continue;
    backend::MetalIndices n;
    if (metal->preset) {
      n = backend::indices_of(*metal->preset);
    } else if (metal->eta && metal->k) {
      n = {{metal->eta->r, metal->eta->g, metal->eta->b}, {metal->k->r, metal->k->g, metal->k->b}};
    } else {
      continue;
    }
    metal->f0 = ir::ColorInput{{backend::fresnel_conductor(1, n.eta.r, n.k.r),
                                backend::fresnel_conductor(1, n.eta.g, n.k.g),
                                backend::fresnel_conductor(1, n.eta.b, n.k.b)},
                               {}};
    changed = true;
  }
  return changed;
}

class Study {
 public:
  Study(const StudyPlan& plan, ThreadPool& pool, Json& document)
      : plan_(plan), pool_(pool), document_(document), start_(Clock::now()) {}

  void run_all() {
    scene_ = backend::build(plan_.prepared, pool_);
    base_ = {"as written", "", plan_.settings,
             backend::find_effects(*scene_, plan_.settings).simulated(), scene_.get()};
    base_.settings.aovs.clear();
    if (!document_.contains("curve")) {
      tell("error against time");
      const auto goes_on = [&] { return spent() < curve_share * plan_.seconds; };
      measure_curve(base_, goes_on, plan_, pool_, document_);
      save();
    }
    list_effects();
    list_knobs();
    document_.erase("left_out");
    for (std::size_t i = 0; i < tasks_.size() && !plan_.stop.stop_requested(); ++i)
      measure(tasks_[i], tasks_.size() - i);
  }

 private:
  struct Task {
    const char* list;
    std::string name;
    std::string what;  // for the reader
    // Null: nothing to tell.
    std::function<Json(Variant, std::int64_t samples)> row;
  };

  [[nodiscard]] double spent() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  void tell(const std::string& what) {
    if (plan_.progress) plan_.progress(std::min(1.0, spent() / plan_.seconds), what);
  }
  void save() {
    if (plan_.save && !plan_.stop.stop_requested()) plan_.save(document_);
  }

  // As many samples as let every comparison run within its share of the time.
  [[nodiscard]] std::int64_t samples_for(std::size_t comparisons_left) const {
    if (!document_.contains("curve")) return fewest_samples;
    // As it went while the curve was made: other programs take their part of the machine too.
    const double each = document_["curve"]["wall_a_sample"].get<double>();
    const double wall =
        std::max(0.0, plan_.seconds - spent()) / static_cast<double>(comparisons_left);
    const double samples = wall / (2 * pairs * std::max(each, 1e-9));
    const auto whole = static_cast<std::int64_t>(std::min(samples, double{most_samples}));
    return std::max(fewest_samples, whole / 4 * 4);
  }

  void measure(const Task& task, std::size_t left) {
    if (!document_.contains(task.list)) document_[task.list] = Json::array();
    for (const Json& row : document_[task.list]) {
      if (row["name"].get<std::string>() == task.name) return;
    }
    if (spent() >= plan_.seconds) {
      document_["left_out"].push_back(task.name);
      return;
    }
    tell(task.name);
    Variant variant = base_;
    variant.name = task.name;
    variant.what = task.what;
    Json row = task.row(std::move(variant), samples_for(left));
    if (row.is_null()) return;
    row["name"] = task.name;
    row["what"] = task.what;
    document_[task.list].push_back(std::move(row));
    save();
  }

  // A comparison with something about the variant changed.
  void add(const char* list, std::string name, std::string what,
           std::function<void(Variant&)> change) {
    tasks_.push_back({list, std::move(name), std::move(what),
                      [this, change = std::move(change)](Variant variant, std::int64_t samples) {
                        change(variant);
                        return comparison(base_, variant, samples, plan_, pool_);
                      }});
  }
  void add_setting(std::string name, std::string what,
                   std::function<void(ir::RenderSettings&)> change) {
    add("knobs", std::move(name), std::move(what),
        [change = std::move(change)](Variant& variant) { change(variant.settings); });
  }
  // The same with the scene built anew; `change` gives false where it finds nothing to change.
  void add_scene(std::string name, std::string what, std::function<bool(ir::Scene&)> change,
                 backend::BuildOptions options = {},
                 backend::LightFinding finding = backend::LightFinding::both) {
    tasks_.push_back({"knobs", std::move(name), std::move(what),
                      [this, change = std::move(change), options, finding](Variant variant,
                                                                           std::int64_t samples) {
                        Json row;
                        plan_.compile_again([&](ir::Scene& scene, FileSystem& files) {
                          DiagnosticSink sink;
                          if (!change(scene)) return;
                          const backend::PreparedPtr prepared =
                              backend::prepare(scene, files, pool_, sink);
                          if (!prepared) return;
                          const backend::RenderScenePtr built =
                              backend::build(*prepared, pool_, options);
                          built->lights.finding = finding;
                          variant.scene = built.get();
                          row = comparison(base_, variant, samples, plan_, pool_);
                        });
                        return row;
                      }});
  }

  void list_effects() {
    for (std::size_t i = 0; i < ir::effect_count; ++i) {
      const auto effect = static_cast<ir::Effect>(i);
      if (!base_.effects.has(effect)) continue;
      add("effects", std::string(name_of(effect)), std::string(doc_of(effect)),
          [effect](Variant& variant) { variant.effects.remove(effect); });
    }
  }

  void list_knobs() {
    add_setting("again", "the same once more: what no change looks like", [](auto&) {});
    if (base_.settings.method == ir::Method::path) list_light_finding();
    list_numbers();
    for (const double times : {3.0, 10.0, 30.0}) {
      tasks_.push_back({"knobs", "clamp at " + std::to_string(static_cast<int>(times)) + " × mean",
                        "no sample brighter than so many times the mean of the picture",
                        [this, times](const Variant&, std::int64_t samples) {
                          return clamp_row(base_, times, std::min(samples, most_clamped_samples),
                                           plan_, pool_);
                        }});
    }
    add("knobs", "--adaptive", "more samples where the error is",
        [](Variant& variant) { variant.spread = backend::SampleSpread::adaptive; });
    const auto same = [](ir::Scene&) { return true; };
    add_scene("--precision double", "vertices of meshes in double", same,
              {.precision = backend::Precision::full});
    add_scene("Fresnel by Schlick", "metals by their reflectance at normal incidence", use_schlick);
    list_solvers();
  }

  void list_light_finding() {
    const auto same = [](ir::Scene&) { return true; };
    const backend::LightTable& lights = scene_->lights;
    if (lights.emitters.empty() && lights.environments.empty()) return;
    add_scene("light by aiming only", "next-event estimation without multiple importance sampling",
              same, {}, backend::LightFinding::aiming);
    // Light without extent is not met by chance at all: every way has to aim at it.
    add_scene("light by chance only", "scattered rays find lights; nothing aims at them", same, {},
              backend::LightFinding::chance);
  }

  void list_numbers() {
    const bool sobol = base_.settings.sampler == ir::SamplerKind::sobol;
    add_setting(sobol ? "sampler .independent" : "sampler .sobol", "other random numbers",
                [sobol](ir::RenderSettings& s) {
                  s.sampler = sobol ? ir::SamplerKind::independent : ir::SamplerKind::sobol;
                });
    for (const std::int64_t depth : {2, 4, 8}) {
      add_setting("max_depth " + std::to_string(depth), "paths cut off at a fixed depth",
                  [depth](ir::RenderSettings& s) { s.max_depth = depth; });
    }
    for (const ir::FilterKind kind :
         {ir::FilterKind::box, ir::FilterKind::gaussian, ir::FilterKind::mitchell}) {
      if (kind == base_.settings.filter.kind) continue;
      const auto name = ir::EnumNames<ir::FilterKind>::names[static_cast<std::size_t>(kind)];
      add_setting("filter ." + std::string(name), "another pixel filter",
                  [kind](ir::RenderSettings& s) { s.filter = {kind, ir::usual_radius(kind)}; });
    }
  }

  void list_solvers() {
    if (plan_.scene.table<ir::Revolve>().size() == 0) return;
    const auto with = [](ir::RevolveSolver solver, std::int64_t steps) {
      return [solver, steps](ir::Scene& scene) {
        auto& revolves = std::get<Table<ir::Revolve>>(scene.shapes);
        for (std::uint32_t i = 0; i < revolves.size(); ++i) {
          revolves[Id<ir::Revolve>(i)].solver = solver;
          revolves[Id<ir::Revolve>(i)].steps = steps;
        }
        return true;
      };
    };
    constexpr std::string_view what = "another way to meet surfaces of revolution";
    add_scene("solver .certified", std::string(what), with(ir::RevolveSolver::certified, 64));
    add_scene("solver .newton", std::string(what), with(ir::RevolveSolver::newton, 64));
    for (const std::int64_t steps : {16, 64, 256}) {
      add_scene("solver .tessellated, " + std::to_string(steps) + " steps", std::string(what),
                with(ir::RevolveSolver::tessellated, steps));
    }
  }

  const StudyPlan& plan_;
  ThreadPool& pool_;
  Json& document_;
  Clock::time_point start_;
  backend::RenderScenePtr scene_;
  Variant base_;
  std::vector<Task> tasks_;
};

}  // namespace

void measure_study(const StudyPlan& plan, ThreadPool& pool, Json& document) {
  Study(plan, pool, document).run_all();
}

}  // namespace scenec::runtime

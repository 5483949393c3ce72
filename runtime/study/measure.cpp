// What a study measures: the curve, then one comparison after the other, each within its share of
// the time that is left.
#include <algorithm>
#include <chrono>
#include <utility>

#include "backend/render_scene.hpp"
#include "runtime/study/choices.hpp"
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
    document_.erase("left_out");
    document_.erase("inapplicable");
    document_["not_called_for"] = Json::array();
    for (std::size_t i = 0; i < ir::effect_count; ++i) {
      const auto effect = static_cast<ir::Effect>(i);
      if (!base_.effects.has(effect)) document_["not_called_for"].push_back(name_of(effect));
    }
    std::vector<Task> tasks;
    for (Choice& choice : effects_left_out(base_)) tasks.push_back({"effects", std::move(choice)});
    for (Choice& choice : other_choices(plan_.scene, base_)) {
      if (choice.why_not.empty())
        tasks.push_back({"knobs", std::move(choice)});
      else
        tell_inapplicable(choice, choice.why_not);
    }
    for (std::size_t i = 0; i < tasks.size() && !plan_.stop.stop_requested(); ++i)
      measure(tasks[i], tasks.size() - i);
    save();
  }

 private:
  struct Task {
    const char* list;
    Choice choice;
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
    const Choice& choice = task.choice;
    if (!document_.contains(task.list)) document_[task.list] = Json::array();
    for (const Json& row : document_[task.list]) {
      if (row["name"].get<std::string>() == choice.name) return;
    }
    if (spent() >= plan_.seconds) {
      document_["left_out"].push_back(choice.name);
      return;
    }
    tell(choice.name);
    std::int64_t samples = samples_for(left);
    Json row = row_of(choice, samples);
    // A filter with negative lobes needs some samples before every pixel has weight.
    if (row.is_null() && !plan_.stop.stop_requested()) row = row_of(choice, samples *= 4);
    if (plan_.stop.stop_requested()) return;
    if (row.is_null()) {
      return tell_inapplicable(choice, "no error could be measured with " +
                                           std::to_string(samples) + " samples a pixel");
    }
    document_[task.list].push_back(std::move(row));
    save();
  }

  void tell_inapplicable(const Choice& choice, const std::string& why) {
    document_["inapplicable"].push_back(
        {{"name", choice.name}, {"what", choice.what}, {"why", why}});
  }

  // Null: there was nothing to measure, or no time.
  Json row_of(const Choice& choice, std::int64_t samples) {
    Variant variant = base_;
    variant.name = choice.name;
    variant.what = choice.what;
    if (choice.clamp > 0) {
      return clamp_row(base_, variant, choice.clamp, std::min(samples, most_clamped_samples), plan_,
                       pool_);
    }
    if (choice.set) choice.set(variant);
    if (!choice.rewrite) return row_of_built(choice, variant, plan_.prepared, samples);
    Json row;
    plan_.compile_again([&](ir::Scene& scene, FileSystem& files) {
      DiagnosticSink sink;
      choice.rewrite(scene);
      const backend::PreparedPtr prepared = backend::prepare(scene, files, pool_, sink);
      if (prepared) row = row_of_built(choice, variant, *prepared, samples);
    });
    return row;
  }
  Json row_of_built(const Choice& choice, Variant& variant, const backend::PreparedScene& prepared,
                    std::int64_t samples) {
    backend::RenderScenePtr built;
    // What is only set differently shares the trees of the base.
    const bool is_only_set = choice.set && !choice.adjust;
    if (!is_only_set) {
      built = backend::build(prepared, pool_, choice.build);
      if (choice.adjust) choice.adjust(*built);
      variant.scene = built.get();
    }
    return comparison(base_, variant, samples, plan_, pool_);
  }

  const StudyPlan& plan_;
  ThreadPool& pool_;
  Json& document_;
  Clock::time_point start_;
  backend::RenderScenePtr scene_;
  Variant base_;
};

}  // namespace

void measure_study(const StudyPlan& plan, ThreadPool& pool, Json& document) {
  Study(plan, pool, document).run_all();
}

}  // namespace scenec::runtime

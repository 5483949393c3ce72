#include "runtime/watch/attempt.hpp"

#include <sstream>

#include "runtime/output.hpp"
#include "runtime/settings.hpp"

namespace scenec::runtime {

namespace {

class Maker {
 public:
  Maker(const Options& options, const Workbench& bench, const Attempt* shown)
      : bench_(bench),
        shown_(shown),
        reading_(std::make_shared<Reading>(options)),
        result_(std::make_shared<Attempt>()) {
    result_->reading = reading_;
  }

  std::shared_ptr<const Attempt> make() {
    PhaseClock clock(result_->stats);
    const Reuse before = counts();
    run(clock);
    const Reuse after = counts();
    const auto since = []<class T>(const T& from, const T& to) {
      return T{to.reused - from.reused, to.made - from.made};
    };
    result_->reuse = {.assets = since(before.assets, after.assets),
                      .mesh_trees = since(before.mesh_trees, after.mesh_trees),
                      .item_trees = since(before.item_trees, after.item_trees)};
    result_->findings = session().findings();
    result_->files = session().files().records();
    return result_;
  }

 private:
  Session& session() { return reading_->session; }

  // Of the daemon's life so far.
  [[nodiscard]] Reuse counts() const {
    return {bench_.memory.counts(), bench_.trees.mesh_counts(), bench_.trees.world_counts()};
  }

  void run(PhaseClock& clock) {
    auto world = std::make_shared<World>();
    auto scene = session().load_and_compile(bench_.pool, &bench_.texts);
    clock.finish("compile");
    note_changes();
    if (!scene || session().has_errors()) return;
    if (!find_settings(*scene)) return;
    if (shown_ != nullptr && shown_->world && shown_->world->scene->hash == scene->hash) {
      // The same picture from other words: places are the new ones, everything else stays.
      result_->places = std::make_unique<ir::Scene>(*std::move(scene));
      result_->world = shown_->world;
      result_->settings = shown_->settings;  // ids may differ between the two
      return;
    }
    world->reading = reading_;
    world->scene = std::make_unique<ir::Scene>(*std::move(scene));
    world->prepared =
        backend::prepare(*world->scene, session().files(), bench_.pool, session().sink(),
                         bench_.cache, reading_->options.limits, bench_.memory);
    note_changes();
    clock.finish("prepare");
    if (!world->prepared || session().has_errors()) return;
    const std::string& output = reading_->options.output;
    if (!output.empty() && !check_output_is_no_input(output, session())) return;
    world->built =
        backend::build(*world->prepared, bench_.pool,
                       {.cache = bench_.cache,
                        .trees = &bench_.trees,
                        .precision = reading_->options.precision,
                        .target = reading_->options.target.value_or(backend::best_target())});
    clock.finish("build");
    result_->world = std::move(world);
  }

  // All that was read is one state of the files unless they were changing meanwhile.
  void note_changes() {
    if (bench_.files_change && bench_.files_change()) result_->mixed = true;
  }

  bool find_settings(const ir::Scene& scene) {
    std::ostringstream problem;
    std::ostringstream unused;
    const Environment quiet{.out = unused, .err = problem, .variable = {}};
    result_->settings = settings_of(reading_->options, scene, quiet);
    if (!result_->settings) result_->problem = problem.str();
    return result_->settings.has_value();
  }

  const Workbench& bench_;
  const Attempt* shown_;
  std::shared_ptr<Reading> reading_;
  std::shared_ptr<Attempt> result_;
};

}  // namespace

std::shared_ptr<const Attempt> make_attempt(const Options& options, const Workbench& bench,
                                            const Attempt* shown) {
  return Maker(options, bench, shown).make();
}

}  // namespace scenec::runtime

// What a study measures. Times are CPU seconds of the whole process, which other programs on the
// machine disturb least; two settings are compared by runs in turn with the same random numbers.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "backend/image/compare.hpp"
#include "base/text.hpp"
#include "runtime/study/study.hpp"

namespace scenec::runtime {

namespace {

using Clock = std::chrono::steady_clock;

// Shares of the time for the curve; the rest is for comparisons.
constexpr double curve_share = 0.4;
constexpr int pairs =
    6;  // the least and the largest of six ratios enclose the median 97 times in 100
constexpr std::int64_t fewest_samples = 16;
constexpr std::int64_t first_fitted = 16;
constexpr double levels[] = {0.1, 0.05, 0.02, 0.01, 0.005};

double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Json json_of(const backend::ErrorBand& band) {
  return {{"value", band.value}, {"low", band.low}, {"high", band.high}};
}

// A scene made ready, with what it is rendered with.
struct Variant {
  std::string name;
  std::string what;  // for the reader
  ir::RenderSettings settings;
  ir::EffectSet effects;
  const backend::RenderScene* scene = nullptr;
};

struct Run {
  double seconds = 0;
  backend::Picture picture;
  backend::ErrorEstimate error;
};

Run run(const Variant& variant, std::int64_t samples, std::int64_t seed, ThreadPool& pool,
        const std::stop_token& stop) {
  Run result;
  ir::RenderSettings settings = variant.settings;
  settings.seed = seed;
  backend::RenderSession session(*variant.scene, settings, variant.effects, pool);
  const double start = cpu_seconds();
  session.advance(samples, stop);
  result.seconds = cpu_seconds() - start;
  result.picture = session.picture();
  result.error = session.error();
  return result;
}

backend::FloatImage image_of(const backend::Picture& picture) {
  return {static_cast<std::uint32_t>(picture.width), static_cast<std::uint32_t>(picture.height), 3,
          picture.rgb};
}

double mean_of(const backend::Picture& picture) {
  double sum = 0;
  for (const float value : picture.rgb) sum += static_cast<double>(value);
  return sum / static_cast<double>(std::max<std::size_t>(1, picture.rgb.size()));
}

struct Spread {
  double median = 0;
  double low = 0;
  double high = 0;
};
Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}
Json json_of(const Spread& spread) {
  return {{"value", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

// What a variant costs and changes beside the base. Pixels count as changed when a channel differs
// by more than 2 % of the picture's mean and of the pixel: with common random numbers pixels the
// variant does not touch are equal to the last bit.
Json comparison(const Variant& base, const Variant& other, std::int64_t samples,
                const StudyPlan& plan, ThreadPool& pool) {
  std::vector<double> times;
  std::vector<double> errors;
  std::vector<double> means;
  std::vector<double> pieces;  // share of pixels changed
  double distance = 0;
  backend::ErrorEstimate base_error;
  backend::ErrorEstimate other_error;
  for (int pair = 0; pair < pairs && !plan.stop.stop_requested(); ++pair) {
    const std::int64_t seed = base.settings.seed + pair;
    const bool base_first = pair % 2 == 0;
    Run first = run(base_first ? base : other, samples, seed, pool, plan.stop);
    Run second = run(base_first ? other : base, samples, seed, pool, plan.stop);
    const Run& a = base_first ? first : second;
    const Run& b = base_first ? second : first;
    if (!a.error.known || !b.error.known || a.seconds <= 0) continue;
    times.push_back(b.seconds / a.seconds);
    if (a.error.relative.value > 0)
      errors.push_back(b.error.relative.value / a.error.relative.value);
    const double mean = mean_of(a.picture);
    if (mean > 0) means.push_back(mean_of(b.picture) / mean - 1);
    const backend::ImageDifference difference =
        backend::difference_of(image_of(b.picture), image_of(a.picture));
    distance += std::sqrt(difference.rel_mse) / pairs;
    std::size_t changed = 0;
    for (std::size_t i = 0; i + 2 < a.picture.rgb.size(); i += 3) {
      bool is_changed = false;
      for (std::size_t c = i; c < i + 3; ++c) {
        const double x = static_cast<double>(a.picture.rgb[c]);
        const double y = static_cast<double>(b.picture.rgb[c]);
        is_changed = is_changed || std::abs(x - y) > 0.02 * (std::abs(x) + mean);
      }
      changed += is_changed ? 1 : 0;
    }
    pieces.push_back(3 * static_cast<double>(changed) / static_cast<double>(a.picture.rgb.size()));
    base_error = a.error;
    other_error = b.error;
  }
  if (times.size() < static_cast<std::size_t>(pairs)) return nullptr;
  Json row{{"name", other.name}, {"what", other.what}, {"samples", samples}};
  row["time_ratio"] = json_of(spread_of(times));
  if (!errors.empty()) row["error_ratio"] = json_of(spread_of(errors));
  if (!means.empty()) row["brightness"] = json_of(spread_of(means));
  row["changed_pixels"] = spread_of(pieces).median;
  row["difference"] = distance;
  row["error_before"] = json_of(base_error.relative);
  row["error_after"] = json_of(other_error.relative);
  return row;
}

// log(error) over log(time) as a straight line through points that count equally.
struct Line {
  double slope = -0.5;
  double band = 0;
  double at_one = 0;
  bool fitted = false;
};
Line line_through(const std::vector<std::pair<double, double>>& points) {
  Line line;
  const double n = static_cast<double>(points.size());
  if (points.size() < 3) return line;
  double x = 0;
  double y = 0;
  for (const auto& [a, b] : points) {
    x += a / n;
    y += b / n;
  }
  double xx = 0;
  double xy = 0;
  for (const auto& [a, b] : points) {
    xx += (a - x) * (a - x);
    xy += (a - x) * (b - y);
  }
  if (!(xx > 0)) return line;
  line.slope = xy / xx;
  line.at_one = y - line.slope * x;
  double rest = 0;
  for (const auto& [a, b] : points) {
    const double residual = b - line.at_one - line.slope * a;
    rest += residual * residual;
  }
  line.band = 2 * std::sqrt(rest / (n - 2) / xx);
  line.fitted = true;
  return line;
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
    if (!document_.contains("curve")) measure_curve();
    measure_effects();
    measure_knobs();
  }

 private:
  [[nodiscard]] double spent() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  void tell(const std::string& what) {
    if (plan_.progress) plan_.progress(std::min(1.0, spent() / plan_.seconds), what);
  }
  void save() {
    if (plan_.save && !plan_.stop.stop_requested()) plan_.save(document_);
  }

  void measure_curve() {
    backend::RenderSession session(*scene_, base_.settings, base_.effects, pool_);
    Json points = Json::array();
    std::vector<std::pair<double, double>> fitted;
    double seconds = 0;
    while (spent() < curve_share * plan_.seconds) {
      tell("error against time");
      const std::int64_t done = session.samples();
      const double before = cpu_seconds();
      if (!session.advance(std::max<std::int64_t>(1, done / 4), plan_.stop)) return;
      seconds += cpu_seconds() - before;
      const backend::ErrorEstimate error = session.error();
      if (!error.known) continue;
      points.push_back({{"samples", session.samples()},
                        {"seconds", seconds},
                        {"error", json_of(error.relative)},
                        {"rmse", json_of(error.absolute)}});
      if (session.samples() >= first_fitted && error.relative.value > 0 && seconds > 0)
        fitted.emplace_back(std::log(seconds), std::log(error.relative.value));
    }
    const Line line = line_through(fitted);
    document_["curve"] = {{"points", points},
                          {"fitted", line.fitted},
                          {"slope", line.slope},
                          {"slope_band", line.band},
                          {"at_one_second", std::exp(line.at_one)},
                          {"seconds_a_sample", seconds / static_cast<double>(std::max<std::int64_t>(
                                                             1, session.samples()))}};
    document_["levels"] = levels_of(points, line);
    add_picture(session.picture());
    save();
  }

  static Json levels_of(const Json& points, const Line& line) {
    Json rows = Json::array();
    for (const double level : levels) {
      Json row{{"error", level}};
      const Json* before = nullptr;
      for (const Json& point : points) {
        const double error = point["error"]["value"].get<double>();
        if (error <= level && before != nullptr) {
          const double e0 = (*before)["error"]["value"].get<double>();
          const double t0 = (*before)["seconds"].get<double>();
          const double t1 = point["seconds"].get<double>();
          const double part = std::log(e0 / level) / std::log(e0 / std::max(error, 1e-300));
          row["seconds"] = t0 * std::pow(t1 / t0, part);
          row["measured"] = true;
          break;
        }
        before = &point;
      }
      if (!row.contains("seconds") && before != nullptr && line.fitted && line.slope < 0) {
        // From the last point on along the line.
        const double error = (*before)["error"]["value"].get<double>();
        const double seconds = (*before)["seconds"].get<double>();
        row["seconds"] = seconds * std::pow(level / error, 1 / line.slope);
        row["low"] = seconds * std::pow(level / error, 1 / (line.slope - line.band));
        if (line.slope + line.band < 0)
          row["high"] = seconds * std::pow(level / error, 1 / (line.slope + line.band));
        row["measured"] = false;
      }
      rows.push_back(row);
    }
    return rows;
  }

  void add_picture(const backend::Picture& picture) {
    const std::string png = backend::encode(picture, base_.settings, backend::ImageFormat::png, {});
    document_["picture"] = {{"width", picture.width},
                            {"height", picture.height},
                            {"samples", picture.samples},
                            {"png", base64_of(png)}};
  }

  static std::string base64_of(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t word = 0;
      for (std::size_t k = 0; k < 3; ++k)
        word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
      for (std::size_t k = 0; k < 4; ++k)
        text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
  }

  // As many samples as let every comparison run within its share of the time.
  [[nodiscard]] std::int64_t samples_for(std::size_t comparisons_left) const {
    if (!document_.contains("curve")) return fewest_samples;
    const double each = document_["curve"]["seconds_a_sample"].get<double>();
    const double wall = std::max(0.0, plan_.seconds - spent());
    const double cpu =
        wall * pool_.size() / static_cast<double>(std::max<std::size_t>(1, comparisons_left));
    const double samples = cpu / (2 * pairs * std::max(each, 1e-9));
    const auto whole = static_cast<std::int64_t>(std::min(samples, 1024.0));
    return std::max(fewest_samples, whole / 4 * 4);
  }

  void compare_into(const char* list, const Variant& other, std::size_t left) {
    if (!document_.contains(list)) document_[list] = Json::array();
    for (const Json& row : document_[list]) {
      if (row["name"].get<std::string>() == other.name) return;
    }
    if (plan_.stop.stop_requested()) return;
    tell(other.what);
    const Json row = comparison(base_, other, samples_for(left), plan_, pool_);
    if (row.is_null()) return;
    document_[list].push_back(row);
    save();
  }

  void measure_effects() {
    std::size_t left = base_.effects.size() + knob_count;
    for (std::size_t i = 0; i < ir::effect_count; ++i) {
      const auto effect = static_cast<ir::Effect>(i);
      if (!base_.effects.has(effect)) continue;
      Variant without = base_;
      without.name = name_of(effect);
      without.what = doc_of(effect);
      without.effects.remove(effect);
      compare_into("effects", without, left);
      --left;
    }
  }

  void knob(const std::string& name, const std::string& what,
            const std::function<void(ir::RenderSettings&)>& change) {
    Variant variant = base_;
    variant.name = name;
    variant.what = what;
    change(variant.settings);
    compare_into("knobs", variant, knobs_left_ > 1 ? knobs_left_-- : 1);
  }

  void measure_knobs() {
    knob("again", "the same once more: what no change looks like", [](auto&) {});
    const bool sobol = base_.settings.sampler == ir::SamplerKind::sobol;
    knob(sobol ? "sampler .independent" : "sampler .sobol", "other random numbers",
         [&](ir::RenderSettings& s) {
           s.sampler = sobol ? ir::SamplerKind::independent : ir::SamplerKind::sobol;
         });
    for (const std::int64_t depth : {2, 4, 8}) {
      knob("max_depth " + std::to_string(depth), "paths cut off instead of ended by chance",
           [&](ir::RenderSettings& s) { s.max_depth = depth; });
    }
    for (const ir::FilterKind kind :
         {ir::FilterKind::box, ir::FilterKind::gaussian, ir::FilterKind::mitchell}) {
      if (kind == base_.settings.filter.kind) continue;
      knob("filter ." +
               std::string(ir::EnumNames<ir::FilterKind>::names[static_cast<std::size_t>(kind)]),
           "another pixel filter",
           [&](ir::RenderSettings& s) { s.filter = {kind, ir::usual_radius(kind)}; });
    }
    measure_precision();
    measure_solvers();
  }

  void measure_precision() {
    const backend::RenderScenePtr full =
        backend::build(plan_.prepared, pool_, {.precision = backend::Precision::full});
    Variant variant = base_;
    variant.name = "--precision double";
    variant.what = "vertices of meshes in double";
    variant.scene = full.get();
    compare_into("knobs", variant, 1);
  }

  void measure_solvers() {
    if (plan_.scene.table<ir::Revolve>().size() == 0) return;
    struct Choice {
      ir::RevolveSolver solver;
      std::int64_t steps;
    };
    for (const Choice choice :
         {Choice{ir::RevolveSolver::newton, 64}, Choice{ir::RevolveSolver::tessellated, 16},
          Choice{ir::RevolveSolver::tessellated, 64},
          Choice{ir::RevolveSolver::tessellated, 256}}) {
      const bool tessellated = choice.solver == ir::RevolveSolver::tessellated;
      Variant variant = base_;
      variant.name = tessellated ? "solver .tessellated, " + std::to_string(choice.steps) + " steps"
                                 : "solver .newton";
      variant.what = "another way to meet surfaces of revolution";
      plan_.compile_again([&](ir::Scene& scene, FileSystem& files) {
        auto& revolves = std::get<Table<ir::Revolve>>(scene.shapes);
        for (std::uint32_t i = 0; i < revolves.size(); ++i) {
          revolves[Id<ir::Revolve>(i)].solver = choice.solver;
          revolves[Id<ir::Revolve>(i)].steps = choice.steps;
        }
        DiagnosticSink sink;
        const backend::PreparedPtr prepared = backend::prepare(scene, files, pool_, sink);
        if (!prepared) return;
        const backend::RenderScenePtr built = backend::build(*prepared, pool_);
        variant.scene = built.get();
        compare_into("knobs", variant, 2);
      });
    }
  }

  static constexpr std::size_t knob_count = 12;
  const StudyPlan& plan_;
  ThreadPool& pool_;
  Json& document_;
  Clock::time_point start_;
  backend::RenderScenePtr scene_;
  Variant base_;
  std::size_t knobs_left_ = knob_count;
};

}  // namespace

void measure_study(const StudyPlan& plan, ThreadPool& pool, Json& document) {
  Study(plan, pool, document).run_all();
}

}  // namespace scenec::runtime

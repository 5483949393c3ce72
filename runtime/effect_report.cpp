#include "runtime/effect_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "backend/backend.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::ordered_json;

enum class State : std::uint8_t { simulated, switched_off, absent };

State state_of(const ir::EffectFinding& finding) {
  if (!finding.called_for) return State::absent;
  return finding.switched_off ? State::switched_off : State::simulated;
}

std::string_view method_name(const ir::RenderSettings& settings) {
  return ir::EnumNames<ir::Method>::names[static_cast<std::size_t>(settings.method)];
}

struct Step {
  std::string_view how;  // "at", "expanded at", "included at"
  std::string_view file;
  Position position;
};

// From where the witness is written outwards.
std::vector<Step> chain_of(const ir::Scene& scene, ir::OriginId origin, const SourceMap& sources) {
  std::vector<Step> steps;
  std::string_view how = "at";
  while (origin.valid()) {
    const ir::Origin& o = scene.origins[origin];
    const Span span = sources.resolve(o.span);
    steps.push_back({how, sources.path(span.file), sources.position(span.file, span.begin)});
    how = o.kind == ir::OriginKind::included_from ? "included at" : "expanded at";
    origin = o.parent;
  }
  return steps;
}

std::vector<std::string_view> names_of(const ir::EffectSet& set) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < ir::effect_count; ++i)
    if (set.has(static_cast<ir::Effect>(i)))
      names.push_back(ir::name_of(static_cast<ir::Effect>(i)));
  return names;
}

std::string chain_text(const std::vector<Step>& steps) {
  std::string text;
  for (const Step& step : steps) {
    text += fmt::format("{}{} {}:{}:{}", text.empty() ? "" : ", ", step.how, step.file,
                        step.position.line, step.position.column);
  }
  return text;
}

std::string paragraph(const ir::Scene& scene, ir::Effect effect, const ir::EffectFinding& finding,
                      const SourceMap& sources) {
  const State state = state_of(finding);
  std::string text = fmt::format("{:<4}{:<16}{}\n", state == State::simulated ? "on" : "off",
                                 ir::name_of(effect), finding.reason);
  if (state == State::switched_off)
    text +=
        fmt::format("{:20}but it is switched off in `render.effects`: the picture is biased\n", "");
  const std::string chain = chain_text(chain_of(scene, finding.witness, sources));
  if (!chain.empty()) text += fmt::format("{:20}{}\n", "", chain);
  return text;
}

// What the kernel could do beyond what it is asked for.
std::string surplus_text(const ir::EffectSet& surplus) {
  if (surplus.size() == 0) return "nothing more is compiled into it";
  std::string names;
  for (const std::string_view name : names_of(surplus)) {
    if (!names.empty()) names += ", ";
    names += name;
  }
  return "compiled with " + names + " too, switched off here";
}

template <class F>
void for_each_finding(const ir::EffectReport& report, F&& f) {
  for (std::size_t i = 0; i < ir::effect_count; ++i)
    f(static_cast<ir::Effect>(i), report.findings[i]);
}

}  // namespace

std::string effects_text(const ir::Scene& scene, const ir::RenderSettings& settings,
                         const ir::EffectReport& report, const SourceMap& sources) {
  const backend::KernelSummary kernel = backend::kernel_for(settings.method, report.simulated());
  std::string text = fmt::format(
      "method `.{}`: {} of {} effects are simulated\nkernel `{}`: {}\n\n", method_name(settings),
      report.simulated().size(), ir::effect_count, kernel.name, surplus_text(kernel.surplus));
  for (const State wanted : {State::simulated, State::switched_off, State::absent}) {
    for_each_finding(report, [&](ir::Effect effect, const ir::EffectFinding& finding) {
      if (state_of(finding) == wanted) text += paragraph(scene, effect, finding, sources);
    });
  }
  return text;
}

std::string effects_dump(const ir::EffectReport& report) {
  std::string text;
  for_each_finding(report, [&](ir::Effect effect, const ir::EffectFinding& finding) {
    constexpr std::array<std::string_view, 3> names{"on", "switched_off", "off"};
    text += fmt::format("{} {}: {}\n", ir::name_of(effect),
                        names[static_cast<std::size_t>(state_of(finding))], finding.reason);
  });
  return text;
}

std::string effects_json(const ir::Scene& scene, const ir::RenderSettings& settings,
                         const ir::EffectReport& report, const SourceMap& sources) {
  const backend::KernelSummary kernel = backend::kernel_for(settings.method, report.simulated());
  Json json{{"version", 1},
            {"method", method_name(settings)},
            {"kernel", {{"name", kernel.name}, {"surplus", names_of(kernel.surplus)}}},
            {"effects", Json::array()}};
  for_each_finding(report, [&](ir::Effect effect, const ir::EffectFinding& finding) {
    Json row{{"name", ir::name_of(effect)},      {"doc", ir::doc_of(effect)},
             {"called_for", finding.called_for}, {"switched_off", finding.switched_off},
             {"simulated", finding.simulated()}, {"reason", finding.reason},
             {"witness", Json::array()}};
    for (const Step& step : chain_of(scene, finding.witness, sources)) {
      row["witness"].push_back({{"how", step.how},
                                {"file", step.file},
                                {"line", step.position.line},
                                {"column", step.position.column}});
    }
    json["effects"].push_back(std::move(row));
  });
  return json.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

}  // namespace scenec::runtime

// A study of one scene: what accuracy costs in time. Everything that is measured becomes a row of a
// JSON document, which is the report's data and what an interrupted study goes on from.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "backend/backend.hpp"
#include "backend/render_session.hpp"
#include "base/parallel.hpp"
#include "ir/scene.hpp"

namespace scenec::runtime {

using Json = nlohmann::ordered_json;

struct StudyPlan {
  const ir::Scene& scene;
  const backend::PreparedScene& prepared;
  ir::RenderSettings settings;
  std::string name;  // of the scene
  // Calls with a scene of its own that may be changed, and the files to prepare it from.
  std::function<void(const std::function<void(ir::Scene&, FileSystem&)>&)> compile_again;
  double seconds = 60;  // for the whole study
  std::stop_token stop = {};
  std::function<void(double, const std::string&)> progress = {};  // part done, what runs
  std::function<void(const Json&)> save = {};                     // after every row
};

// Measures what `document` does not hold yet and adds it.
void measure_study(const StudyPlan& plan, ThreadPool& pool, Json& document);

// The report as one page that needs nothing else, and the curve as comma-separated values.
[[nodiscard]] std::string study_page(const Json& document);
[[nodiscard]] std::string study_curves(const Json& document);

}  // namespace scenec::runtime

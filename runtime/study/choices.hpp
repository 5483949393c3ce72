// What a study compares with the scene as written: each effect left out, and every choice that
// could be made in another way. A choice that a scene has no use for says why.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "backend/render_scene.hpp"
#include "runtime/study/variant.hpp"

namespace scenec::runtime {

struct Choice {
  std::string name;
  std::string what;     // for the reader
  std::string why_not;  // it does not apply to this scene; empty: it does
  // What is done to the variant, each where there is something to do.
  std::function<void(Variant&)> set = {};                  // what it is rendered with
  std::function<void(ir::Scene&)> rewrite = {};            // before it is prepared
  backend::BuildOptions build = {};                        // built with them, where not `set` alone
  std::function<void(backend::RenderScene&)> adjust = {};  // after it was built
  double clamp = 0;  // above 0: samples cut off at so many times the mean of the picture
};

// Every effect the picture is simulated with, left out.
[[nodiscard]] std::vector<Choice> effects_left_out(const Variant& base);
[[nodiscard]] std::vector<Choice> other_choices(const ir::Scene& scene, const Variant& base);

}  // namespace scenec::runtime

#include "frontend/check/lint_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "frontend/check/place_of.hpp"
#include "ir/roughness.hpp"

namespace scenec::frontend {

namespace {

// Sums of colours that are meant to be 1 may come out above it by their roundings.
constexpr double rounded_one = 1 + 0x1p-40;

double brightest(const ir::ColorInput& color) {
  if (color.texture.valid()) return 0;
  return std::max({color.value.r, color.value.g, color.value.b});
}

void lint_albedo(Session& session, double albedo, std::string_view what, Span place) {
  if (!(albedo > rounded_one)) return;
  session.lint(Diagnostic(DiagnosticKind::albedo_above_one, place,
                          fmt::format("{} is {}: more light leaves the surface than arrives", what,
                                      short_number_text(albedo)))
                   .hint("use at most 1, and stronger lights"));
}

template <class T>
void lint_color(Session& session, const BlockChecker& checker, const ir::ColorInput& color,
                ir::ColorInput T::* member, Span head) {
  lint_albedo(session, brightest(color), fmt::format("`{}`", key_name<T>(member)),
              place_of<T>(checker, member, head));
}

template <class T>
void lint_roughness(Session& session, const BlockChecker& checker, const T& material, Span head) {
  const ir::NumberInput& roughness = material.roughness;
  if (roughness.texture.valid() || !(roughness.value > 0)) return;
  const double alpha = roughness.value * roughness.value;
  if (!(alpha < ir::specular_alpha)) return;
  session.lint(
      Diagnostic(DiagnosticKind::roughness_not_resolved, place_of<T>(checker, &T::roughness, head),
                 fmt::format("`{}` is {}, so alpha is {}; below {} the surface is drawn smooth",
                             key_name<T>(&T::roughness), short_number_text(roughness.value),
                             short_number_text(alpha), short_number_text(ir::specular_alpha)))
          .hint("write 0, or at least 0.032"));
}

}  // namespace

void lint_material(Session& session, const ir::Diffuse& material, const BlockChecker& checker,
                   Span head) {
  lint_color<ir::Diffuse>(session, checker, material.color, &ir::Diffuse::color, head);
}

void lint_material(Session& session, const ir::Mirror& material, const BlockChecker& checker,
                   Span head) {
  lint_color<ir::Mirror>(session, checker, material.color, &ir::Mirror::color, head);
}

// The lobe has a normalisation of its own, so only the other weights are summed.
void lint_material(Session& session, const ir::Phong& material, const BlockChecker& checker,
                   Span head) {
  double largest = 0;
  for (auto channel : {&ir::Color::r, &ir::Color::g, &ir::Color::b}) {
    double sum = 0;
    for (const ir::ColorInput* color : {&material.diffuse, &material.reflect, &material.refract})
      sum += color->texture.valid() ? 0 : color->value.*channel;
    largest = std::max(largest, sum);
  }
  lint_albedo(session, largest, "the sum of `diffuse`, `reflect` and `refract`",
              place_of<ir::Phong>(checker, &ir::Phong::diffuse, head));
}

void lint_material(Session& session, const ir::Dielectric& material, const BlockChecker& checker,
                   Span head) {
  lint_color<ir::Dielectric>(session, checker, material.tint, &ir::Dielectric::tint, head);
  lint_roughness(session, checker, material, head);
}

void lint_material(Session& session, const ir::Conductor& material, const BlockChecker& checker,
                   Span head) {
  lint_roughness(session, checker, material, head);
}

void lint_material(Session& session, const ir::Ggx& material, const BlockChecker& checker,
                   Span head) {
  lint_color<ir::Ggx>(session, checker, material.base, &ir::Ggx::base, head);
  lint_roughness(session, checker, material, head);
}

}  // namespace scenec::frontend

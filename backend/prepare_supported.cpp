// What the language promises and this renderer does not carry out yet: said, never ignored.
#include <fmt/format.h>

#include <string>

#include "backend/prepare.hpp"

namespace scenec::backend {

namespace {

Span span_of(const ir::Scene& scene, ir::OriginId origin) {
  return origin.valid() ? scene.origins[origin].span : Span{};
}

void refuse(DiagnosticSink& sink, Span where, const std::string& what, const std::string& instead) {
  sink.report(Diagnostic(DiagnosticKind::not_carried_out, where,
                         what + " is not carried out by this version")
                  .hint(instead));
}

void check_layers(const ir::Scene& scene, DiagnosticSink& sink) {
  for (ir::Aov aov : scene.render.aovs) {
    if (aov != ir::Aov::trust) continue;
    refuse(sink, span_of(scene, scene.render_origin), "the layer `.trust`",
           "`.variance` shows how far a pixel is from settled");
  }
}

}  // namespace

void check_supported(const ir::Scene& scene, DiagnosticSink& sink) {
  check_layers(scene, sink);
}

}  // namespace scenec::backend

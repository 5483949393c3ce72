#include "frontend/check/check_scene.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

// The key `camera` of `render` is a name of the cameras' own table.
ir::CameraId named_camera(Session& session, NodeRef key) {
  const ir::Scene& scene = session.builder.scene();
  const std::string_view word = key.text();
  std::vector<std::string_view> names;
  for (std::uint32_t i = 0; i < scene.cameras.size(); ++i) {
    const ir::NameId name = scene.camera_names[Id<ir::Camera>(i)].name;
    if (!name.valid()) continue;
    names.push_back(scene.names[name]);
    if (names.back() == word) return ir::CameraId(i);
  }
  if (!key.is(SyntaxKind::name_ref)) {
    session.error(DiagnosticKind::type_mismatch, key.span(), "the camera is given by its name");
    return {};
  }
  session.report(unknown_word(DiagnosticKind::camera_not_declared, key.span(),
                              fmt::format("there is no camera `{}`", printable(word)), word, names,
                              "cameras"));
  return {};
}

void choose_camera(Session& session, const SceneNotes& notes, ir::RenderSettings& render) {
  if (notes.camera_key) {
    // Only when every camera could be read is a name that is not among them a mistake.
    if (notes.first_camera.valid() && session.builder.scene().cameras.empty()) return;
    render.camera = named_camera(session, notes.camera_key);
    return;
  }
  const std::size_t count = session.builder.scene().cameras.size();
  if (count > 0) render.camera = ir::CameraId(0);
  if (count < 2 || session.options.camera_chosen) return;
  session.error(Diagnostic(DiagnosticKind::several_cameras, notes.second_camera,
                           "the scene has several cameras, and `render` does not say which to use")
                    .note("the first is here", notes.first_camera)
                    .hint("name one of them in `render { camera = name; }`"));
}

void lint_materials(Session& session, const SceneNotes& notes) {
  if (notes.bare_count == 0) return;
  const std::string subject =
      notes.bare_count == 1
          ? "this shape has no material"
          : fmt::format("{} shapes, this one first, have no material", notes.bare_count);
  session.report(Diagnostic(DiagnosticKind::default_material, notes.first_bare,
                            subject + "; drawn as `diffuse { color = gray(0.5); }`"));
}

bool is_dark(const ir::RenderSettings& render) {
  return render.background == ir::black;
}

}  // namespace

void check_scene(Session& session, Span end_of_file, Lowering& lowering) {
  const SceneNotes& notes = lowering.notes();
  if (notes.is_empty) {
    if (!session.sink.has_errors())
      session.error(DiagnosticKind::empty_file, end_of_file,
                    "the file declares and places nothing");
    return;
  }
  choose_camera(session, notes, lowering.render());
  if (!notes.first_camera.valid()) {
    if (notes.first_placed.valid()) {
      session.error(
          Diagnostic(DiagnosticKind::missing_camera, end_of_file, "the scene has no camera")
              .hint("such as `camera main: pinhole { eye = [0, 1, 5]; aim = [0, 1, 0]; fov = "
                    "40deg; }`"));
    } else if (!session.options.library && !session.sink.has_errors()) {
      session.error(DiagnosticKind::nothing_placed, end_of_file,
                    "the file only declares things; there is nothing to render");
    }
    return;
  }
  lint_materials(session, notes);
  if (!notes.light && !notes.emission && is_dark(lowering.render())) {
    session.lint(Diagnostic(DiagnosticKind::no_light, notes.first_camera,
                            "the scene has no light, no emissive material and a black background")
                     .hint("such as `light key: point { position = [2, 4, 3]; power = 100W; }`"));
  }
}

void check_doc_comments(Session& session, const grammar::SyntaxTree& tree) {
  for (const grammar::Trivia& trivia : tree.trivia()) {
    if (trivia.kind != grammar::TriviaKind::doc_comment) continue;
    std::size_t at = trivia.begin;
    while (at > 0 && (tree.text()[at - 1] == ' ' || tree.text()[at - 1] == '\t')) --at;
    const bool alone =
        at == 0 || tree.text()[at - 1] == '\n' || tree.text()[at - 1] == '\r' || trivia.begin <= 3;
    if (alone) continue;
    session.lint(Diagnostic(DiagnosticKind::doc_comment_after_code,
                            {tree.file(), trivia.begin, trivia.end},
                            "a doc comment behind code documents nothing")
                     .hint("write `//`, or move it above the declaration")
                     .fix({tree.file(), trivia.begin, trivia.begin + 3}, "//"));
  }
}

}  // namespace scenec::frontend

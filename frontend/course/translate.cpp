#include "frontend/course/translate.hpp"

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/lights.hpp"
#include "frontend/course/materials.hpp"
#include "frontend/course/native_text.hpp"
#include "frontend/course/objects.hpp"

namespace scenec::frontend::course {

namespace {

// A whole number of pixels, also where the file says `200.0`.
Text pixels_of(const Entry& entry) {
  return text_of_value(entry.numbers.front().value, entry.values_span());
}

struct CameraTexts {
  Item item;
  std::optional<Text> size;
};

// The radius of the lens, where the camera has one.
std::optional<Text> aperture_of(const Fields& fields) {
  if (fields.value(Role::has_lens, 1) == 0) return std::nullopt;
  if (const Entry* const radius = fields.find(Role::aperture);
      radius != nullptr && radius->numbers[0].value != 0) {
    return text_of(radius->numbers[0]);
  }
  if (const Entry* const diameter = fields.find(Role::lens_diameter)) {
    return text_of_value(diameter->numbers[0].value / 2, diameter->values_span());
  }
  const Entry* const inverse = fields.find(Role::inverse_aperture);
  if (inverse != nullptr && inverse->numbers[0].value > 0) {
    return Text("1 / ").put(text_of(inverse->numbers[0]));
  }
  return std::nullopt;
}

CameraTexts read_camera(Context& context, const Entry& block) {
  const Fields fields(
      context, block, Place::camera,
      {Role::position, Role::direction, Role::up, Role::angle, Role::width, Role::height});
  CameraTexts camera;
  camera.item.origin = join(block.word_span, block.block.span());
  const Entry* const focus = fields.find(Role::focus);
  std::optional<Text> aperture = aperture_of(fields);
  if (aperture && focus == nullptr) {
    context.warn_once(DiagnosticKind::course_ignored_word, "aperture without focus",
                      block.word_span,
                      "the lens has no effect: the camera has no `focus` distance");
    aperture.reset();
  }
  camera.item.head.put("camera main: ").put(aperture ? "thin_lens" : "pinhole", block.word_span);
  const auto add = [&](std::string_view key, Role role) {
    if (const Entry* const entry = fields.find(role))
      camera.item.add(key, list_of(entry->numbers), entry->span);
  };
  add("eye", Role::position);
  add("direction", Role::direction);
  add("up", Role::up);
  if (const Entry* const angle = fields.find(Role::angle))
    camera.item.add("fov", degrees_of(angle->numbers[0]), angle->span);
  if (aperture) {
    camera.item.add("aperture", *aperture);
    camera.item.add("focus", text_of(focus->numbers[0]), focus->span);
  }
  const Entry* const width = fields.find(Role::width);
  const Entry* const height = fields.find(Role::height);
  if (width != nullptr && height != nullptr) {
    camera.size = Text("[").put(pixels_of(*width)).put(", ").put(pixels_of(*height)).put("]");
    camera.size->cover(0, join(width->span, height->span));
  }
  return camera;
}

// What the `Model` block of one author sets.
struct Settings {
  std::optional<ir::Method> method;
  std::optional<Text> samples;
  std::optional<Entry> background;
};

Settings read_model(Context& context, const Entry& block) {
  Settings settings;
  const Fields fields(context, block, Place::model, {});
  if (const Entry* const tracing = fields.find(Role::tracing)) {
    if (tracing->name == "Whitted") {
      settings.method = ir::Method::whitted;
    } else if (tracing->name == "Monte-Carlo") {
      settings.method = ir::Method::path;
    } else {
      context.error(DiagnosticKind::course_wrong_values, tracing->name_span,
                    fmt::format("`{}` is no way of tracing; known are `Whitted` and `Monte-Carlo`",
                                printable(tracing->name)));
    }
  }
  if (const Entry* const samples = fields.find(Role::samples))
    settings.samples = pixels_of(*samples);
  if (const Entry* const background = fields.find(Role::background))
    settings.background = *background;
  return settings;
}

// One translation: reads the blocks in their order, then writes the sections in the native one.
class Translator {
 public:
  Translator(const grammar::SyntaxTree& tree, Context& context)
      : tree_(tree),
        context_(context),
        materials_(context),
        objects_(context, materials_),
        lights_(context, materials_, objects_) {}

  Translation translate() {
    collect_blocks();
    read_blocks();
    return assemble();
  }

 private:
  // The last block of each role counts; Textures and Materials are read before what uses them.
  void collect_blocks() {
    BlockReader reader(context_, tree_.root(), Place::file);
    while (auto entry = reader.next()) {
      const Role role = entry->role() == Role::realistic_camera ? Role::camera : entry->role();
      if (role == Role::ignored_block) continue;
      const auto found = blocks_.find(role);
      if (found != blocks_.end()) {
        context_.sink.report(
            Diagnostic(DiagnosticKind::course_repeated_word, entry->word_span,
                       fmt::format("`{}` replaces an earlier block", entry->word->text))
                .note("the earlier block", found->second.word_span));
      }
      blocks_.insert_or_assign(role, std::move(*entry));
    }
    had_mistakes_ = reader.had_mistakes();
  }

  [[nodiscard]] const Entry* find(Role role) const {
    const auto found = blocks_.find(role);
    return found == blocks_.end() ? nullptr : &found->second;
  }

  void read_blocks() {
    if (const Entry* const textures = find(Role::textures)) materials_.read_textures(*textures);
    const Entry* const group = find(Role::group);
    const Entry* const materials = find(Role::materials);
    // The original resolves indices while it reads: materials behind the group come too late.
    const bool in_time = materials != nullptr &&
                         (group == nullptr || materials->word_span.begin < group->word_span.begin);
    if (materials != nullptr && in_time) materials_.read(*materials);
    read_camera_block();
    if (const Entry* const model = find(Role::model)) settings_ = read_model(context_, *model);
    read_background();
    if (const Entry* const lights = find(Role::lights)) lights_.read(*lights, Place::lights);
    if (const Entry* const disks = find(Role::disk_lights))
      lights_.read(*disks, Place::disk_lights);
    if (group != nullptr) {
      objects_.write_scene(*group, objects_text_);
    } else {
      missing_block("Group");
    }
    if (materials != nullptr && !in_time) materials_.read(*materials);
  }

  void missing_block(std::string_view word) {
    if (had_mistakes_) return;
    context_.error(DiagnosticKind::course_missing_block, {tree_.file(), 0, 0},
                   fmt::format("the scene has no `{}`", word));
  }

  void read_camera_block() {
    if (const Entry* const block = find(Role::camera)) {
      camera_ = read_camera(context_, *block);
    } else {
      missing_block("PerspectiveCamera");
    }
  }

  void read_background() {
    background_ = Text("gray(0.5)");
    if (settings_.background) background_ = color_of(settings_.background->numbers);
    const Entry* const block = find(Role::background);
    if (block == nullptr) return;
    const Fields fields(context_, *block, Place::background, {});
    if (const Entry* const color = fields.find(Role::color)) background_ = color_of(color->numbers);
  }

  [[nodiscard]] ir::Method method() const {
    if (context_.options.method) return *context_.options.method;
    if (settings_.method) return *settings_.method;
    switch (context_.vocabulary) {
      case Vocabulary::path:
        return ir::Method::path;
      case Vocabulary::whitted:
        return ir::Method::whitted;
      default:
        return ir::Method::phong;
    }
  }

  [[nodiscard]] Item render_item(ir::Method method) const {
    const bool by_the_book = method == ir::Method::phong &&
                             context_.vocabulary == Vocabulary::base && !context_.options.method;
    Item render;
    render.head.put("render");
    if (camera_ && camera_->size) render.add("size", *camera_->size);
    render.add("method",
               Text("." + std::string(
                              ir::EnumNames<ir::Method>::names[static_cast<std::size_t>(method)])));
    if (by_the_book) render.add("film", ".course");
    if (settings_.samples) render.add("samples", *settings_.samples);
    render.add("background", background_);
    return render;
  }

  Translation assemble() {
    const ir::Method method_used = method();
    Text lights;
    lights_.write(lights, method_used != ir::Method::phong);
    Text materials;
    materials_.write(materials, method_used == ir::Method::path);

    Text out("sdl 1;\n// Converted from a course scene.\n\n");
    write_item(out, render_item(method_used), 0);
    if (camera_) {
      out.put("\n");
      write_item(out, camera_->item, 0);
    }
    for (const Text* const section : {&materials, &lights, &objects_text_}) {
      if (!section->empty()) out.put("\n").put(*section);
    }
    Translation translation;
    translation.ranges = out.ranges();
    translation.text = std::move(out).take_text();
    return translation;
  }

  const grammar::SyntaxTree& tree_;
  Context& context_;
  Materials materials_;
  Objects objects_;
  Lights lights_;
  std::map<Role, Entry> blocks_;
  bool had_mistakes_ = false;  // at the top level: a block that seems missing may be misspelt
  std::optional<CameraTexts> camera_;
  Settings settings_;
  Text background_;
  Text objects_text_;
};

}  // namespace

Translation translate(const grammar::SyntaxTree& course, const TranslateOptions& options,
                      FileSystem& files, DiagnosticSink& sink) {
  Context context{options, files, sink, Vocabulary::base, {}};
  return Translator(course, context).translate();
}

}  // namespace scenec::frontend::course

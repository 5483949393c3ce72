#include "runtime/checkpoint.hpp"

#include <fmt/format.h>

#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/atomic_file.hpp"
#include "base/hash.hpp"
#include "base/packed_bytes.hpp"
#include "base/text.hpp"
#include "runtime/cli.hpp"
#include "runtime/picture_metadata.hpp"

namespace scenec::runtime {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "scenec checkpoint 1\n";
constexpr double usual_interval = 60;
constexpr std::uint32_t most_fields = 256;

void append_text(std::string& out, std::string_view text) {
  append_packed(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}
std::string take_text(PackedReader& reader) {
  const auto size = reader.value<std::uint32_t>();
  return std::string(reader.take(size));
}

std::optional<std::string> bytes_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  // In large steps: byte by byte the program itself took longer than a small picture.
  constexpr std::size_t step = std::size_t{1} << 20;
  std::string bytes;
  while (stream) {
    const std::size_t before = bytes.size();
    bytes.resize(before + step);
    stream.read(bytes.data() + before, static_cast<std::streamsize>(step));
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  return bytes;
}

// Two builds of one version can give other bytes, so the program itself is the version.
std::string program_hash() {
  const auto bytes = bytes_of_file("/proc/self/exe");
  return bytes ? hash_bytes(*bytes).hex() : std::string("unknown");
}

template <class E>
std::string name_of_value(E value) {
  return std::string(ir::EnumNames<E>::names[static_cast<std::size_t>(value)]);
}

std::string text_of(const ir::Color& color) {
  return fmt::format("{} {} {}", color.r, color.g, color.b);
}
std::string text_of(const std::optional<ir::Region>& region) {
  return region ? fmt::format("{},{},{},{}", region->x0, region->y0, region->x1, region->y1)
                : "the whole picture";
}

// What writers that were killed left behind: `.NAME.tmp-PROCESS` of processes that are gone.
void remove_leftovers(const std::string& path) {
  const fs::path file(path);
  const std::string start = "." + file.filename().string() + ".tmp-";
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start)) continue;
    const int process = std::atoi(name.c_str() + start.size());
    const bool is_gone = process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
    if (is_gone) fs::remove(entry.path(), ignored);
  }
}

Result<Checkpoint, std::string> checkpoint_of(const std::string& path) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) return Failure{std::string("cannot be read")};
  return read_checkpoint(*bytes);
}

}  // namespace

RenderIdentity identity_of(const ir::Scene& scene, const ir::RenderSettings& settings,
                           const ir::EffectSet& effects, const Options& options) {
  std::string layers;
  for (const ir::Aov aov : settings.aovs) layers += name_of_value(aov) + ' ';
  return {{"version", std::string(version_text)},
          {"program", program_hash()},
          {"scene", scene.hash.hex()},
          {"camera", fmt::format("{}", settings.camera.value())},
          {"size", fmt::format("{}x{}", settings.size.width, settings.size.height)},
          {"region", text_of(settings.region)},
          {"method", name_of_value(settings.method)},
          {"max_depth", settings.max_depth ? fmt::format("{}", *settings.max_depth) : "none"},
          {"seed", fmt::format("{}", settings.seed)},
          {"filter",
           fmt::format("{}({})", name_of_value(settings.filter.kind), settings.filter.radius)},
          {"film", name_of_value(settings.film)},
          {"sampler", name_of_value(settings.sampler)},
          {"background", text_of(settings.background)},
          {"effects", names_of(effects)},
          {"precision", fmt::format("{}", static_cast<int>(options.precision))},
          {"spread", options.adaptive ? "adaptive" : "even"},
          {"layers", layers}};
}

std::string checkpoint_bytes(const Checkpoint& checkpoint) {
  std::string body;
  append_packed(body, static_cast<std::uint32_t>(checkpoint.identity.size()));
  for (const auto& [name, value] : checkpoint.identity) {
    append_text(body, name);
    append_text(body, value);
  }
  append_packed(body, checkpoint.state.seconds);
  append_packed(body, static_cast<std::uint8_t>(checkpoint.state.error_reached));
  append_packed(body, static_cast<std::uint64_t>(checkpoint.sums.size()));
  body += checkpoint.sums;
  std::string bytes(magic);
  append_packed(bytes, hash_bytes(body));
  return bytes + body;
}

Result<Checkpoint, std::string> read_checkpoint(std::string_view bytes) {
  if (!bytes.starts_with(magic)) return Failure{std::string("is no checkpoint of this version")};
  PackedReader reader(bytes.substr(magic.size()));
  const auto hash = reader.value<Hash128>();
  if (!reader.ok() || hash_bytes(bytes.substr(magic.size() + sizeof hash)) != hash)
    return Failure{std::string("is damaged: its check sum is another one")};
  Checkpoint checkpoint;
  const auto fields = reader.value<std::uint32_t>();
  for (std::uint32_t i = 0; reader.ok() && i < std::min(fields, most_fields); ++i) {
    std::string name = take_text(reader);
    checkpoint.identity.emplace_back(std::move(name), take_text(reader));
  }
  checkpoint.state.seconds = reader.value<double>();
  checkpoint.state.error_reached = reader.value<std::uint8_t>() != 0;
  checkpoint.sums = reader.take(reader.value<std::uint64_t>());
  if (!reader.at_end() || fields > most_fields) return Failure{std::string("is damaged")};
  return checkpoint;
}

std::optional<std::string> find_mismatch(const RenderIdentity& checkpoint,
                                         const RenderIdentity& render) {
  for (std::size_t i = 0; i < render.size(); ++i) {
    const auto& [name, value] = render[i];
    if (i >= checkpoint.size() || checkpoint[i].first != name)
      return fmt::format("its fields are others, from `{}` on", name);
    if (checkpoint[i].second != value)
      return fmt::format("its `{}` is `{}`; this render's is `{}`", name,
                         printable(checkpoint[i].second), printable(value));
  }
  return std::nullopt;
}

CheckpointKeeper::CheckpointKeeper(const Options& options, RenderIdentity identity)
    : path_(checkpoint_path_of(options)),
      is_kept_(!options.checkpoint.empty()),
      interval_(options.checkpoint_interval ? options.checkpoint_interval->value : usual_interval),
      identity_(std::move(identity)) {}

std::optional<std::string> CheckpointKeeper::restore(backend::RenderSession& session,
                                                     backend::StopState& state) {
  remove_leftovers(path_);
  Result<Checkpoint, std::string> read = checkpoint_of(path_);
  if (!read.ok()) {
    Result<Checkpoint, std::string> previous = checkpoint_of(path_ + '~');
    if (!previous.ok()) return read.error();
    read = std::move(previous);
  }
  if (auto mismatch = find_mismatch(read.value().identity, identity_)) return mismatch;
  if (!session.restore(read.value().sums)) return "is damaged: its sums are not of this picture";
  state = read.value().state;
  saved_samples_ = session.samples();
  return std::nullopt;
}

void CheckpointKeeper::save_now_and_then(const backend::RenderSession& session,
                                         const backend::StopState& state) {
  if (path_.empty() || Clock::now() - last_ < interval_) return;
  save(session, state);
}

void CheckpointKeeper::save(const backend::RenderSession& session,
                            const backend::StopState& state) {
  if (path_.empty() || session.samples() == saved_samples_) return;
  last_ = Clock::now();
  // The generation before: another name of the same file, so that there is never none.
  std::error_code ignored;
  const std::string previous = path_ + '~';
  if (fs::is_regular_file(path_, ignored)) {
    fs::remove(previous, ignored);
    fs::create_hard_link(path_, previous, ignored);
  }
  const std::string bytes = checkpoint_bytes({identity_, state, session.save()});
  memory_ = std::max<std::uint64_t>(memory_, bytes.size());
  problem_ = write_file_atomically(path_, bytes);
  if (!problem_) saved_samples_ = session.samples();
}

void CheckpointKeeper::finish(const backend::RenderSession& session,
                              const backend::StopState& state) {
  if (path_.empty()) return;
  if (is_kept_) return save(session, state);
  problem_.reset();
  if (saved_samples_ < 0) return;  // nothing of ours
  std::error_code ignored;
  fs::remove(path_, ignored);
  fs::remove(path_ + '~', ignored);
}

std::string checkpoint_path_of(const Options& options) {
  if (options.checkpoint == "off") return {};
  return options.checkpoint.empty() ? output_of(options) + ".ckpt" : options.checkpoint;
}

}  // namespace scenec::runtime

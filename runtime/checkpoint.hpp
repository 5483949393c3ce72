// Checkpoints: the samples of a render as a file, to go on from after an interruption. A render
// that was taken up again ends with the same bytes as one that never stopped.
//
// The file says what its sums belong to — scene, settings, effects, program — and is taken by no
// other. It is replaced whole; the one before stays beside it with a `~`, for the day a file turns
// out to be damaged.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/render_session.hpp"
#include "base/result.hpp"
#include "ir/scene.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

// What decides about the bytes of a picture besides the number of samples: name and value.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] RenderIdentity identity_of(const ir::Scene& scene, const ir::RenderSettings& settings,
                                         const ir::EffectSet& effects, const Options& options);

struct Checkpoint {
  RenderIdentity identity;
  backend::StopState state;
  std::string sums;
};
[[nodiscard]] std::string checkpoint_bytes(const Checkpoint& checkpoint);
// Else what is wrong with the bytes.
[[nodiscard]] Result<Checkpoint, std::string> read_checkpoint(std::string_view bytes);
// Names the first part in which the checkpoint is one of another render.
[[nodiscard]] std::optional<std::string> find_mismatch(const RenderIdentity& checkpoint,
                                                       const RenderIdentity& render);

// The checkpoint of one render.
class CheckpointKeeper {
 public:
  // Written when the options' interval has passed. A file that `--checkpoint` names is kept at the
  // end, with the last samples; the one beside the output goes.
  CheckpointKeeper(const Options& options, RenderIdentity identity);

  // Takes the session up from the file; else what is wrong.
  [[nodiscard]] std::optional<std::string> restore(backend::RenderSession& session,
                                                   backend::StopState& state);
  // Saves when the interval has passed. What goes wrong is kept for problem(): the render goes on.
  void save_now_and_then(const backend::RenderSession& session, const backend::StopState& state);
  // Saves, whatever the time.
  void save(const backend::RenderSession& session, const backend::StopState& state);
  // The picture is done and written.
  void finish(const backend::RenderSession& session, const backend::StopState& state);
  // Why the last save failed.
  [[nodiscard]] const std::optional<std::string>& problem() const { return problem_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  // Bytes of the largest one that was made; 0: none was.
  [[nodiscard]] std::uint64_t memory() const { return memory_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::string path_;
  bool is_kept_;
  std::chrono::duration<double> interval_;
  RenderIdentity identity_;
  std::optional<std::string> problem_;
  std::int64_t saved_samples_ = -1;
  std::uint64_t memory_ = 0;
  Clock::time_point last_ = Clock::now();
};

// Where the checkpoint of these options lies; empty: none is written.
[[nodiscard]] std::string checkpoint_path_of(const Options& options);

}  // namespace scenec::runtime

// What a picture's file says of how it was made: the fields that runtime/picture_metadata.cpp
// writes and the layer `variance`. Only EXR files hold the numbers themselves, so only they can be
// held to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "backend/verification.hpp"
#include "base/result.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

struct Claim {
  std::string software;
  std::string scene_hash;
  std::string effects;
  std::string scene;  // path; empty: made without `--stamp`
  std::int64_t seed = 0;
  Options options;  // of the command that makes the picture, without a scene
  backend::PictureClaim picture;
};
// Else what is wrong with the file.
[[nodiscard]] Result<Claim, std::string> read_claim(std::string_view bytes);

}  // namespace scenec::runtime

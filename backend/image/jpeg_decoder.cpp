#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <utility>

#include "backend/image/decoders.hpp"

namespace scenec::backend {
namespace {

struct CloseHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};

AssetProblem problem_of(tjhandle handle) {
  return {0, fmt::format("damaged JPEG: {}", tjGetErrorStr2(handle))};
}

}  // namespace

DecodeResult decode_jpeg(std::string_view bytes, const ImageLimits& limits) {
  const std::unique_ptr<void, CloseHandle> handle(tjInitDecompress());
  if (handle == nullptr) return Failure{AssetProblem{0, "cannot start the JPEG decoder"}};
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colour_space = 0;
  if (tjDecompressHeader3(handle.get(), data, bytes.size(), &width, &height, &subsampling,
                          &colour_space) != 0) {
    return Failure{problem_of(handle.get())};
  }
  const bool gray = colour_space == TJCS_GRAY;
  DecodedImage image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.channels = gray ? 1 : 3;
  if (auto problem = find_size_problem(image.width, image.height, image.channels, limits)) {
    return Failure{std::move(*problem)};
  }
  // Not initialised: a header that lies about the size costs address space, no memory.
  const std::size_t size = std::size_t{image.width} * image.height * image.channels;
  const auto pixels = std::make_unique_for_overwrite<std::uint8_t[]>(size);
  // A warning is a damaged or cut-off file; the scan limit stops progressive time bombs.
  const int flags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  if (tjDecompress2(handle.get(), data, bytes.size(), pixels.get(), width, 0, height,
                    gray ? TJPF_GRAY : TJPF_RGB, flags) != 0) {
    return Failure{problem_of(handle.get())};
  }
  image.samples = std::vector<std::uint8_t>(pixels.get(), pixels.get() + size);
  return image;
}

}  // namespace scenec::backend

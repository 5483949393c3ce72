#include "runtime/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace scenec::runtime {

namespace {

constexpr std::chrono::milliseconds shortest_interval{100};
// Below this an estimate of the time left says more about start-up than about the picture.
constexpr double least_fraction_for_estimate = 0.01;

double seconds_between(std::chrono::steady_clock::time_point a,
                       std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

int percent_of(const backend::Progress& progress) {
  return static_cast<int>(std::floor(100 * std::clamp(progress.fraction, 0.0, 1.0)));
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(std::max(seconds, 0.0)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string error_text(const backend::ErrorBand& error) {
  const double half = 50 * (error.high - error.low);
  // Two digits of the band, and no more of the figure than the band lets stand.
  const int decimals =
      half > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, 6) : 2;
  return fmt::format("{:.{}f} % ± {:.{}f}", 100 * error.value, decimals, half, decimals);
}

std::string outlook_text(const backend::Progress& progress) {
  constexpr std::array levels{0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
  if (!progress.error.known || progress.seconds_a_sample <= 0) return {};
  const double now = progress.error.relative.value;
  const auto next = std::find_if(levels.begin(), levels.end(), [&](double l) { return l < now; });
  if (next == levels.end()) return {};
  const double ratio = now / *next;
  const double samples = static_cast<double>(progress.error_samples) * ratio * ratio -
                         static_cast<double>(progress.samples_done);
  return fmt::format("{} % in {}", short_number_text(100 * *next),
                     duration_text(samples * progress.seconds_a_sample));
}

ProgressPrinter::ProgressPrinter(ProgressStyle style, const Environment& environment)
    : form_(Form::none), err_(environment.err), start_(Clock::now()) {
  switch (style) {
    case ProgressStyle::automatic:
      form_ = environment.err_is_terminal ? Form::rewritten_line : Form::plain;
      break;
    case ProgressStyle::plain:
      form_ = Form::plain;
      break;
    case ProgressStyle::json:
      form_ = Form::json;
      break;
    case ProgressStyle::none:
      break;
  }
}

void ProgressPrinter::update(const backend::Progress& progress) {
  if (form_ == Form::none) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const Clock::time_point now = Clock::now();
  if (form_ == Form::plain) return print_plain(progress);
  if (printed_ && now - last_ < shortest_interval) return;
  last_ = now;
  printed_ = true;
  if (form_ == Form::json) return print_json(progress, now);
  print_rewritten(progress, now);
}

void ProgressPrinter::print_rewritten(const backend::Progress& progress, Clock::time_point now) {
  std::string line =
      fmt::format("\r{:3} %  {} samples a pixel", percent_of(progress), progress.samples_done);
  if (progress.error.known) {
    line += " · " + error_text(progress.error.relative);
    if (const std::string outlook = outlook_text(progress); !outlook.empty())
      line += " · " + outlook;
  }
  if (progress.fraction >= least_fraction_for_estimate) {
    const double left = seconds_between(start_, now) * (1 / progress.fraction - 1);
    line += fmt::format("  {} left", duration_text(left));
  }
  err_ << line << "\x1b[K" << std::flush;
}

void ProgressPrinter::print_plain(const backend::Progress& progress) {
  const int tenth = percent_of(progress) / 10;
  if (tenth <= last_tenth_) return;
  last_tenth_ = tenth;
  err_ << fmt::format("{} %\n", 10 * tenth) << std::flush;
}

void ProgressPrinter::print_json(const backend::Progress& progress, Clock::time_point now) {
  std::string error;
  if (progress.error.known) {
    const backend::ErrorBand& band = progress.error.relative;
    error = fmt::format(R"(,"error":{:.6g},"error_low":{:.6g},"error_high":{:.6g})", band.value,
                        band.low, band.high);
  }
  err_ << fmt::format(R"({{"event":"progress","fraction":{:.4f},"samples":{},"seconds":{:.3f}{}}})",
                      std::clamp(progress.fraction, 0.0, 1.0), progress.samples_done,
                      seconds_between(start_, now), error)
       << '\n'
       << std::flush;
}

void ProgressPrinter::finish() {
  const std::lock_guard lock(mutex_);
  if (form_ == Form::rewritten_line && printed_) err_ << "\r\x1b[K" << std::flush;
}

}  // namespace scenec::runtime

#include "backend/image/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

using Triple = std::array<double, 3>;
struct Plane {
  std::ptrdiff_t width = 0;
  std::ptrdiff_t height = 0;
  std::vector<Triple> pixels;

  [[nodiscard]] const Triple& at(std::ptrdiff_t x, std::ptrdiff_t y) const {
    x = std::clamp<std::ptrdiff_t>(x, 0, width - 1);
    y = std::clamp<std::ptrdiff_t>(y, 0, height - 1);
    return pixels[static_cast<std::size_t>(y * width + x)];
  }
};

// Of the reference white of the paper (D65, 2 degrees).
constexpr Triple white{0.950428545, 1.000000000, 1.088900371};

Triple xyz_of(const Triple& rgb) {
  return {0.4123907993 * rgb[0] + 0.3575843394 * rgb[1] + 0.1804807884 * rgb[2],
          0.2126390059 * rgb[0] + 0.7151686788 * rgb[1] + 0.0721923154 * rgb[2],
          0.0193308187 * rgb[0] + 0.1191947798 * rgb[1] + 0.9505321522 * rgb[2]};
}
Triple rgb_of(const Triple& xyz) {
  return {3.2409699419 * xyz[0] - 1.5373831776 * xyz[1] - 0.4986107603 * xyz[2],
          -0.9692436363 * xyz[0] + 1.8759675015 * xyz[1] + 0.0415550574 * xyz[2],
          0.0556300797 * xyz[0] - 0.2039769589 * xyz[1] + 1.0569715142 * xyz[2]};
}
// Linear opponent space: luminance, red against green, blue against yellow.
Triple opponent_of(const Triple& rgb) {
  const Triple xyz = xyz_of(rgb);
  const double x = xyz[0] / white[0];
  const double y = xyz[1] / white[1];
  const double z = xyz[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Triple rgb_of_opponent(const Triple& opponent) {
  const double y = (opponent[0] + 16) / 116;
  return rgb_of(
      {(opponent[1] / 500 + y) * white[0], y * white[1], (y - opponent[2] / 200) * white[2]});
}
// L*a*b* with the chroma lowered where it is dark (Hunt).
Triple hunt_lab_of(const Triple& rgb) {
  const Triple xyz = xyz_of(rgb);
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const double fx = f(xyz[0] / white[0]);
  const double fy = f(xyz[1] / white[1]);
  const double fz = f(xyz[2] / white[2]);
  const double l = 116 * fy - 16;
  return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}
double hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

Plane opponent_plane(const FloatImage& image) {
  Plane plane{image.width, image.height, {}};
  plane.pixels.resize(std::size_t{image.width} * image.height);
  for (std::size_t i = 0; i < plane.pixels.size(); ++i) {
    Triple rgb;
    for (std::size_t c = 0; c < 3; ++c)
      rgb[c] =
          std::fmin(std::fmax(static_cast<double>(image.samples[i * image.channels + c]), 0), 1);
    plane.pixels[i] = opponent_of(rgb);
  }
  return plane;
}

// One-dimensional weights for each channel, at -radius .. radius.
using Weights = std::vector<Triple>;

Plane filtered(const Plane& source, const Weights& across, const Weights& down) {
  const auto radius = static_cast<std::ptrdiff_t>(across.size() / 2);
  Plane rows = source;
  Plane result = source;
  const auto pass = [&](const Plane& from, Plane& to, const Weights& weights, std::ptrdiff_t dx,
                        std::ptrdiff_t dy) {
    for (std::ptrdiff_t y = 0; y < from.height; ++y) {
      for (std::ptrdiff_t x = 0; x < from.width; ++x) {
        Triple sum{};
        for (std::ptrdiff_t k = -radius; k <= radius; ++k) {
          const Triple& p = from.at(x + k * dx, y + k * dy);
          const Triple& w = weights[static_cast<std::size_t>(k + radius)];
          for (std::size_t c = 0; c < 3; ++c) sum[c] += w[c] * p[c];
        }
        to.pixels[static_cast<std::size_t>(y * from.width + x)] = sum;
      }
    }
  };
  pass(source, rows, across, 1, 0);
  pass(rows, result, down, 0, 1);
  return result;
}

// A Gaussian of the sensitivity exp(-pi^2 x^2 / b), b in degrees^2, not normalised.
double sensitivity(double b, double x) {
  return std::sqrt(pi / b) * exp(-pi * pi * x * x / b);
}

// The paper's sensitivities: luminance, red-green, blue-yellow (a sum of two Gaussians).
constexpr Triple narrow_b{0.0047, 0.0053, 0.04};
constexpr double wide_b = 0.025;
constexpr double narrow_a = 34.1;
constexpr double wide_a = 13.5;

Plane sensed(const Plane& source, double pixels_a_degree) {
  const double widest = std::sqrt(0.04 / (2 * pi * pi));
  const auto radius = static_cast<std::ptrdiff_t>(std::ceil(3 * widest * pixels_a_degree));
  const auto weights_of = [&](const Triple& b) {
    Weights weights(static_cast<std::size_t>(2 * radius + 1));
    Triple sum{};
    for (std::ptrdiff_t k = -radius; k <= radius; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double w = sensitivity(b[c], static_cast<double>(k) / pixels_a_degree);
        weights[static_cast<std::size_t>(k + radius)][c] = w;
        sum[c] += w;
      }
    }
    for (Triple& w : weights) {
      for (std::size_t c = 0; c < 3; ++c) w[c] /= sum[c];
    }
    return weights;
  };
  const Weights narrow = weights_of(narrow_b);
  const Weights wide = weights_of({narrow_b[0], narrow_b[1], wide_b});
  Plane result = filtered(source, narrow, narrow);
  const Plane second = filtered(source, wide, wide);
  // The paper's a sqrt(pi / b) exp(-pi^2 r^2 / b) has, over the plane, the integral a sqrt(b / pi).
  const double wide_part = wide_a * std::sqrt(wide_b);
  const double share = wide_part / (narrow_a * std::sqrt(narrow_b[2]) + wide_part);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    double& blue = result.pixels[i][2];
    blue += share * (second.pixels[i][2] - blue);
  }
  return result;
}

// Responses of luminance to an edge (first derivative of a Gaussian) and to a point (second),
// across and down.
struct Features {
  std::vector<double> edge;
  std::vector<double> point;
};
Features features_of(const Plane& opponent, double pixels_a_degree) {
  const double deviation = 0.5 * 0.082 * pixels_a_degree;
  const auto radius = static_cast<std::ptrdiff_t>(std::ceil(3 * deviation));
  const auto size = static_cast<std::size_t>(2 * radius + 1);
  // Channels: plain Gaussian, first derivative, second derivative.
  Weights weights(size);
  Triple positive{};
  Triple negative{};
  for (std::ptrdiff_t k = -radius; k <= radius; ++k) {
    const double x = static_cast<double>(k);
    const double g = exp(-x * x / (2 * deviation * deviation));
    Triple& w = weights[static_cast<std::size_t>(k + radius)];
    w = {g, -x * g, (x * x / (deviation * deviation) - 1) * g};
    for (std::size_t c = 0; c < 3; ++c) (w[c] > 0 ? positive : negative)[c] += std::abs(w[c]);
  }
  for (Triple& w : weights) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double sum = (w[c] > 0 ? positive : negative)[c];
      if (sum > 0) w[c] /= sum;
    }
  }
  Plane luminance = opponent;
  for (Triple& p : luminance.pixels) {
    const double y = (p[0] + 16) / 116;
    p = {y, y, y};
  }
  Weights plain = weights;
  for (Triple& w : plain) w = {w[0], w[0], w[0]};
  const Plane across = filtered(luminance, weights, plain);
  const Plane down = filtered(luminance, plain, weights);
  Features features;
  for (std::size_t i = 0; i < across.pixels.size(); ++i) {
    features.edge.push_back(std::hypot(across.pixels[i][1], down.pixels[i][1]));
    features.point.push_back(std::hypot(across.pixels[i][2], down.pixels[i][2]));
  }
  return features;
}

// The largest difference, between green and blue, spread so that most of the scale goes to small
// differences.
constexpr double colour_exponent = 0.7;
double spread(double difference) {
  constexpr double knee = 0.4;
  constexpr double at_knee = 0.95;
  static const double largest =
      pow(hyab(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})), colour_exponent);
  const double raised = pow(difference, colour_exponent);
  if (raised < knee * largest) return at_knee / (knee * largest) * raised;
  return at_knee + (raised - knee * largest) / (largest - knee * largest) * (1 - at_knee);
}

Triple shown(const Triple& opponent) {
  Triple rgb = rgb_of_opponent(opponent);
  for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
  return hunt_lab_of(rgb);
}

}  // namespace

std::vector<float> flip_of(const FloatImage& image, const FloatImage& reference,
                           double pixels_a_degree) {
  SCENEC_ASSERT(image.width == reference.width && image.height == reference.height);
  SCENEC_ASSERT(image.channels >= 3 && reference.channels >= 3);
  const Plane a = opponent_plane(image);
  const Plane b = opponent_plane(reference);
  const Plane seen_a = sensed(a, pixels_a_degree);
  const Plane seen_b = sensed(b, pixels_a_degree);
  const Features of_a = features_of(a, pixels_a_degree);
  const Features of_b = features_of(b, pixels_a_degree);
  std::vector<float> result(a.pixels.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double colour = spread(hyab(shown(seen_a.pixels[i]), shown(seen_b.pixels[i])));
    const double feature = std::sqrt(
        std::max(std::abs(of_a.edge[i] - of_b.edge[i]), std::abs(of_a.point[i] - of_b.point[i])) /
        std::sqrt(2.0));
    result[i] = static_cast<float>(colour > 0 ? pow(colour, 1 - std::min(feature, 1.0)) : 0);
  }
  return result;
}

}  // namespace scenec::backend

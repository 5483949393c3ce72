#include "frontend/eval/color.hpp"

#include <algorithm>

#include "base/elementary.hpp"

namespace scenec::frontend {

double srgb_decoded(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  return pow((encoded + 0.055) / 1.055, 2.4);
}

namespace {

// Piecewise Gaussian: the building block of the fits below.
double lobe(double wavelength, double peak, double left, double right) {
  const double t = (wavelength - peak) * (wavelength < peak ? left : right);
  return exp(-0.5 * t * t);
}

// CIE 1931 colour matching functions, wavelength in nm; multi-lobe fits of Wyman, Sloan and
// Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2013.
struct Xyz {
  double x, y, z;
};
Xyz matching(double nm) {
  return {0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
              0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
          0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
          1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

}  // namespace

ir::Color blackbody(double kelvin) {
  constexpr double second_radiation = 0.01438776877 * 1e9;  // h c / k [nm K] (CODATA 2018)
  constexpr int shortest = 360, longest = 830, step = 5;
  // Relative to the radiance at 560 nm, so that cold bodies do not underflow.
  const double reference = second_radiation / (560.0 * kelvin);
  Xyz sum{0, 0, 0};
  for (int nm = shortest; nm <= longest; nm += step) {
    const double u = second_radiation / (nm * kelvin);
    const double fifth = nm / 560.0;
    // e^reference / (e^u - 1), written so that neither power overflows.
    const double planck =
        exp(reference - u) / (1 - exp(-u)) / (fifth * fifth * fifth * fifth * fifth);
    const Xyz m = matching(nm);
    sum.x += planck * m.x;
    sum.y += planck * m.y;
    sum.z += planck * m.z;
  }
  const double x = sum.x / sum.y, z = sum.z / sum.y;
  ir::Color color{std::max(0.0, 3.2404542 * x - 1.5371385 - 0.4985314 * z),
                  std::max(0.0, -0.9692660 * x + 1.8760108 + 0.0415560 * z),
                  std::max(0.0, 0.0556434 * x - 0.2040259 + 1.0572252 * z)};
  const double luminance = 0.2126729 * color.r + 0.7151522 * color.g + 0.0721750 * color.b;
  return {color.r / luminance, color.g / luminance, color.b / luminance};
}

}  // namespace scenec::frontend

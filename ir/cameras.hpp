// Every camera, in world space. Directions and `up` need not be unit length or orthogonal.
#pragma once

#include <optional>
#include <tuple>
#include <variant>

#include "ir/schema.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

// Where a camera stands and looks; the first four keys of every camera.
struct CameraFrame {
  Point3 eye;
  std::optional<Point3> aim;
  std::optional<Direction> direction;
  Direction up{0, 1, 0};
};
inline constexpr auto camera_frame_keys = std::tuple{
    required(&CameraFrame::eye, "eye", range::any, "where the camera is"),
    key(&CameraFrame::aim, "aim", range::any, "the point it looks at"),
    key(&CameraFrame::direction, "direction", range::any, "the direction it looks in"),
    key(&CameraFrame::up, "up", range::any, "what points upwards in the picture"),
};
inline constexpr KeyRule aim_or_direction{KeyRule::Kind::exactly_one, {"aim", "direction"}};
inline constexpr KeyRule fov_or_focal{KeyRule::Kind::exactly_one, {"fov", "focal"}};

struct Pinhole : CameraFrame {
  std::optional<Angle> fov;
  std::optional<Length> focal;
};
template <>
struct Schema<Pinhole> {
  static constexpr std::string_view name = "pinhole";
  static constexpr std::string_view doc = "A pinhole camera: everything is sharp.";
  static constexpr auto keys = std::tuple_cat(
      camera_frame_keys,
      std::tuple{
          key(&Pinhole::fov, "fov", range::half_turn, "full vertical angle of view"),
          key(&Pinhole::focal, "focal", range::positive, "focal length for a sensor 24 mm high"),
      });
  static constexpr std::array rules{aim_or_direction, fov_or_focal};
};

// A distance along the axis, or `.aim`: the distance to the point looked at.
struct FocusDistance {
  bool at_aim = false;
  Length distance{1};
  friend constexpr auto operator<=>(const FocusDistance&, const FocusDistance&) = default;
};

struct ThinLens : CameraFrame {
  std::optional<Angle> fov;
  std::optional<Length> focal;
  std::optional<Length> aperture;
  std::optional<double> f_stop;
  FocusDistance focus;
  std::int64_t blades = 0;
};
template <>
struct Schema<ThinLens> {
  static constexpr std::string_view name = "thin_lens";
  static constexpr std::string_view doc = "A camera with a lens: sharp at one distance.";
  static constexpr auto keys = std::tuple_cat(
      camera_frame_keys,
      std::tuple{
          key(&ThinLens::fov, "fov", range::half_turn, "full vertical angle of view"),
          key(&ThinLens::focal, "focal", range::positive, "focal length for a sensor 24 mm high"),
          key(&ThinLens::aperture, "aperture", range::non_negative, "radius of the lens"),
          key(&ThinLens::f_stop, "f_stop", range::positive,
              "focal length over diameter of the lens"),
          required(&ThinLens::focus, "focus", range::positive,
                   "sharp distance along the axis, or .aim"),
          key(&ThinLens::blades, "blades", range::between(0, 64),
              "corners of the aperture; 0 is round"),
      });
  static constexpr std::array rules{aim_or_direction, fov_or_focal,
                                    KeyRule{KeyRule::Kind::exactly_one, {"aperture", "f_stop"}}};
};

struct Orthographic : CameraFrame {
  Length height{1};
};
template <>
struct Schema<Orthographic> {
  static constexpr std::string_view name = "orthographic";
  static constexpr std::string_view doc = "Parallel projection.";
  static constexpr auto keys = std::tuple_cat(
      camera_frame_keys, std::tuple{
                             required(&Orthographic::height, "height", range::positive,
                                      "height of the picture in the scene"),
                         });
  static constexpr std::array rules{aim_or_direction};
};

struct Panorama : CameraFrame {};
template <>
struct Schema<Panorama> {
  static constexpr std::string_view name = "panorama";
  static constexpr std::string_view doc = "All directions in one latitude-longitude picture.";
  static constexpr auto keys = camera_frame_keys;
  static constexpr std::array rules{aim_or_direction};
};

using CameraKind = std::variant<Pinhole, ThinLens, Orthographic, Panorama>;
struct Camera {
  CameraKind kind;
};

}  // namespace scenec::ir

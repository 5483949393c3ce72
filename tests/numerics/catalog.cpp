#include "tests/numerics/catalog.hpp"

#include <array>

namespace scenec::numerics {
namespace {

#define SCENEC_CASE(id, title, claim, bound) Case{id, title, claim, bound},
constexpr std::array sphere_cases{
#include "tests/numerics/catalog_spheres.def"
};
constexpr std::array triangle_cases{
#include "tests/numerics/catalog_triangles.def"
};
constexpr std::array revolve_cases{
#include "tests/numerics/catalog_revolve.def"
};
constexpr std::array scene_cases{
#include "tests/numerics/catalog_scenes.def"
};
#undef SCENEC_CASE

constexpr std::array all_sections{
    Section{"Spheres",
            "The textbook solves `t = (-b - sqrt(b^2 - 4ac)) / 2a`: far away `b^2` and `4ac` agree "
            "in most digits and their difference is noise. scenec takes the discriminant from the "
            "line's closest approach and adds only what has the same sign.",
            sphere_cases},
    Section{
        "Triangles and meshes",
        "The textbook (Möller–Trumbore) decides every triangle by itself, so two neighbours can "
        "both say no at their shared edge. scenec takes the sign of the same product, computed "
        "from the same numbers, for both.",
        triangle_cases},
    Section{
        "Surfaces of revolution",
        "The course's ray caster eliminates t by dividing by the ray's slope along the axis and "
        "lets a damped Newton iteration look for one root from each end of the curve "
        "(`solver = .newton`). scenec's `.certified` halves the curve until each piece is proven "
        "to hold no root or exactly one. The last column counts rays whose nearest hit Newton "
        "does not find.",
        revolve_cases},
    Section{
        "Scenes, trees and transforms",
        "Rays through everything: leaving a surface, through the accelerator, into the space of "
        "a transformed shape and back.",
        scene_cases},
};

constexpr std::array<std::string_view, 4> leak_names{
    "Möller–Trumbore, float", "Möller–Trumbore, double", "our kernel, fused by the compiler",
    "our kernel as built"};

constexpr std::array<std::string_view, 6> newton_names{"generic rays",        "abs(d_y) < 5e-5",
                                                       "abs(d_y) < 1e-15",    "level rays",
                                                       "rays along the axis", "rays from inside"};

constexpr std::array all_plots{
    Plot{"newton", PlotKind::bars, "A paraboloid by Newton: hits that are missed",
         "per cent (scenec misses none)", "", "R03", newton_names},
    Plot{"chords",
         PlotKind::curves,
         "Tessellated: distance from the surface",
         "steps round the axis",
         "largest distance",
         "R18",
         {}},
    Plot{"far-sphere",
         PlotKind::curves,
         "Error of the distance to a unit sphere",
         "distance of the ray's origin, in radii",
         "largest error of t",
         "G01",
         {}},
    Plot{"tiny-triangles",
         PlotKind::curves,
         "Rays that hit the triangle they are aimed at",
         "length of a leg",
         "per cent",
         "G12",
         {}},
    Plot{"leaks", PlotKind::bars, "Rays that leak out of a closed mesh",
         "of 60000 aimed at edges and vertices", "", "G15", leak_names},
};

}  // namespace

std::span<const Section> sections() {
  return all_sections;
}
std::span<const Plot> plots() {
  return all_plots;
}

}  // namespace scenec::numerics

"""Shared description of the speed scenes (right-handed, y up), whose .sdl twins are stdlib-scenes/bench/*.sdl and
statue.sdl beside this file. compare_light.py and cycles_light.py read it."""
import math

# S1 'cornell': open-fronted room, a mirror and a glass sphere, one disk light under the ceiling.
S1_QUADS = [  # (corners, albedo)
    ([(1, 0, 0), (1, 0, 170), (1, 81.6, 170), (1, 81.6, 0)], (.75, .25, .25)),
    ([(99, 0, 170), (99, 0, 0), (99, 81.6, 0), (99, 81.6, 170)], (.25, .25, .75)),
    ([(1, 0, 0), (1, 81.6, 0), (99, 81.6, 0), (99, 0, 0)], (.75, .75, .75)),
    ([(1, 0, 170), (1, 0, 0), (99, 0, 0), (99, 0, 170)], (.75, .75, .75)),
    ([(1, 81.6, 0), (1, 81.6, 170), (99, 81.6, 170), (99, 81.6, 0)], (.75, .75, .75)),
]
S1_MIRROR, S1_GLASS = ((27, 16.5, 47), 16.5), ((73, 16.5, 78), 16.5)
S1_LIGHT = ((50, 81.33, 81.6), 18.0, 12.0)  # centre, radius, radiance
S1_CAM = ((50, 52, 295.6), (50, 52 - .042612, 294.6), 2 * math.degrees(math.atan(.5135 / 2)))

# S2 'mesh': normalised mesh (longest edge 2, resting on y = 0), GGX conductor with alpha = 0.3^2, quad light, grey sky.
S2_GROUND = (12.0, (.5, .5, .5))  # half size, albedo
S2_METAL = ((.9, .7, .3), .3)  # reflectance, perceptual roughness (alpha = roughness squared)
S2_LIGHT = ((-1.5, 3.5, 1.5), 0.75, 15.0)  # centre, half size, radiance; faces -y
S2_SKY = .5
S2_CAM = ((0.6, 1.3, 3.6), (0, .62, 0), 36.0)

# S3 'whitted': 5x5 spheres on a checkered plane, one point light, mirror and glass recursion.
S3_SPHERES = [((i - 2, .42, j - 2), .42, ('mirror', 'glass', 'plastic')[(i + 2 * j) % 3],
               ((.8, .3, .3), (.3, .8, .3), (.3, .3, .8), (.8, .8, .3), (.3, .8, .8))[(i + j) % 5])
              for i in range(5) for j in range(5)]
S3_CHECK = ((.8, .8, .8), (.2, .2, .2))
S3_LIGHT = ((4, 7, 5), 260.0)
S3_SKY = (.35, .45, .6)
S3_CAM = ((1.5, 3.2, 6.0), (0, .2, .3), 34.0)  # vertical field of view
S3_DEPTH = 8

# 'small': the watch-mode case, three plain spheres on a plane, direct light only.
SMALL_SPHERES = [((-1, .5, 0), .5, (.8, .3, .3)), ((0, .5, .4), .5, (.3, .8, .3)), ((1, .5, -.2), .5, (.3, .3, .8))]
SMALL_CAM = ((0, 1.6, 4.5), (0, .4, 0), 35.0)
SMALL_LIGHT = ((3, 5, 4), 90.0)

#!/usr/bin/env python3
"""front_scenes.py OUTDIR [COUNT]: writes the stress scenes of the front end, COUNT (default
1,000,000) spheres or instances each, and the same spheres for POV-Ray:
    spheres.sdl  spheres.pov  listed.sdl (instances one by one)
    grid.sdl (a loop over a grid)  instances.sdl (a loop with three random numbers a place)
The same numbers stand in all of them, nine digits each, so both programs read equal scenes."""
import os
import random
import sys

out = sys.argv[1]
count = int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000
os.makedirs(out, exist_ok=True)
rng = random.Random(1)
points = [(rng.uniform(-1, 1), rng.uniform(0, 2), rng.uniform(-1, 1)) for _ in range(count)]

HEAD = ('sdl 1;\n'
        'material chalk: diffuse { color = gray(0.8); }\n'
        'light: point { position = [3, 5, 4]; power = 1000W; }\n'
        'camera main: pinhole { eye = [0.6, 1.3, 3.6]; aim = [0, 0.62, 0]; fov = 36deg; }\n'
        'render { size = [16, 16]; samples = 1; }\n')


def vector(point):
    return ', '.join('%.9g' % c for c in point)


def write(name, head, lines):
    with open(os.path.join(out, name), 'w') as file:
        file.write(head)
        file.writelines(lines)


write('spheres.sdl', HEAD,
      ('sphere { center = [%s]; radius = 0.004; material = chalk; }\n' % vector(p) for p in points))
write('spheres.pov',
      '#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n'
      'camera { location <0.6,1.3,3.6> right -x up y angle 36 look_at <0,0.62,0> }\n'
      'light_source { <3,5,4> rgb 1 }\n',
      ('sphere { <%s>, 0.004 pigment { rgb 0.8 } }\n' % vector(p) for p in points))
PAIR = ('proto pair {\n'
        '  sphere { radius = 0.004; material = chalk; }\n'
        '  sphere { center = [0, 0.006, 0]; radius = 0.003; material = chalk; }\n}\n')
side = max(1, round(count ** 0.5))
write('grid.sdl', HEAD + PAIR + 'for i in 0 ..< %d { for j in 0 ..< %d {\n'
      '  instance { of = pair; transform = move([i * 0.01, 0, j * 0.01]); }\n} }\n'
      % (side, side), ())
write('instances.sdl', HEAD + PAIR + 'for i in 0 ..< %d {\n'
      '  instance { of = pair; transform = move([random(1, i) * 2 - 1, random(2, i) * 2,\n'
      '                                          random(3, i) * 2 - 1]); }\n}\n' % count, ())
write('listed.sdl', HEAD + PAIR,
      ('instance { of = pair; transform = move([%s]); }\n' % vector(p) for p in points))

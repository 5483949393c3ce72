#!/usr/bin/env python3
"""make_gallery.py SCENEC: renders the pictures of docs/gallery.md and writes the page. The text of a
picture is the comment at the head of its scene."""
import os
import subprocess
import sys

# Scene and samples a pixel, in the order of the page: from what is simulated least.
PICTURES = [
    ('phong', 16), ('whitted', 32), ('cornell', 512), ('still-life', 512), ('glossy-row', 256),
    ('caustic-glass', 1024), ('rough-glass', 512), ('globe', 128), ('mapping', 128),
    ('leaves', 64), ('knot', 256), ('depth-of-field', 256), ('many-lights', 256),
    ('vases', 256), ('newton', 128), ('landscape', 64),
]
WIDTH = 288  # of the pictures: small enough for a page of them

here = os.path.dirname(os.path.abspath(__file__))
root = os.path.dirname(os.path.dirname(here))
images = os.path.join(root, 'docs', 'images', 'gallery')


def head_of(scene):
    """The first comment and the size of a scene."""
    words, size = [], (640, 480)
    for line in open(os.path.join(here, scene + '.sdl'), encoding='utf-8'):
        if line.startswith('// '):
            words.append(line[3:].strip())
        elif words and not line.startswith('sdl'):
            break
    for line in open(os.path.join(here, scene + '.sdl'), encoding='utf-8'):
        if 'size = [' in line and 'scale' not in line:
            inside = line.split('size = [')[1].split(']')[0].split(',')
            if all(part.strip().isdigit() for part in inside):
                size = tuple(int(part) for part in inside)
    return ' '.join(words), size


def main():
    scenec = os.path.abspath(sys.argv[1])
    only = sys.argv[2:]
    os.makedirs(images, exist_ok=True)
    page = ['''# Gallery

Scenes that come with scenec, in `stdlib-scenes/showcase/`, each rendered by the command beneath it.
`tests/unit/runtime/showcase_test.cpp` holds every scene to the effects it is there to show;
`stdlib-scenes/showcase/make_gallery.py` renders the pictures and writes this page.

## What a first renderer of this kind can do

| feature | scene, in `stdlib-scenes/` | test, in `tests/` |
|---|---|---|
| Phong ray casting | `showcase/phong.sdl` | `unit/backend/render_test.cpp`: `render.phong_pixel_equals_the_hand_computed_one` |
| Whitted's reflection, refraction, shadows | `showcase/whitted.sdl` | `unit/backend/render_edges_test.cpp`: `RenderEdges.CentralRayThroughAGlassBallHasTheClosedForm` |
| paths: matt, mirror, glass, glossy | `showcase/still-life.sdl` | `unit/backend/render_test.cpp`: `render.white_objects_vanish_in_a_white_furnace` |
| aiming at point lights | `showcase/whitted.sdl` | `unit/backend/render_test.cpp`: `render.point_light_over_a_plane_follows_the_closed_form` |
| aiming at directional lights | `showcase/landscape.sdl` | `unit/backend/lights/light_edges_test.cpp`: `LightEdges.ASunIsShadowedFromAnyDistance` |
| aiming at balls of light | `showcase/many-lights.sdl` | `unit/backend/render_test.cpp`: `LampOverFloor.gives_the_closed_form` |
| Cook and Torrance's facets, GGX | `showcase/glossy-row.sdl` | `unit/backend/materials/furnace_test.cpp`: `Furnace.SingleScatteringIsThatOfTheReferenceTable` |
| supersampling, tent filter | `showcase/cornell.sdl` | `unit/backend/film/film_test.cpp`: `Filters.sample_their_own_shape_about_the_centre` |
| textures on plane, sphere, revolve, triangle | `showcase/mapping.sdl` | `numerics/derivative_cases.cpp`: `G27Surface.IsWhatItSays` |
| leaves cut out by alpha | `showcase/leaves.sdl` | `unit/backend/render_test.cpp`: `render.opacity_and_cutout_hold_for_camera_and_shadow_rays` |
| interpolated normals | `showcase/knot.sdl` | `unit/backend/render_edges_test.cpp`: `RenderEdges.NoLightPassesASurfaceWhateverItsVertexNormals` |
| depth of field | `showcase/depth-of-field.sdl` | `unit/backend/render_edges_test.cpp`: `RenderEdges.BlurHasTheDiameterOfTheCircleOfConfusion` |
| boxes and a tree | `showcase/landscape.sdl` | `unit/backend/accel/scene_accel_test.cpp`: `SceneAccel.AgreesWithBruteForce` |
| revolution by Newton | `showcase/newton.sdl` | `numerics/revolve_cases.cpp`: `R03.NewtonMissesRoots` |
| all cores busy, same bytes | `showcase/landscape.sdl` | `unit/backend/render_test.cpp`: `render.bytes_do_not_depend_on_threads` |
''']
    for scene, samples in PICTURES:
        text, (width, height) = head_of(scene)
        small = (WIDTH, round(WIDTH * height / width))
        target = os.path.join('docs', 'images', 'gallery', scene + '.png')
        command = ['render', f'stdlib-scenes/showcase/{scene}.sdl', '-o', target, '--size',
                   f'{small[0]}x{small[1]}', '--samples', str(samples)]
        if not only or scene in only:
            subprocess.run([scenec, *command, '--progress', 'none'], cwd=root, check=True)
        page.append(f'''## {scene.replace('-', ' ')}

![{scene}](images/gallery/{scene}.png)

{text}

    scenec {' '.join(command)}
''')
    with open(os.path.join(root, 'docs', 'gallery.md'), 'w', encoding='utf-8') as out:
        out.write('\n'.join(page))


main()

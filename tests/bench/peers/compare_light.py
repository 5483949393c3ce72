#!/usr/bin/python3
"""compare_light.py SCENEC [--mesh DRAGON.ply] [--runs 3] [--threads 1] [--out DIR] [--only s1,s2,s3,small]
Renders the speed scenes with scenec, POV-Ray (s3, small) and Cycles (s1, s2, s3), in turn, and prints
for each the median CPU seconds, the samples a CPU second, and for s1 and s2 relMSE against a long
reference of the program's own and cost = relMSE x CPU seconds. Needs povray, blender and
python3-openimageio (Debian); a program that is absent is left out. The mesh is to be normalised:
longest edge 2, resting on y = 0; Cycles reads it as OBJ (DRAGON.obj beside the PLY)."""
import argparse
import math
import os
import resource
import shutil
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
import light_model as m

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, '..', '..', '..')
args = argparse.ArgumentParser(description=__doc__)
args.add_argument('scenec')
args.add_argument('--mesh')
args.add_argument('--runs', type=int, default=3)
args.add_argument('--threads', type=int, default=1)
args.add_argument('--out', default='light-bench')
args.add_argument('--only', default='s1,s2,s3,small')
args.add_argument('--reference', type=int, default=8, help='times the samples')
opt = args.parse_args()
opt.scenec = os.path.abspath(opt.scenec)
if opt.mesh:
    opt.mesh = os.path.abspath(opt.mesh)
os.makedirs(opt.out, exist_ok=True)
os.chdir(opt.out)
SIZE = {'s1': (512, 512, 64), 's2': (960, 960, 32), 's3': (1920, 1080, 1), 'small': (200, 200, 1)}
FILE = {'s1': 'stdlib-scenes/bench/cornell.sdl', 's3': 'stdlib-scenes/bench/spheres.sdl',
        'small': 'stdlib-scenes/bench/small.sdl'}


def cpu_of(command, env=None):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=env)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise SystemExit('failed: ' + ' '.join(command))
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def scenec(name, samples, seed, out):
    command = [opt.scenec, 'render']
    if name == 's2':
        shutil.copy(os.path.join(HERE, 'statue.sdl'), 'statue.sdl')
        if not os.path.exists('dragon.ply'):
            shutil.copy(opt.mesh, 'dragon.ply')
        command.append('statue.sdl')
    else:
        shutil.copy(os.path.join(ROOT, FILE[name]), name + '.sdl')
        command.append(name + '.sdl')
    return cpu_of(command + ['--samples', str(samples), '--seed', str(seed), '-o', out, '--threads',
                             str(opt.threads), '--progress', 'none'])


def cycles(name, samples, seed, out):
    env = dict(os.environ, CYCLES_SEED=str(seed), CYCLES_THREADS=str(opt.threads))
    more = [os.path.splitext(opt.mesh)[0] + '.obj'] if name == 's2' else []
    return cpu_of(['blender', '-b', '--factory-startup', '--python',
                   os.path.join(HERE, 'cycles_light.py'), '--', name, str(samples),
                   os.path.abspath(out), *more], env)


def p(x):
    return '<' + ','.join('%.9g' % c for c in x) + '>'


def pov_text(name):
    eye, at, fov = m.S3_CAM if name == 's3' else m.SMALL_CAM
    aspect = SIZE[name][0] / SIZE[name][1]
    across = 2 * math.degrees(math.atan(math.tan(math.radians(fov) / 2) * aspect))
    text = ('#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level %d }\n'
            'camera { location %s right -%.6f*x up y angle %.6f look_at %s }\n'
            % (m.S3_DEPTH, p(eye), aspect, across, p(at)))
    if name == 'small':
        text += 'light_source { %s rgb 1 }\nplane { y, 0 pigment { rgb .6 } }\n' % p(m.SMALL_LIGHT[0])
        for c, r, color in m.SMALL_SPHERES:
            text += 'sphere { %s, %g pigment { rgb %s } finish { ambient 0 diffuse .8 } }\n' % (p(c), r, p(color))
        return text
    text += ('background { rgb %s }\nlight_source { %s rgb 1 }\n'
             'plane { y, 0 pigment { checker rgb %s rgb %s } finish { ambient 0 diffuse .85 } }\n'
             % (p(m.S3_SKY), p(m.S3_LIGHT[0]), p(m.S3_CHECK[0]), p(m.S3_CHECK[1])))
    finish = {'mirror': 'pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection .9 }',
              'glass': 'pigment { rgbt 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel on } '
                       'conserve_energy } interior { ior 1.5 }'}
    for c, r, kind, color in m.S3_SPHERES:
        text += 'sphere { %s, %g %s }\n' % (
            p(c), r, finish.get(kind, 'pigment { rgb %s } finish { ambient 0 diffuse .85 }' % p(color)))
    return text


def povray(name, samples, seed, out):
    with open(name + '.pov', 'w') as file:
        file.write(pov_text(name))
    return cpu_of(['povray', '+I' + name + '.pov', '+O' + os.path.splitext(out)[0] + '.png', '-D', '-A',
                   '+W%d' % SIZE[name][0], '+H%d' % SIZE[name][1], '+WT%d' % opt.threads])


def load(path):
    import numpy
    import OpenImageIO
    image = OpenImageIO.ImageInput.open(path)
    names = list(image.spec().channelnames)
    pixels = numpy.asarray(image.read_image('float'), 'f8')
    return pixels[:, :, [next(k for k, n in enumerate(names) if n.split('.')[-1] == c) for c in 'RGB']]


def rel_mse(path, reference):
    e = load(path) - reference
    # The reference's own noise is taken out: it has that many times the samples.
    share = opt.reference / (opt.reference + 1)
    return float((e * e / (reference * reference + 0.01)).mean()) * share


PROGRAMS = {'s1': [scenec, cycles], 's2': [scenec, cycles], 's3': [scenec, povray, cycles],
            'small': [scenec, povray]}
HAVE = {scenec: True, cycles: shutil.which('blender'), povray: shutil.which('povray')}
print('%-6s %-8s %9s %12s %9s %9s   (median of %d runs in turn, %d thread(s))'
      % ('scene', 'program', 'CPU s', 'M samples/s', 'relMSE', 'cost', opt.runs, opt.threads))
for name in opt.only.split(','):
    if name == 's2' and not opt.mesh:
        continue
    width, height, samples = SIZE[name]
    programs = [f for f in PROGRAMS[name] if HAVE[f]]
    seconds = {f: [] for f in programs}
    out = {f: '%s-%s.exr' % (name, f.__name__) for f in programs}
    for run in range(opt.runs):
        for f in programs:
            seconds[f].append(f(name, samples, run + 1, out[f]))
    for f in programs:
        cpu = statistics.median(seconds[f])
        line = '%-6s %-8s %9.2f %12.3f' % (name, f.__name__, cpu, width * height * samples / cpu * 1e-6)
        if name in ('s1', 's2') and opt.reference > 0:
            f(name, samples * opt.reference, 100, 'reference.exr')
            error = rel_mse(out[f], load('reference.exr'))
            line += ' %9.5f %9.4f' % (error, error * cpu)
        print(line, flush=True)

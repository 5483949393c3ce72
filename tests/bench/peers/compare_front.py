#!/usr/bin/env python3
"""compare_front.py SCENEC [--spheres N] [--runs R]: one million literal spheres to the first pixel
(16x16, one sample, whole process, two threads) by scenec and by POV-Ray in turn, and what a loop of
instances costs. Prints every run, the medians and the ratio. POV-Ray is skipped when it is absent.
With --gate it exits 1 when the goals of docs/performance.md are missed."""
import argparse
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument('scenec')
parser.add_argument('--spheres', type=int, default=1_000_000)
parser.add_argument('--runs', type=int, default=3)
parser.add_argument('--threads', type=int, default=2)
parser.add_argument('--gate', action='store_true')
args = parser.parse_args()
scenec = os.path.abspath(args.scenec)
here = os.path.dirname(os.path.abspath(__file__))


def run(command, folder):
    """Wall seconds, CPU seconds and peak bytes of one process."""
    start = time.monotonic()
    pid = os.fork()
    if pid == 0:
        os.chdir(folder)
        null = os.open(os.devnull, os.O_RDWR)
        for number in (0, 1, 2):
            os.dup2(null, number)
        try:
            os.execvp(command[0], command)
        finally:
            os._exit(127)
    _, status, usage = os.wait4(pid, 0)
    wall = time.monotonic() - start
    if status != 0:
        sys.exit(f'{command[0]} failed with status {status}')
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def show(name, result, items):
    wall, cpu, peak = result
    print(f'{name:24} {wall:7.3f} s wall  {cpu:7.3f} s CPU  {peak / items:7.0f} B an item', flush=True)


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, os.path.join(here, 'front_scenes.py'), folder, str(args.spheres)],
                   check=True)
    ours = [scenec, 'render', 'spheres.sdl', '-o', 'ours.png', '--threads', str(args.threads),
            '--progress', 'none']
    theirs = ['povray', '+Ispheres.pov', '+Otheirs.png', '-D', '+W16', '+H16', '-A',
              f'+WT{args.threads}']
    cases = {'scenec, spheres': ours}
    if shutil.which('povray'):
        cases['POV-Ray, spheres'] = theirs
    else:
        print('POV-Ray is not installed: no comparison (apt-get install povray)')
    cases['scenec check, instances'] = [scenec, 'check', 'instances.sdl', '--threads', '1']
    cases['scenec check, grid'] = [scenec, 'check', 'grid.sdl', '--threads', '1']
    cases['scenec check, listed'] = [scenec, 'check', 'listed.sdl', '--threads', str(args.threads)]
    results = {name: [] for name in cases}
    for _ in range(args.runs):
        for name, command in cases.items():
            results[name].append(run(command, folder))
            show(name, results[name][-1], args.spheres)

median = {name: [statistics.median(column) for column in zip(*runs)]
          for name, runs in results.items()}
print('medians')
for name, row in median.items():
    show(name, row, args.spheres)
missed = []
wall, _, peak = median['scenec, spheres']
if wall > 1.6:
    missed.append(f'first pixel after {wall:.2f} s, not 1.6 s')
if peak > 600 * args.spheres:
    missed.append(f'{peak / args.spheres:.0f} B a sphere, not 600 B')
if 'POV-Ray, spheres' in median:
    ratio = median['POV-Ray, spheres'][0] / wall
    print(f'POV-Ray takes {ratio:.2f} times as long')
    if ratio < 3:
        missed.append(f'{ratio:.2f} times POV-Ray, not 3 times')
if median['scenec check, grid'][1] > 0.8:
    missed.append(f"a loop of instances takes {median['scenec check, grid'][1]:.2f} s of CPU, not 0.8 s")
for line in missed:
    print('missed:', line)
sys.exit(1 if args.gate and missed else 0)

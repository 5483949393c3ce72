#!/usr/bin/env python3
"""effects_gain.py SCENEC [--runs 3] [--size 160x120] [--samples 8] [SCENE...]
What leaving out uncalled-for effects saves: renders each scene (default: every one that renders in
stdlib-scenes) with `--effects found` and `--effects all` in turn on one thread and prints the least CPU
seconds of each, their ratio, the kernel, and whether the pictures are the same bytes."""
import argparse
import glob
import json
import os
import resource
import subprocess
import tempfile

args = argparse.ArgumentParser(description=__doc__)
args.add_argument('scenec')
args.add_argument('scenes', nargs='*')
args.add_argument('--runs', type=int, default=3)
args.add_argument('--size', default='160x120')
args.add_argument('--samples', default='8')
opt = args.parse_args()
root = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'stdlib-scenes')
scenes = opt.scenes or sorted(glob.glob(os.path.join(root, '*', '*.sdl')))


def render(scene, effects, out):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([opt.scenec, 'render', scene, '--effects', effects, '--threads', '1', '--size', opt.size,
                           '--samples', opt.samples, '-o', out, '--progress', 'none', '--stats=json:' + out + '.json'],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before if done.returncode == 0 else None


print('| scene | kernel | found, CPU s | all, CPU s | gain | same bytes |\n|---|---|---|---|---|---|')
with tempfile.TemporaryDirectory() as folder:
    for scene in scenes:
        least = {}
        out = {e: os.path.join(folder, e + '.png') for e in ('found', 'all')}
        for _ in range(opt.runs):
            for effects in out:
                seconds = render(scene, effects, out[effects])
                if seconds is None:
                    break
                least[effects] = min(seconds, least.get(effects, seconds))
        if len(least) < 2:
            continue  # a library
        same = open(out['found'], 'rb').read() == open(out['all'], 'rb').read()
        kernel = json.load(open(out['found'] + '.json'))['kernel']
        print('| %s | %s | %.2f | %.2f | %.2f | %s |' % (
            os.path.relpath(scene, root), kernel, least['found'], least['all'], least['all'] / least['found'],
            'yes' if same else 'NO'), flush=True)

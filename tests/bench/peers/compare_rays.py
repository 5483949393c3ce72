#!/usr/bin/env python3
"""Single rays beside Embree: runs the recorder of rays and scenec-bench in turn on the same meshes and
prints the ratios.

    python3 tests/bench/peers/compare_rays.py build/release/scenec-bench EMBREE_RAYS MESH.obj...
        [--threads N] [--repeat N] [--resolution N] [--interior MESH.obj]

EMBREE_RAYS is the built recorder (it prints Embree's rates and writes the rays it traced with the hits
it found). Without it, scenec-bench rays can still replay a dump that another machine recorded.
Ratios compare the best of the rounds, mode single only.
"""
import argparse
import math
import os
import re
import subprocess
import tempfile

SETS = ("primary", "diffuse", "shuffled", "shadow")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def embree_rates(text, threads):
    """By (quality, robust) and set: the best rate, packets left out."""
    rates, config = {}, None
    for line in text.splitlines():
        if found := re.match(r"build (\w+)\s+robust=(\d)", line):
            config = (found[1], found[2] == "1")
        elif found := re.match(rf"\s+(\w+)\s+threads={threads}\s+([\d.]+) Mrays/s best", line):
            rates.setdefault(config, {})[found[1]] = float(found[2])
    return rates


def our_rates(text):
    build = re.search(r"build seconds ([\d.]+) .*bytes_per_triangle ([\d.]+)", text)
    rates = {}
    mismatches = 0
    for found in re.finditer(r"set (\w+) mode single .*mrays_best ([\d.]+) .*mismatches (\d+)", text):
        rates[found[1]] = float(found[2])
        mismatches += int(found[3])
    return rates, float(build[1]), float(build[2]), mismatches


def compare(options, mesh, work):
    dump = os.path.join(work, "rays")
    interior = "1" if mesh in options.interior else "0"
    theirs, ours = {}, {}
    for _ in range(options.repeat):  # in turn, so that both see the same neighbours
        text = run(options.embree_rays, mesh, str(options.resolution), "1", interior, dump)
        for config, rates in embree_rates(text, options.threads).items():
            for name, rate in rates.items():
                slot = theirs.setdefault(config, {})
                slot[name] = max(slot.get(name, 0), rate)
        text = run(options.bench, "rays", dump, "--mesh", mesh, "--threads", str(options.threads),
                   "--repeat", "1")
        rates, seconds, size, mismatches = our_rates(text)
        for name, rate in rates.items():
            ours[name] = max(ours.get(name, 0), rate)
    robust, fastest = theirs[("medium", True)], theirs[("high", False)]
    print(f"{os.path.basename(mesh)}: build {seconds:.3f} s, {size:.1f} B a triangle, "
          f"{mismatches} mismatches")
    ratios = []
    for name in SETS:
        ratios.append(ours[name] / robust[name])
        print(f"  {name:9} {ours[name]:7.2f} Mrays/s  x robust {ratios[-1]:.2f}  "
              f"x fastest {ours[name] / fastest[name]:.2f}")
    return ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bench")
    parser.add_argument("embree_rays")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--resolution", type=int, default=1024)
    parser.add_argument("--interior", action="append", default=[])
    options = parser.parse_args()
    ratios = []
    with tempfile.TemporaryDirectory() as work:
        for mesh in options.meshes + options.interior:
            ratios += compare(options, mesh, work)
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    print(f"geometric mean against robust: {mean:.3f}, smallest {min(ratios):.3f}")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""What a batch costs through Python, against the same batch by the program: the same rays, in turns, one thread.

usage: PYTHONPATH=build/python bench/python_speed.py BOXWOOD SCENE [RECIPE [ROUNDS]]
"""
import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

import boxwood


def sets_of(path):
    """The ray sets of a file, by kind; docs/ray-sets.md."""
    data = open(path, "rb").read()
    at, out = 16, {}
    for _ in range(struct.unpack_from("<I", data, 12)[0]):
        length, query, count = struct.unpack_from("<IIQ", data, at)
        start = at + 16 + (length + 15) // 16 * 16
        out[data[at + 16 : at + 16 + length].decode()] = query, np.frombuffer(data, "<f4", 8 * count, start).reshape(count, 8)
        at = start + 32 * count
    return out


def seconds_here(structure, query, rays):
    best = np.inf
    for _ in range(3):
        begin = time.perf_counter()
        structure.any_hits(rays) if query else structure.closest_hits(rays)
        best = min(best, time.perf_counter() - begin)
    return best


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, scene = sys.argv[1:3]
    recipe = sys.argv[3] if len(sys.argv) > 3 else "default"
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 7
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "scene.rays")
        compare = [program, "compare", scene, "-a", recipe, "--json", "--threads", "1"]
        subprocess.run([*compare, "--size", "1000x1000", "--repeat", "1", "--save-rays", file], check=True, stdout=subprocess.DEVNULL)
        sets, structure = sets_of(file), boxwood.load(scene, recipe)
        ratios = {kind: [] for kind in sets}
        for _ in range(rounds):
            report = json.loads(subprocess.run([*compare, "--repeat", "3", "--load-rays", file], check=True, stdout=subprocess.PIPE).stdout)
            there = report["scenes"][0]["rows"][0]["rays"]
            for kind, (query, rays) in sets.items():
                ratios[kind].append(len(rays) / seconds_here(structure, query, rays) / 1e6 / there[kind]["mrays_per_s"]["high"])
    print(f"{'rays':12} {'count':>9} {'Python / C++':>13} {'lowest':>7} {'highest':>8}")
    for kind, found in ratios.items():
        print(f"{kind:12} {len(sets[kind][1]):9} {statistics.median(found):13.3f} {min(found):7.3f} {max(found):8.3f}")


if __name__ == "__main__":
    main()

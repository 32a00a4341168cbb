#!/usr/bin/env python3
"""The table of docs/structures/README.md, measured anew: every structure over the same kind of tree, in one interleaved run per scene.

usage: structure-table.py BOXWOOD SCENE... > table.md
"""
import json
import subprocess
import sys

RECIPES = [
    "binned > binary",
    "binned > wide(8) > trace(simd=off)",
    "binned > optimal-collapse(8) > wide(8)",
    "binned > optimal-collapse(16, leaf=8, block=8) > wide(16)",
    "binned > optimal-collapse(8, leaf=8, block=8) > compressed(8)",
    "binned > slab",
    "binned > slab(packet=8)",
    "binned > binary-split",
    "binned > optimal-collapse(8) > wide-slab(8, planes=4)",
    "binned > bih",
    "octree > octree",
    "octree > bit-octree(form=milestones)",
    "binned > quantized(form=milestones)",
    "binned > oriented",
    "embree",
    "default",
]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    command = [sys.argv[1], "compare", *sys.argv[2:], "--rays", "primary,shadow,ao,diffuse", "--size", "256x256", "--repeat", "7", "--json"]
    for recipe in RECIPES:
        command += ["-a", recipe]
    report = json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout)
    for scene in report["scenes"]:
        print(f"**{scene['name']}**, {scene['triangles']:,} triangles\n")
        kinds = list(scene["rows"][0]["rays"])
        print("| recipe | bytes/triangle | build ms | " + " | ".join(kinds) + " |")
        print("|---|" + "---:|" * (2 + len(kinds)))
        for row in scene["rows"]:
            speeds = [f"{row['rays'][kind]['mrays_per_s']['median']:.2f}" for kind in kinds]
            print(f"| `{row['recipe']}` | {row['bytes_per_triangle']:.1f} | {row['build_ms']['median']:.0f} | " + " | ".join(speeds) + " |")
        print()


if __name__ == "__main__":
    main()

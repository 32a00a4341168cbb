#!/usr/bin/env python3
"""Is the pick of `boxwood advise` as good as what measuring every candidate finds? The table of docs/advise.md.

usage: advise-check.py BOXWOOD TIME SCENE... > table.md     TIME: what the search is given, such as 60s

Both get the same rays. Their picks are then compared in one interleaved run, so that the ratio is not that of two measurements apart.
"""
import json
import os
import subprocess
import sys
import tempfile
from time import monotonic


def run(*command):
    """What a command says, and the seconds it took."""
    begin = monotonic()
    text = subprocess.run([*command, "--json"], stdout=subprocess.PIPE, check=True, text=True).stdout
    return json.loads(text), monotonic() - begin


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    boxwood, time = sys.argv[1:3]
    print("| scene | triangles | advised | best of all | speed advised / best | time of search / of all |")
    print("|---|---:|---|---|---:|---:|", flush=True)
    for scene in sys.argv[3:]:
        with tempfile.TemporaryDirectory() as folder:
            rays = os.path.join(folder, "scene.rays")
            advised, search_time = run(boxwood, "advise", scene, "--time", time, "--save-rays", rays)
            best, whole_time = run(boxwood, "advise", scene, "--exhaustive", "--rays", rays)
            fastest = max(best["rows"], key=lambda row: row["mrays_per_s"]["median"])["recipe"]
            pick = advised["recommended"]
            ratio = "1"
            if pick != fastest:
                report, _ = run(boxwood, "compare", scene, "-a", fastest, "-a", pick, "--load-rays", rays, "--repeat", "15")
                kinds = [(a, b) for a, b in zip(*(row["rays"].values() for row in report["scenes"][0]["rows"]))]
                times = [sum(kind["rays"] / kind["mrays_per_s"]["median"] for kind in side) for side in zip(*kinds)]
                ratio = f"{times[0] / times[1]:.3f}"
            print(f"| {advised['scene']} | {advised['triangles']:,} | `{pick}` | `{fastest}` | {ratio} | {search_time / whole_time:.3f} |", flush=True)


if __name__ == "__main__":
    main()

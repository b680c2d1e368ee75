"""Times Mitsuba 3's path tracer on one of our scenes: the yardstick of chainlight's own path tracer.

    python3 tests/oracle/time_mitsuba.py [--scene cornell-box] [--size 256] [--spp 64]

Settings that match ours: next event estimation and multiple importance sampling, the scene's
`max_depth`, Russian roulette from depth 5, box filter, independent samples. Each variant and number
of threads runs in a process of its own. What is printed, per path (one sample of one pixel):

* warm-up: the first call, which in `llvm_ad_rgb` traces and compiles the kernel. Not counted below.
* ns per path and paths per second: wall time, the median of `--repeats` further calls with new
  seeds; the spread is the fastest and the slowest of them.
* CPU ns per path: time of all threads together, from the same calls. On a busy machine it is the
  steadier of the two.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def measure(options):
    """Times one variant with one number of threads, in this process."""
    import mitsuba as mi

    mi.set_variant(options.variant)
    import drjit as dr
    import mitsuba_scene

    # Of both kinds of variant, and counting the calling thread.
    dr.set_thread_count(options.threads)
    path = ROOT / "scenes" / f"{options.scene}.ron"
    scene = mitsuba_scene.scene(path, options.size, options.size)
    integrator = mitsuba_scene.path_tracer(mitsuba_scene.max_depth(path), rr_depth=5)

    def once(seed):
        wall, cpu = time.perf_counter(), time.process_time()
        # The copy to an array ends what llvm left to do.
        mitsuba_scene.render(scene, integrator, options.spp, seed)
        return time.perf_counter() - wall, time.process_time() - cpu

    warm_up, _ = once(0)
    return {"warm_up": warm_up, "calls": [once(1 + i) for i in range(options.repeats)]}


def report(options, variant, threads):
    command = [sys.executable, __file__, "--worker", "--variant", variant, "--threads", str(threads)]
    for name in ("scene", "size", "spp", "repeats"):
        command += [f"--{name}", str(getattr(options, name))]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    timed = json.loads(done.stdout.splitlines()[-1])
    paths = options.size**2 * options.spp
    walls = [wall for wall, _ in timed["calls"]]
    wall, cpu = statistics.median(walls), statistics.median(cpu for _, cpu in timed["calls"])
    nanoseconds = 1e9 / paths
    print(
        f"{variant:12} {threads:7} {timed['warm_up']:10.2f} {wall * nanoseconds:12.0f}"
        f" {min(walls) * nanoseconds:8.0f}-{max(walls) * nanoseconds:<8.0f}"
        f" {cpu * nanoseconds:12.0f} {paths / wall / 1e6:12.3f}",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description="Time Mitsuba 3's path tracer on a scene of ours.")
    parser.add_argument("--scene", default="cornell-box", choices=["cornell-box", "cornell-glass"])
    parser.add_argument("--size", type=int, default=256, help="width and height (default 256)")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    parser.add_argument("--repeats", type=int, default=5, help="timed calls (default 5)")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2], help="default 1 2")
    parser.add_argument("--variant", nargs="+", default=["scalar_rgb", "llvm_ad_rgb"])
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        options.variant, options.threads = options.variant[0], options.threads[0]
        print(json.dumps(measure(options)))
        return
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    print(f"{options.scene}, {options.size} x {options.size}, {options.spp} spp; load before {load:.1f}")
    print(
        f"{'variant':12} {'threads':>7} {'warm-up s':>10} {'ns/path':>12} {'(spread)':>17}"
        f" {'CPU ns/path':>12} {'Mpaths/s':>12}"
    )
    for variant in options.variant:
        for threads in options.threads:
            report(options, variant, threads)


if __name__ == "__main__":
    main()

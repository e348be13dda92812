# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds to the same error: Cycles with a node graph that shows every flake, and libglint's counting model.

    blender -b --factory-startup --python-exit-code 3 -P cycles.py -- GLINT FOLDER [SAMPLES-OF-THE-TRUTH]

The scenes of tests/plugin/flake_scene.py, 128 x 128 pixels, direct light, one thread each. For every number of samples both render a
picture; its error is the root mean square over pixels of the difference to a picture of the same renderer with other random numbers
and SAMPLES-OF-THE-TRUTH (4096) samples, over the mean of that. The truth's own noise is in it, and makes both look worse than
they are by a factor of sqrt(1 + samples / 4096). libglint renders with its default budget (--accuracy 0.02). What that leaves out of
a picture of 64 samples, against none, is added to each of its errors.

Seconds are those of the processor (user and system), because others may use the machine. A line through the times of all numbers
of samples gives seconds a sample, without start-up, and what is left at no sample. Start-up and peak memory are those
of a process of its own that renders one sample. Writes FOLDER/cycles.csv and FOLDER/cycles.json.
"""

import json
import math
import os
import resource
import subprocess
import sys
import time
import types

HERE = os.path.dirname(os.path.realpath(__file__))
PLUGIN = os.path.join(HERE, "..", "..", "plugin", "blender")
sys.path[:0] = [os.path.join(HERE, "..", "plugin"), PLUGIN]

import addon_utils  # noqa: E402
import bpy  # noqa: E402
import numpy  # noqa: E402

import flake_scene  # noqa: E402

addon_utils.enable("glint", default_set=True)

from glint import reference  # noqa: E402

SIDE = 128
SAMPLES = (1, 4, 16, 64, 256, 1024)
# What libglint's pictures may leave out.
ACCURACY = 0.02
# Relative errors at which seconds are compared.
LEVELS = (1.0, 0.5, 0.2, 0.1, 0.05)
# Shape, light, and cells along a side of the UV square: about 4 and 40 flakes a pixel of the plane.
SCENES = (("plane", "rect", 512.0), ("plane", "sun", 1619.0), ("sphere", "rect", 256.0))


def load(path):
    """One channel of white light, in double precision."""
    picture = bpy.data.images.load(path)
    picture.colorspace_settings.name = "Non-Color"
    pixels = numpy.empty(SIDE * SIDE * 4, numpy.float32)
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    return pixels.reshape(SIDE, SIDE, 4)[:, :, 0].astype(float)


def used(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def cycles(scene, path, samples, noise):
    """The picture and the seconds that it took, scene and nodes apart."""
    values = types.SimpleNamespace(scene=scene, output=path, width=SIDE, height=SIDE, spp=samples, bounces=0, seed=noise,
                                   threads=1, smooth=False)
    opened = reference.open_scene(scene)
    start = used(resource.RUSAGE_SELF)
    reference.render(opened, values)
    return load(path), used(resource.RUSAGE_SELF) - start


def glint_command(glint, scene, path, samples, noise, accuracy=ACCURACY):
    return [glint, "render", scene, "-o", path, "--model", "counting", "--accuracy", str(accuracy), "--bounces", "0", "--size",
            f"{SIDE}x{SIDE}", "--spp", str(samples), "--seed", str(noise), "--threads", "1"]


def ours(glint, scene, path, samples, noise, **how):
    start = used(resource.RUSAGE_CHILDREN)
    subprocess.run(glint_command(glint, scene, path, samples, noise, **how), check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return load(path), used(resource.RUSAGE_CHILDREN) - start


# A process inherits the peak of the one that it is forked from, and Blender's is large: a small one stands between.
BETWEEN = """
import json, resource, subprocess, sys, time
start = time.perf_counter()
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps({"cpu_s": usage.ru_utime + usage.ru_stime, "wall_s": time.perf_counter() - start, "peak_MiB": usage.ru_maxrss / 1024}))
"""


def whole_process(command):
    """Seconds of the processor, seconds of the clock and MiB at most, of a process from start to end."""
    return json.loads(subprocess.run(["/usr/bin/python3", "-c", BETWEEN, *command], check=True, capture_output=True).stdout)


def error(picture, truth):
    return float(numpy.sqrt(((picture - truth) ** 2).mean()) / truth.mean())


def line(samples, seconds):
    """Seconds a sample, and what is left at none; each time counts by its relative error."""
    slope, intercept = numpy.polyfit(samples, seconds, 1, w=[1.0 / s for s in seconds])
    return float(slope), float(intercept)


def measure(render, name, folder, truth_samples, left_out=0.0):
    """What one renderer does to one scene; left_out is added to its errors."""
    truth, _ = render(os.path.join(folder, name + "_truth.exr"), truth_samples, 1000)
    rows = []
    for samples in SAMPLES:
        picture, seconds = render(os.path.join(folder, f"{name}_{samples}.exr"), samples, 1)
        rows.append({"samples": samples, "seconds": seconds, "error": error(picture, truth) + left_out})
    per_sample, left = line([r["samples"] for r in rows], [r["seconds"] for r in rows])
    return {"rows": rows, "seconds_per_sample": per_sample, "seconds_left": left, "left_out": left_out}


def samples_for(rows, wanted):
    """Samples to an error, between the rows on a logarithmic scale, beyond them by 1 / sqrt(samples). None: the first row is
    better already."""
    if rows[0]["error"] <= wanted:
        return None
    for a, b in zip(rows, rows[1:]):
        if b["error"] <= wanted < a["error"]:
            t = math.log(a["error"] / wanted) / math.log(a["error"] / b["error"])
            return a["samples"] * (b["samples"] / a["samples"]) ** t
    return rows[-1]["samples"] * (rows[-1]["error"] / wanted) ** 2


def seconds_at(levels_of, wanted):
    """Seconds of rendering to an error, and whether that error was reached in a measured picture."""
    rows = levels_of["rows"]
    samples = samples_for(rows, wanted) or rows[0]["samples"]
    return samples * levels_of["seconds_per_sample"], samples <= rows[-1]["samples"]


def our_seconds_at(levels_of, wanted):
    """The same of libglint's pictures, which show the same facets from 16 samples on: below that nothing lies between two of them.
    None: the error was not reached."""
    rows = levels_of["rows"]
    enough = next((i for i, r in enumerate(rows) if r["error"] <= wanted), None)
    if enough is None:
        return None
    is_between = enough > 0 and rows[enough - 1]["samples"] >= 16
    return (samples_for(rows, wanted) if is_between else rows[enough]["samples"]) * levels_of["seconds_per_sample"]


def compare(glint, folder, shape, light, cells, truth_samples):
    name = f"{shape}_{light}"
    scene = os.path.join(folder, name + ".glb")
    flake_scene.write_glb(scene, *flake_scene.scene(shape, "ggx", light, cells))
    path = os.path.join(folder, name + "_whole.exr")
    whole, some = (ours(glint, scene, path, 64, 1, accuracy=a)[0] for a in (0, ACCURACY))
    our = measure(lambda *a: ours(glint, scene, *a), name + "_ours", folder, truth_samples, error(some, whole))
    theirs = measure(lambda *a: cycles(scene, *a), name + "_cycles", folder, truth_samples)
    theirs["process"] = whole_process(
        [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "3", "-P", os.path.join(PLUGIN, "reference.py"), "--",
         scene, "-o", os.path.join(folder, "start.exr"), "--size", f"{SIDE}x{SIDE}", "--spp", "1", "--threads", "1"])
    our["process"] = whole_process(glint_command(glint, scene, os.path.join(folder, "start.exr"), 1, 1))
    rows = []
    for wanted in LEVELS:
        their_s, theirs_measured = seconds_at(theirs, wanted)
        our_s = our_seconds_at(our, wanted)
        if our_s is not None:
            rows.append({"error": wanted, "cycles_s": their_s, "ours_s": our_s, "cycles_measured": theirs_measured,
                         "faster": their_s / our_s,
                         "faster_with_start": (their_s + theirs["process"]["cpu_s"]) / (our_s + our["process"]["cpu_s"])})
    return {"scene": name, "cycles": theirs, "ours": our, "at_equal_error": rows}


def tell(result):
    print(f"{result['scene']}, {SIDE} x {SIDE} pixels, one thread")
    for who in ("cycles", "ours"):
        r = result[who]
        print(f"  {who:7} {1e3 * r['seconds_per_sample']:9.3f} ms a sample; a process for one sample {r['process']['cpu_s']:.2f} s, "
              f"{r['process']['peak_MiB']:.0f} MiB; errors "
              + ", ".join(f"{row['error']:.4g} ({row['samples']})" for row in r["rows"])
              + (f"; {r['left_out']:.2g} of that is left out" if r["left_out"] else ""))
    for row in result["at_equal_error"]:
        how = "" if row["cycles_measured"] else " (extrapolated)"
        print(f"  error {row['error']:5}: Cycles {row['cycles_s']:.3g} s{how}, ours {row['ours_s']:.3g} s: {row['faster']:.3g} times as fast, "
              f"{row['faster_with_start']:.3g} with start-up")
    sys.stdout.flush()


def main():
    glint, folder, *rest = sys.argv[sys.argv.index("--") + 1:]
    truth_samples = int(rest[0]) if rest else 4096
    pictures = os.path.join(folder, "cycles")
    os.makedirs(pictures, exist_ok=True)
    results = []
    with open(os.path.join(folder, "cycles.csv"), "w", encoding="ascii") as table:
        table.write("scene,renderer,samples,seconds,error\n")
        for row in SCENES:
            result = compare(glint, pictures, *row, truth_samples)
            tell(result)
            results.append(result)
            for who in ("cycles", "ours"):
                for r in result[who]["rows"]:
                    table.write(f"{result['scene']},{who},{r['samples']},{r['samples'] * result[who]['seconds_per_sample']:.6g},{r['error']:.6g}\n")
    with open(os.path.join(folder, "cycles.json"), "w", encoding="ascii") as document:
        json.dump({"side": SIDE, "truth_samples": truth_samples, "scenes": results}, document, indent=2)
        document.write("\n")


main()

# SPDX-License-Identifier: Apache-2.0
"""How long the command takes to start: start.py GLINT SHADER_BALL FILE.json [ROUNDS]

Runs a few command lines in turn, each in a process of its own, and prints the median seconds on the clock and of the processor, the most
memory, and how many libraries the dynamic linker loads. The last line reads pictures, which takes OpenImageIO.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time


def run(command):
    """(seconds, seconds of the processor, MiB)"""
    begin = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"start: {' '.join(command)} fails with {process.returncode}")
    return time.perf_counter() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def library_count(command):
    log = subprocess.run(command, env=dict(os.environ, LD_DEBUG="libs"), capture_output=True, text=True, check=True).stderr
    return log.count("calling init: ")


def command_lines(glint, scene, folder):
    picture = os.path.join(folder, "picture.png")
    render = [glint, "render", scene, "-o", picture, "--size", "64x64"]
    return {
        "materials": [glint, "materials"],
        "inspect": [glint, "inspect", scene],
        "render, 1 sample": render + ["--spp", "1"],
        "render, 16 samples": render + ["--spp", "16"],
        "compare two pictures": [glint, "compare", picture, picture],
    }


def main():
    glint, scene, output = sys.argv[1:4]
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 21
    with tempfile.TemporaryDirectory() as folder:
        lines = command_lines(glint, scene, folder)
        # Once beforehand, so that all files are in memory and there is a picture to compare.
        libraries = {name: library_count(line) for name, line in lines.items()}
        runs = {name: [] for name in lines}
        for _ in range(rounds):
            for name, line in lines.items():
                runs[name].append(run(line))
    print(f"{'':24} {'seconds':>8} {'of the processor':>17} {'MiB':>6} {'libraries':>10}")
    rows = []
    for name, measured in runs.items():
        seconds, cpu, mib = (statistics.median(column) for column in zip(*measured))
        print(f"{name:24} {seconds:8.3f} {cpu:17.3f} {mib:6.0f} {libraries[name]:10}")
        rows.append({"name": name, "seconds": seconds, "cpu_seconds": cpu, "mib": mib, "libraries": libraries[name]})
    with open(output, "w", encoding="utf-8") as document:
        json.dump({"start": rows}, document, indent=2)
        document.write("\n")


if __name__ == "__main__":
    main()

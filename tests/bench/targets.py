# SPDX-License-Identifier: Apache-2.0
"""One table of what libglint aims at and how far it is: targets.py BENCH LIBRARY GLINT

Reads what the programs of ./dev bench have left in the folder BENCH, the tables that LIBRARY carries, and lets GLINT measure its draws.
Writes BENCH/targets.json and BENCH/targets.csv. What has not been measured there is said, not guessed.
"""

import csv
import json
import os
import subprocess
import sys


def read(folder, name):
    """None: there is no such measurement, or it was cut short."""
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        try:
            return json.load(file)
        except json.JSONDecodeError:
            return None


def row_of(document, table, name, key):
    rows = [r for r in (document or {}).get(table, []) if r["name"] == name]
    return rows[0][key] if rows else None


def quotient(document, table, above, below):
    a, b = (row_of(document, table, name, "median_ns") for name in (above, below))
    return a / b if a and b else None


def another_light(document, lanes):
    """Over the first, from four at a point: (4 together / apart - 1) / 3."""
    each = quotient(document, "four lights a point", f"{lanes} lanes, together", f"{lanes} lanes, apart")
    return (4.0 * each - 1.0) / 3.0 if each else None


def table_mib(library):
    """Constants, as the linker lays them out."""
    sizes = subprocess.run(["size", "-A", library], check=True, capture_output=True, text=True).stdout
    return sum(int(line.split()[1]) for line in sizes.splitlines() if line.split()[:1] in (
        [".rodata"], [".data"], [".data.rel.ro"], [".bss"])) / 2**20


def draws(glint, folder):
    """Largest deviations of libglint's draws from the law, by the study of it; and times an exact draw."""
    subprocess.run([glint, "study", "--law", "-o", os.path.join(folder, "law")], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "law", "law.csv"), encoding="utf-8") as file:
        # The study puts in parentheses how far the library's own draw walks.
        rows = [r for r in csv.DictReader(file) if r["sampler"].startswith("libglint (")]
    with open(os.path.join(folder, "law", "law_front.csv"), encoding="utf-8") as file:
        cost = {r["setting"]: float(r["cost_ns"]) for r in csv.DictReader(file)}
    exact = [ns for name, ns in cost.items() if "exact" in name]
    return {"mean": max(abs(float(r["mean"]) - 1.0) for r in rows), "variance": max(abs(float(r["variance"]) - 1.0) for r in rows),
            "ks": max(float(r["ks"]) for r in rows),
            "faster": exact[0] / cost[rows[0]["sampler"]] if exact else None}


def beside_cycles(document, error):
    """Times as fast at this relative error, over the scenes: the least and the most."""
    found = [row["faster"] for scene in (document or {}).get("scenes", []) for row in scene["at_equal_error"]
             if row["error"] == error]
    return min(found, default=None), max(found, default=None)


def gather(folder, library, glint):
    """(what, target, whether less is better, reached)"""
    kernel, evaluations, growth, roofline = (read(folder, f"{n}.json") for n in ("kernel", "eval", "growth", "roofline"))
    pictures, start = read(folder, "frames.json"), read(folder, "start.json")
    mix, eval_table = "mix, N p .01 to 1000", "one point, one light"
    law = draws(glint, folder)
    peak = {w["lanes"]: w["of_peak"] for w in (roofline or {}).get("widths", [])}
    slowest, fastest = beside_cycles(read(folder, "cycles.json"), 0.1)
    of_growth = {name: case.get("largest_over_smallest") for name, case in (growth or {}).items()}
    rows = [
        ("counting kernel, AVX-512, times the published method", 40.0, False, row_of(kernel, mix, "ours, 16 lanes", "faster")),
        ("counting kernel, AVX2, times the published method", 25.0, False, row_of(kernel, mix, "ours, 8 lanes", "faster")),
        ("another light at a point over the first, 16 lanes", 0.55, True, another_light(kernel, 16)),
        ("another light at a point over the first, 8 lanes", 0.55, True, another_light(kernel, 8)),
        ("counting point over smooth point, both in batches", 10.0, True, quotient(evaluations, eval_table, "counting", "smooth")),
        ("rectangle over light of a direction, counting", 1.5, True,
         quotient(evaluations, eval_table, "counting, rectangle", "counting")),
        ("share of the processor's peak, 8 lanes", 0.8, False, peak.get(8)),
        ("share of the processor's peak, 16 lanes", 0.8, False, peak.get(16)),
        ("picture with glints over one without, AVX-512", 4.0, True, quotient(pictures, "frames", "glints, 16 lanes", "smooth")),
        ("picture with glints over one without, AVX2", 5.5, True, quotient(pictures, "frames", "glints, 8 lanes", "smooth")),
        ("a draw: error of the mean", 1e-4, True, law["mean"]),
        ("a draw: error of the variance", 1e-3, True, law["variance"]),
        ("a draw: Kolmogorov-Smirnov distance", 1e-3, True, law["ks"]),
        ("a draw, times as fast as an exact one (BTPE)", 1.0, False, law["faster"]),
        ("cost over densities 1e2 to 1e14, one point, largest over smallest", 1.3, True, of_growth.get("density")),
        ("the same in batches", 1.3, True, of_growth.get("batch")),
        ("cost over footprints 1:1 to 1:1000, largest over smallest", 1.3, True, of_growth.get("footprint")),
        ("cost of a picture, 1024 lights over 64", 1.1, True, lights(folder)),
        ("Embree's share of loading ten million triangles", 0.5, False, ((growth or {}).get("triangles") or {}).get("embree_share")),
        ("seconds to 10 % error, times as fast as Cycles, slowest scene", 100.0, False, slowest),
        ("the same, fastest scene", 100.0, False, fastest),
        ("seconds of glint render, the example, 64 x 64, one sample", 0.15, True, row_of(start, "start", "render, 1 sample", "seconds")),
        ("the same with 16 samples", 0.15, True, row_of(start, "start", "render, 16 samples", "seconds")),
        ("tables of the library, MiB", 1.0, True, table_mib(library)),
    ]
    return rows


def lights(folder):
    path = os.path.join(folder, "growth.csv")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        seconds = {float(r["size"]): float(r["seconds"]) for r in csv.DictReader(file) if r["case"] == "lights"}
    return seconds[1024] / seconds[64] if {64.0, 1024.0} <= seconds.keys() else None


def main():
    folder, library, glint = sys.argv[1:4]
    rows = gather(folder, library, glint)
    print(f"{'':68} {'target':>9} {'reached':>9}")
    with open(os.path.join(folder, "targets.csv"), "w", encoding="utf-8") as table:
        table.write("what,target,reached,of_target\n")
        for what, target, less, reached in rows:
            if reached is None:
                print(f"{what:68} {target:9.4g}   not measured")
                continue
            share = target / reached if less else reached / target
            print(f"{what:68} {'<=' if less else '>='} {target:6.4g} {reached:9.4g}   {'met' if share >= 1.0 else f'{share:.2f} of it'}")
            table.write(f'"{what}",{target:.6g},{reached:.6g},{share:.6g}\n')
    with open(os.path.join(folder, "targets.json"), "w", encoding="utf-8") as document:
        json.dump([{"what": w, "target": t, "less_is_better": less, "reached": r} for w, t, less, r in rows], document, indent=2)
        document.write("\n")


if __name__ == "__main__":
    main()

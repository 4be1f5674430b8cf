#!/usr/bin/env python3
"""Vesicles by vesica and by Surface Evolver, in turn on one machine: whole processes, cold, CPU seconds (user and system) of one thread.

    python3 bench/peers/evolver/compare.py build/release [--repeats 5] [--check]

First table: both look for the same minimum; `more` is the excess over the exact energy, which the problem files have from tests/vesicle_exact.h.
Second table: Evolver measures the surface that vesica found, as ever more triangles, and by Richardson's rule as infinitely many.
--check fails where Evolver is the more exact one, or where its measure of our surface does not converge to ours. It never looks at times."""
import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ beside the sources
import start

HERE = pathlib.Path(__file__).resolve().parent
PROBLEMS = HERE.parents[2] / "problems" / "vesicle"
CASES = (("discocyte", 0.6, (1, 2, 3)), ("prolate", 0.8, (1, 2, 3)), ("stomatocyte", 0.55, (0, 1, 2)))  # refinements
GRIDS = ("8x16", "16x32", "32x64")
TELL = 'printf "told %d %.10f %.10f %.10f\\n", facet_count, bend.value/4/pi, ar.value/4/pi, body[1].volume*3/4/pi\nq\nq\n'


def measured(words, text=""):
    """What it printed, and its CPU seconds."""
    with tempfile.TemporaryFile() as inward, tempfile.TemporaryFile() as outward:
        inward.write(text.encode())
        inward.seek(0)
        process = subprocess.Popen(list(map(str, words)), stdin=inward, stdout=outward,
                                   stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        outward.seek(0)
        return outward.read().decode(errors="replace"), usage.ru_utime + usage.ru_stime


def told(text):
    """Facets, E/(8 pi kappa), area/(4 pi), reduced volume if the area is right."""
    rows = re.findall(r"^(?:Enter command: )?told (\d+) (\S+) (\S+) (\S+)$", text, re.M)
    if len(rows) != 1:
        sys.exit(text + "\nSurface Evolver did not come to its end")
    return int(rows[0][0]), *map(float, rows[0][1:])


def evolver(family, nu, levels, place):
    text = (HERE / ("stomatocyte.cmd" if family == "stomatocyte" else "ellipsoid.cmd")).read_text()
    data = place / "start.fe"
    data.write_text(start.start(family, nu))
    out, seconds = measured(["evolver", "-x", data], text + "begin\n" + "finer\n" * levels + TELL)
    facets, energy, area, volume = told(out)
    if abs(area - 1) > 1e-5 or abs(volume - nu) > 1e-5:
        sys.exit(f"Surface Evolver: area {area}, reduced volume {volume}")
    return facets, energy, seconds


def vesica(program, family, nu):
    out, seconds = measured([program, "run", PROBLEMS / f"{family}.yaml", "--set", f"nu={nu}", "--jobs", "1", "--no-files",
                             "--progress", "none", "--json"])
    result = json.loads(out)
    return len(result["variables"]), result["objective"], seconds


def exact(family):
    return float(re.search(r"objective > ([0-9.]+)\*", (PROBLEMS / f"{family}.yaml").read_text())[1])


def race(program, repeats, place):
    """{(case, None or refinements): [(size, energy, seconds), ...]}"""
    rows = {}
    for _ in range(repeats):
        for family, nu, levels in CASES:
            for level in levels:
                rows.setdefault((family, None), []).append(vesica(program, family, nu))
                rows.setdefault((family, level), []).append(evolver(family, nu, level, place))
    return rows


def times(more, ours):
    """The exact energies have nine digits: an excess below 1e-7 is not known well enough to divide by."""
    return f"{more / ours:.0f}" if ours > 1e-7 else f"> {more / 1e-7:.0f}"


def race_table(rows):
    good = True
    print("| shape | program | size | CPU s (range) | more | CPU over ours | more over ours |\n|---|---|---|---|---|---|---|")
    for family, nu, levels in CASES:
        ours, before = None, None
        for level in (None, *levels):
            sizes, energies, seconds = zip(*rows[family, level])
            more, middle = energies[0] / exact(family) - 1, statistics.median(seconds)
            if level is None:
                ours = more, middle
            else:
                good = good and abs(more) > abs(ours[0]) and (before is None or abs(more) < before)
                before = abs(more)
            print(f"| {family} {nu} | {'vesica' if level is None else 'Evolver'} | {sizes[0]} {'variables' if level is None else 'facets'} "
                  f"| {middle:.3f} ({min(seconds):.3f}..{max(seconds):.3f}) | {100 * more:.5f} % "
                  f"| {middle / ours[1]:.1f} | {times(abs(more), abs(ours[0])) if level is not None else 1} |")
    return good


def mesh(path):
    """The vertices and triangles of an OFF file."""
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith(("#", "OFF"))]
    count = int(lines[0][0])
    return [tuple(map(float, row)) for row in lines[1:count + 1]], [tuple(map(int, row[1:4])) for row in lines[count + 1:]]


def measure_table(program, place):
    good = True
    print("\n| shape | " + " | ".join(f"{grid} cells a patch" for grid in GRIDS) + " | extrapolated | ours | apart |\n" + "|---" * 7 + "|")
    for family, nu, _ in CASES:
        run = place / family
        measured([program, "run", PROBLEMS / f"{family}.yaml", "--set", f"nu={nu}", "--jobs", "1", "--progress", "none", "--out", run])
        ours, energy = json.loads((run / "result.json").read_text())["objective"], []
        for grid in GRIDS:
            folder = place / f"{family}-{grid}"
            measured([program, "export", run, "--to", "off", "--grid", grid, "--out", folder])
            data = place / "ours.fe"
            data.write_text(start.datafile(*mesh(next(folder.glob("*.off"))), nu))
            energy.append(told(measured(["evolver", "-x", data], TELL)[0])[1])
        limit = energy[-1] + (energy[-1] - energy[-2]) / 3
        good = good and abs(limit / ours - 1) < 5e-5
        print(f"| {family} {nu} | " + " | ".join(f"{e:.6f}" for e in energy) + f" | {limit:.6f} | {ours:.6f} | {100 * (limit / ours - 1):.4f} % |")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if not shutil.which("evolver"):
        sys.exit("Surface Evolver is not here: apt-get install evolver")
    program = options.build.resolve() / "vesica"
    with tempfile.TemporaryDirectory() as folder:
        good = race_table(race(program, options.repeats, pathlib.Path(folder)))
        good = measure_table(program, pathlib.Path(folder)) and good
    return 1 if options.check and not good else 0


if __name__ == "__main__":
    sys.exit(main())

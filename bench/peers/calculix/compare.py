#!/usr/bin/env python3
"""Thin shells by vesica and by CalculiX, on decks that vesica writes: the same surface, supports and loads. CPU seconds (user and system) of
whole processes on one thread.

    /usr/bin/python3 bench/peers/calculix/compare.py build/release [FILE] [--set NAME=VALUE]... [--grids 80x96,160x192] [--buckling 3]

Of each load case the largest displacement, the largest max shear and von Mises stress where --where holds (x, y, z; t: the thickness, h: the
highest y) and, in brackets, anywhere, and buckling factors. Without FILE: pot.yaml beside this program, in several designs.
--check fails where on the last grid ours are apart by more than 1 % (displacement), 5 % (max shear where --where holds), 3 % (first factor)."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ beside the sources
import numpy

import frd

HERE = pathlib.Path(__file__).resolve().parent
TABLE = {"a": 1, "d1Ty": -0.135, "d1Dx": 0.3, "d1Dz": 0.3, "d2Ty": 0.4, "d2Dx": 0.370, "d2Dz": 0.378, "cT": 0}  # h = 39.99 mm, 88.4 cm2
AREA = {"a": 1, "d1Ty": -0.19364, "d1Dx": 0.14045, "d1Dz": 0.14045, "d2Ty": 0.27709, "d2Dx": 0.29872, "d2Dz": 0.29872, "cT": 0}
HELD = {"hold": "1e12 Pa"}
DESIGNS = {"start": {}, "start, rim held": HELD, "Table 7.4": TABLE, "Table 7.4, rim held": TABLE | HELD, "least area": AREA,
           "least area, rim held": AREA | HELD}
THREAD = dict(os.environ, OMP_NUM_THREADS="1", OMP_THREAD_LIMIT="1", CCX_NPROC_EQUATION_SOLVER="1", CCX_NPROC_STIFFNESS="1",
              CCX_NPROC_RESULTS="1", OPENBLAS_NUM_THREADS="1")
BOUNDS = {"displacement": 0.01, "max_shear": 0.05, "buckling": 0.03}
COLUMNS = (("displacement", "displacement", False), ("max_shear", "max_shear", True), ("everywhere", "max_shear", False),
           ("von_mises", "von_mises", True), ("mises_everywhere", "von_mises", False), ("buckling", "buckling", False))  # measure, kept region


def measured(words, folder):
    """What it printed, and its CPU seconds."""
    with tempfile.TemporaryFile() as outward:
        process = subprocess.Popen(list(map(str, words)), stdin=subprocess.DEVNULL, stdout=outward, stderr=subprocess.STDOUT, env=THREAD,
                                   cwd=folder)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        outward.seek(0)
        text = outward.read().decode(errors="replace")
    if process.returncode:
        sys.exit(text + f"\n{words[0]} failed: {process.returncode}")
    return text, usage.ru_utime + usage.ru_stime


def deck_of(program, file, sets, grid, factors, folder):
    words = [program, "export", file, "--to", "inp", "--out", folder] + [w for s in sets for w in ("--set", s)]
    measured(words + (["--grid", grid] if grid != "chosen" else []) + (["--buckling", factors] if factors else []), folder)
    return next(pathlib.Path(folder).glob("*.inp"))


def thickness(text):
    found = [float(t) for t in re.findall(r"^\*SHELL SECTION[^\n]*\n(\S+)", text, re.M)]
    return max(found)


def calculix(deck, where):
    """{case: what it found there}, elements, CPU seconds."""
    text, folder = deck.read_text(), deck.parent
    elements = sum(block.count("\n") - 1 for block in re.findall(r"^\*ELEMENT, TYPE=S[68][^*]*", text, re.M))
    said, seconds = measured(["ccx", "-i", deck.stem], folder)
    if "*ERROR" in said:
        sys.exit(said)
    read, moved = frd.Frd(folder / (deck.stem + ".frd")), frd.displacements(folder / (deck.stem + ".dat"))
    factors, cases = frd.factors(folder / (deck.stem + ".dat")), re.findall(r"^\*\* case (.*)$", text, re.M)
    found = {}
    for k, case in enumerate(cases):
        point, stress, _ = read.last("STRESS", k + 1)
        names = {"t": thickness(text), "h": nodes_high(text)}
        kept = numpy.array([eval(where, {}, names | dict(zip("xyz", p))) for p in point.tolist()])
        shear, mises = frd.max_shear(stress), frd.von_mises(stress)
        found[case] = {"displacement": numpy.linalg.norm(moved[k], axis=1).max(), "max_shear": shear[kept].max(), "everywhere": shear.max(),
                       "von_mises": mises[kept].max(), "mises_everywhere": mises.max(), "buckling": factors[k] if factors else None}
    return found, elements, seconds


def nodes_high(text):
    """The largest y of the middle surface."""
    rows = re.search(r"^\*NODE, NSET=NALL\n([^*]*)", text, re.M)[1]
    return max(float(row.split(",")[2]) for row in rows.splitlines())


def with_measures(program, file, cases, where, names, factors, folder):
    """The file with a measure for each column and case, as far as this program has such measures; and their names."""
    known = {m["name"] for m in json.loads(measured([program, "list", "measures", "--json"], folder)[0])["measures"]}
    text, lines, columns = pathlib.Path(file).read_text(), [], {}
    unit = " m" if re.search(r"\b(m|mm|cm)\b", text) else ""
    for name, value in names.items():
        where = re.sub(rf"\b{name}\b", f"{value!r}{unit}", where)
    keys = f', where: "{where}"'
    for k, case in enumerate(cases):
        for column, kind, kept in COLUMNS:
            if kind in known and (kind != "buckling" or factors):
                columns[case, column] = f"peer_{column}_{k}"
                lines.append(f"  peer_{column}_{k}: {{{kind}: {{case: {case}{keys if kept else ''}}}}}")
    if re.search(r"^measures:", text, re.M):
        sys.exit(f"{file} has measures of its own, and this program adds some")
    out = pathlib.Path(folder) / "ours.yaml"
    out.write_text(text + ("\nmeasures:\n" + "\n".join(lines) + "\n" if lines else ""))
    return out, columns


def vesica(program, file, sets, cases, where, names, factors, folder):
    """As calculix, of the measures that there are."""
    ours, columns = with_measures(program, file, cases, where, names, factors, folder)
    if not columns:
        return None, 0
    out, seconds = measured([program, "eval", ours, "--json"] + [w for s in sets for w in ("--set", s)], folder)
    values = json.JSONDecoder().raw_decode(out, re.search("^{", out, re.M).start())[0]["measures"]
    found = {case: {} for case in cases}
    for (case, column), name in columns.items():
        found[case][column] = [values[name]] if column == "buckling" else values[name]
    return found, seconds


def cell(found, column):
    if found.get(column) is None or (column == "buckling" and not found[column]):
        return "-"
    if column == "buckling":
        return " ".join(f"{f:.4g}" for f in found[column])
    return f"{found[column]:.4e}"


def row(design, case, who, size, seconds, found):
    print(f"| {design} | {case} | {who} | {size} | {seconds:.2f} | {cell(found, 'displacement')} | {cell(found, 'max_shear')} ({cell(found, 'everywhere')}) "
          f"| {cell(found, 'von_mises')} ({cell(found, 'mises_everywhere')}) | {cell(found, 'buckling')} |", flush=True)


def apart(ours, theirs):
    """{column: relative difference} of what both have."""
    found = {}
    for column in BOUNDS:
        a, b = ours.get(column), theirs.get(column)
        if a is None or b is None:
            continue
        if column == "buckling":
            a, b = a[0], b[0]
        found[column] = a / b - 1
    return found


def compare(program, design, file, sets, options):
    """Prints the rows of one design; are ours and CalculiX's on the finest grid near enough?"""
    good, theirs, names = True, {}, {}
    for grid in options.grids.split(","):
        with tempfile.TemporaryDirectory() as folder:
            deck = deck_of(program, file, sets, grid, options.buckling, folder)
            text = deck.read_text()
            names = {"t": thickness(text), "h": nodes_high(text)}
            theirs, elements, seconds = calculix(deck, options.where)
        for case, found in theirs.items():
            row(design, case, "CalculiX", f"{elements} S8R", seconds, found)
    with tempfile.TemporaryDirectory() as folder:
        ours, seconds = vesica(program, file, sets, list(theirs), options.where, names, options.buckling, folder)
    if not ours:
        sys.exit("this vesica has no measures of shells")
    for case in ours:
        row(design, case, "vesica", "", seconds, ours[case])
        for column, difference in apart(ours[case], theirs[case]).items():
            print(f"    {column}: {100 * difference:+.3f} % of CalculiX on the last grid", flush=True)
            good = good and abs(difference) <= BOUNDS[column]
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("file", nargs="?", type=pathlib.Path)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--grids", default="40x96,80x96,160x96")
    parser.add_argument("--buckling", type=int, default=3)
    parser.add_argument("--where", default="y > 4*t and y < h - t")
    parser.add_argument("--designs", default=";".join(DESIGNS))
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if not shutil.which("ccx"):
        sys.exit("CalculiX is not here: apt-get install calculix-ccx")
    program, good = options.build.resolve() / "vesica", True
    print("| design | case | by | size | CPU s | largest displacement, m | max shear, Pa (everywhere) | von Mises, Pa (everywhere) "
          "| buckling factors |\n|---|---|---|---|---|---|---|---|---|")
    for design in [options.file.stem] if options.file else options.designs.split(";"):
        sets = options.set + [f"{k}={v}" for k, v in ({} if options.file else DESIGNS[design]).items()]
        good = compare(program, design, (options.file or HERE / "pot.yaml").resolve(), sets, options) and good
    return 1 if options.check and not good else 0


if __name__ == "__main__":
    sys.exit(main())

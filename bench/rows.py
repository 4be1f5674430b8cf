#!/usr/bin/env python3
"""Writes the measured rows of docs/methods from two benchmarks, once these are over:

    vesica bench bench/suites/methods.yaml --json > classic.json
    vesica bench bench/suites/methods_constrained.yaml --json > constrained.json
    python3 bench/rows.py classic.json constrained.json docs/methods/*.md

Replaces what stands between `<!-- rows SUITE: METHOD METHOD ... -->` (*: all) and `<!-- end -->`. SUITE is classic or
constrained; `pairs` in place of `rows` tells who is better than these methods. Without pages it prints both tables."""
import json
import re
import sys

NAMES = {"rastrigin": "Rastrigin", "ackley": "Ackley", "griewank": "Griewank", "schwefel": "Schwefel",
         "rosenbrock": "Rosenbrock", "levy": "Levy", "rot_rastrigin": "rot. Rastrigin",
         "rot_ellipsoid": "rot. ellipsoid"}


def short(cost):
    """345, 6.8k, 91k, 1.2M."""
    if round(cost) < 1000:
        return "%d" % round(cost)
    scale, unit = (1e3, "k") if cost < 999500 else (1e6, "M")
    return "%.2g%s" % (cost / scale, unit) if cost < 99.5 * scale else "%d%s" % (round(cost / scale), unit)


def seconds(s):
    for factor, unit in ((1, "s"), (1e3, "ms"), (1e6, "us")):
        if s * factor >= 1:
            break
    return "%.2g %s" % (s * factor, unit) if s * factor < 100 else "%d %s" % (round(s * factor), unit)


def expected(score):
    """ERT of the last target; the hits, when not all runs have them."""
    ert, hits, runs = score["ert"][-1][0], score["hits"][-1], score["runs"]
    if not hits:
        return "-"
    return short(ert) if hits == runs else "%s (%d)" % (short(ert), hits)


class Report:
    def __init__(self, path, classic):
        self.data = json.load(open(path))
        self.methods = [m["name"] for m in self.data["methods"]]
        self.score = {(s["method"], s["problem"]): s for s in self.data["scores"]}
        self.own = {m["name"]: m["own_s"] for m in self.data["methods"]}
        self.problems = [p["name"] for p in self.data["problems"]]
        self.sizes = {p["name"]: p["n"] for p in self.data["problems"]}
        self.classic = classic
        self.shown = [p for p in self.problems if not classic or self.sizes[p] == 10]

    def hits(self, method, n=None):
        of = [self.score[method, p] for p in self.problems if n is None or self.sizes[p] == n]
        return "%d of %d" % (sum(s["hits"][-1] for s in of), sum(s["runs"] for s in of))

    def head(self):
        shares = ["met, n = 5", "n = 10"] if self.classic else ["met"]
        names = [NAMES.get(p.split()[0], p.split()[0]) for p in self.shown]
        cells = ["method"] + shares + names + ["own time"]
        return "| " + " | ".join(cells) + " |\n|" + "---|" * len(cells) + "\n"

    def row(self, method):
        shares = [self.hits(method, 5), self.hits(method, 10)] if self.classic else [self.hits(method)]
        cells = ["`%s`" % method] + shares + [expected(self.score[method, p]) for p in self.shown]
        return "| " + " | ".join(cells + [seconds(self.own[method])]) + " |\n"

    def pairs(self, methods):
        """Of each method: who is better than it or worse, by the paired test of the benchmark, and by how much."""
        text = ""
        for m in methods:
            better, alike, worse = [], [], 0
            for p in self.data["pairs"]:
                if m not in (p["first"], p["second"]):
                    continue
                first = p["first"] == m
                other, effect = p["second" if first else "first"], p["a12"] if first else 1 - p["a12"]
                if not p["verdict"].startswith("the "):
                    alike.append("`%s`" % other)
                elif p["verdict"].startswith("the second" if first else "the first"):
                    better.append("`%s` (%.2f)" % (other, 1 - effect))
                else:
                    worse += 1
            text += "- `%s`: better than it, with A12, %s; no difference shown: %s; it is better than the other %d.\n" % (
                m, ", ".join(better) or "none", ", ".join(alike) or "none", worse)
        return text

    def table(self, methods):
        return self.head() + "".join(self.row(m) for m in (self.methods if methods == ["*"] else methods))


def main(classic, constrained, *pages):
    reports = {"classic": Report(classic, True), "constrained": Report(constrained, False)}
    write = {"rows": Report.table, "pairs": Report.pairs}
    if not pages:
        print(*(r.table(["*"]) for r in reports.values()), sep="\n")
    for page in pages:
        text = open(page).read()
        new = re.sub(r"(<!-- (rows|pairs) (\w+): ([^>]*?) -->\n).*?(<!-- end -->)",
                     lambda m: m[1] + "\n" + write[m[2]](reports[m[3]], m[4].split()) + "\n" + m[5], text, flags=re.S)
        if new != text:
            open(page, "w").write(new)


if __name__ == "__main__":
    main(*sys.argv[1:])

"""What CalculiX wrote: an FRD file (nodes, and fields at them by step) and the buckling factors of a DAT file, by numpy.

The columns of an FRD line are fixed: a key of 3 characters, a node of 10, numbers of 12 each [CalculiX GraphiX manual, FRD format]."""
import re

import numpy


def numbers(line, count):
    return [float(line[13 + 12 * k:25 + 12 * k]) for k in range(count)]


class Frd:
    """node: {number: row of point}; point: [nodes][3]; fields: [(step, name, {node: row}, [rows][components])]; what a field has no room
    for in one line (more than six components) is not read."""

    def __init__(self, path):
        self.node, self.point, self.fields = {}, numpy.zeros((0, 3)), []
        with open(path, errors="replace") as lines:
            self.lines = lines
            for line in lines:
                if line.startswith("    2C"):
                    self.node, self.point = self.rows(3)
                elif line.startswith("  100C"):
                    self.field(int(line[58:63]))

    def rows(self, components):
        node, row = {}, []
        for line in self.lines:
            if line.startswith(" -3"):
                break
            if line.startswith(" -1"):
                node[int(line[3:13])] = len(row)
                row.append(numbers(line, components))
        return node, numpy.array(row)

    def field(self, step):
        head = next(self.lines).split()
        components = sum(next(self.lines).startswith(" -5") for _ in range(int(head[2])))
        name, written = head[1], {"DISP": 3, "STRESS": 6}.get(head[1], components)
        self.fields.append((step, name, *self.rows(written)))

    def last(self, name, step=None):
        """Of a field its points, values and node numbers."""
        for at, what, node, value in reversed(self.fields):
            if what == name and step in (None, at):
                place = numpy.array([self.node[n] for n in node])
                return self.point[place], value, node
        raise KeyError(name)


def principal(stress):
    """[nodes][3], rising; stress: xx yy zz xy yz zx as FRD has them."""
    xx, yy, zz, xy, yz, zx = stress.T
    return numpy.linalg.eigvalsh(numpy.stack([xx, xy, zx, xy, yy, yz, zx, yz, zz], axis=1).reshape(-1, 3, 3))


def max_shear(stress):
    s = principal(stress)
    return (s[:, 2] - s[:, 0]) / 2


def von_mises(stress):
    s = principal(stress)
    return numpy.sqrt(((s[:, 0] - s[:, 1]) ** 2 + (s[:, 1] - s[:, 2]) ** 2 + (s[:, 2] - s[:, 0]) ** 2) / 2)


def factors(path):
    """The buckling factors of every *BUCKLE step, in the order of the deck."""
    text = open(path, errors="replace").read()
    found = []
    for block in re.split(r"B U C K L I N G   F A C T O R   O U T P U T", text)[1:]:
        rows = []
        for line in block.splitlines():
            row = re.fullmatch(r"\s+(\d+)\s+([-+0-9.E]+)\s*", line)
            if row:
                rows.append(float(row[2]))
            elif rows and line.strip():
                break
        found.append(rows)
    return found


def displacements(path):
    """Of every step that prints them, those of the nodes of the shell: [nodes][3] each, in the order of the deck."""
    found, rows = [], None
    with open(path, errors="replace") as lines:
        for line in lines:
            if "displacements (vx,vy,vz)" in line:
                rows = []
                found.append(rows)
            elif rows is not None:
                words = line.split()
                if len(words) == 4:
                    rows.append([float(w) for w in words[1:]])
                elif words:
                    rows = None
    return [numpy.array(rows) for rows in found]

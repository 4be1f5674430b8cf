"""Reads binary STL: closed when every edge is used once in each direction; outward when the volume is positive."""
import collections
import struct
import sys


def triangles(path):
    data = open(path, "rb").read()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count, f"{path}: {len(data)} bytes for {count} triangles"
    for k in range(count):
        # 0.0 and -0.0 are the same corner
        yield [tuple(x + 0.0 for x in struct.unpack_from("<3f", data, 84 + 50 * k + 12 * corner)) for corner in (1, 2, 3)]


def volume(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6


def check(path):
    edges, total, count = collections.Counter(), 0.0, 0
    for t in triangles(path):
        count += 1
        total += volume(*t)
        for k in range(3):
            edges[t[k], t[(k + 1) % 3]] += 1
    open_edges = sum(1 for (a, b), n in edges.items() if n != 1 or edges.get((b, a)) != 1)
    assert count > 0 and open_edges == 0, f"{path}: {open_edges} open edges of {count} triangles"
    assert total > 0, f"{path}: volume {total}"
    print(f"{path}: {count} triangles, closed, volume {total:.6g}")


for file in sys.argv[1:]:
    check(file)

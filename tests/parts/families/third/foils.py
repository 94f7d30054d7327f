"""Blades, hulls and fairings."""
import math

import cadquery as cq
import numpy as np

from ..register import part
from ..shapes import W, disc, turned, around, joined, less
from .sections import closed_curve, foil, lofted, squarish


@part(turn=True, offset=1.0)
def axial_fan():
    wires = [foil(15 + 9 * s, 0.16 - 0.05 * s, 0.10 + 0.03 * s, 0.95 - 0.5 * s, 0, 2 * s * s, 14 + 32 * s) for s in np.linspace(0, 1, 4)]
    blade = lofted(wires).rotate((0, 0, 0), (0, 1, 0), 90).rotate((0, 0, 0), (1, 0, 0), 90)
    hub = turned((0, -9), (18, -9), (18, 7), (16, 9), (0, 9))
    body = joined(hub, around(blade, 5)).cut(turned((0, -10), (15.5, -10), (15.5, 5), (0, 5))).union(turned((0, -6), (4, -6), (5, 6), (0, 6)))
    return body.cut(disc(1.6, 9, -7))


@part(turn=True, offset=1.0)
def sailplane_wing():
    wires = [foil(60 - 34 * s * s, 0.15 - 0.02 * s, 0.05 - 0.02 * s, -0.06 * s, 9 * s * s, 14 * s ** 3, 120 * s) for s in np.linspace(0, 1, 5)]
    body = lofted(wires).union(W().box(70, 22, 5).translate((6, 2, -2)).edges("|Z").fillet(8))
    body = body.cut(W().box(15, 30, 40).translate((28, 0, 54)))
    return less(body, [disc(1.8, 20, -10, x, 2) for x in (-20, 32)]).union(disc(3, 16, -18, -6, 3).faces("<Z").edges().chamfer(0.8))


@part(turn=True)
def boat_hull():
    rows = ((0, 15, 13, 1.0), (25, 19, 15, 0.6), (60, 20, 15, 0.2), (95, 14, 13, 0.1), (118, 5, 9, -0.05))
    def hull(thin):
        wires = []
        for x, beam, deep, flat in rows:
            shape = lambda a: ((beam - thin) * math.cos(a), (deep - thin) * math.sin(a) * (1 + 0.12 * flat * math.cos(2 * a)))
            wires.append(closed_curve(shape, cq.Plane((x, 0, 0), (0, 1, 0), (1, 0, 0))))
        return lofted(wires)
    below = W().box(400, 100, 60).translate((0, 0, -30))
    body = hull(0).intersect(below)
    well = hull(2.2).intersect(W().box(84, 100, 60).translate((52, 0, -30)))
    body = body.cut(well).union(W().box(6, 36, 3).translate((40, 0, -4)).intersect(hull(1)))
    return body.union(W("XZ").polyline([(20, -12.7), (46, -12.7), (40, -22), (26, -22)]).close().extrude(1.2, both=True))


@part(turn=True, offset=1.0)
def wheel_fairing():
    rows = ((0, 4, 6), (16, 12, 17), (42, 14, 21), (80, 9, 14), (118, 2.5, 5))
    body = lofted([closed_curve(squarish(a, b, 2.4), cq.Plane((x, 0, 0), (0, 1, 0), (1, 0, 0))) for x, a, b in rows])
    slot = W("XZ", origin=(38, 0, -14)).circle(17).extrude(7, both=True)
    body = body.cut(slot).cut(W("XZ", origin=(38, 0, -6)).circle(3).extrude(40, both=True))
    return body.union(W("XY", origin=(38, 0, 15)).rect(20, 5).extrude(18).edges("|Z").fillet(2.4))
